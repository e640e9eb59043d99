// Tests the wording and the locations of messages.
#include "tests/apps/import/import_support.h"

namespace kaustik::pbrt {
namespace {

class ImportErrors : public ImportTest {};

// Neither the word nor what the list was to hold is said to be wrong elsewhere.
TEST_F(ImportErrors, AWordInAListIsOneError) {
  EXPECT_EQ(
      messages("WorldBegin\n"
               "LightSource \"point\" \"rgb I\" [1 one 1]\n"
               "Shape \"trianglemesh\" \"point3 P\" [0 0 0 1 no such 0 1 0] \"integer indices\" [0 1 2]\n"),
      "scene.pbrt:2:32: error: expected a value or `]`, not `one`\n"
      "LightSource \"point\" \"rgb I\" [1 one 1]\n"
      "                               ^\n"
      "scene.pbrt:2:29: note: the list begins here\n"
      "LightSource \"point\" \"rgb I\" [1 one 1]\n"
      "                            ^\n"
      "scene.pbrt:3:42: error: expected a value or `]`, not `no`\n"
      "Shape \"trianglemesh\" \"point3 P\" [0 0 0 1 no such 0 1 0] \"integer indices\" [0 1 2]\n"
      "                                         ^\n"
      "scene.pbrt:3:33: note: the list begins here\n"
      "Shape \"trianglemesh\" \"point3 P\" [0 0 0 1 no such 0 1 0] \"integer indices\" [0 1 2]\n"
      "                                ^\n");
}

TEST_F(ImportErrors, OneRunReportsAllErrors) {
  EXPECT_EQ(
      messages("Camera \"perspectiv\"\n"
               "WorldBegin\n"
               "\tMaterial \"difuse\"\n"
               "Material \"diffuse\" \"rgb reflectanc\" [ .5 .5 .5 ]\n"
               "Shpae \"sphere\"\n"
               "Shape \"sphere\" \"float radius\" [ -1 ]  # no\n"
               "Translate 1 2 x\n"
               "Shape \"plymesh\" \"string filename\" \"none.ply\"\n"),
      "scene.pbrt:1:8: error: unknown camera \"perspectiv\"; did you mean `perspective`? known: perspective, "
      "orthographic, spherical\n"
      "Camera \"perspectiv\"\n"
      "       ^\n"
      "scene.pbrt:3:11: error: unknown material \"difuse\"; did you mean `diffuse`?\n"
      "\tMaterial \"difuse\"\n"
      "\t         ^\n"
      "scene.pbrt:4:20: error: material \"diffuse\" has no parameter `reflectanc`; did you mean "
      "`reflectance`? known: reflectance, displacement, normalmap\n"
      "Material \"diffuse\" \"rgb reflectanc\" [ .5 .5 .5 ]\n"
      "                   ^\n"
      "scene.pbrt:5:1: error: unknown directive `Shpae`; did you mean `Shape`?\n"
      "Shpae \"sphere\"\n"
      "^\n"
      "scene.pbrt:6:33: error: `radius` of shape \"sphere\" must be > 0, not -1\n"
      "Shape \"sphere\" \"float radius\" [ -1 ]  # no\n"
      "                                ^\n"
      "scene.pbrt:7:15: error: `Translate` takes 3 numbers: expected number 3, not `x`\n"
      "Translate 1 2 x\n"
      "              ^\n"
      "scene.pbrt:8:35: error: cannot open \"none.ply\": no such file\n"
      "Shape \"plymesh\" \"string filename\" \"none.ply\"\n"
      "                                  ^\n");
}

struct Case {
  std::string_view text, message;
};
// GoogleTest reports a failing case by this text.
void PrintTo(const Case& c, std::ostream* out) {
  *out << c.text.substr(0, 60);
}

class ImportErrorTable : public ImportTest, public testing::WithParamInterface<Case> {};

TEST_P(ImportErrorTable, MessageMatches) {
  EXPECT_EQ(first_lines(std::string(GetParam().text)), std::string(GetParam().message) + "\n");
}

INSTANTIATE_TEST_SUITE_P(
    Parameters, ImportErrorTable,
    testing::Values(
        Case{R"(Material "diffuse" "spectrum reflectance" "metal-CuZn-eta")",
             R"(2:43: warning: pbrt's spectrum "metal-CuZn-eta" is not built in: "metal-Cu-eta" stands in)"},
        Case{
            R"(Material "diffuse" "spectrum reflectance" "metal-Cu-et")",
            R"(2:43: error: no spectrum is named "metal-Cu-et"; did you mean `metal-Cu-eta`? Read as a file name: )"
            R"(cannot open "metal-Cu-et": no such file)"},
        Case{R"(Material "diffuse" "spectrum reflectance" "spds/paint.spd")",
             R"(2:43: warning: no spectrum is named "spds/paint.spd". Read as a file name: cannot open )"
             R"("spds/paint.spd": no such file; `reflectance` keeps its default)"},
        Case{
            R"(Material "diffuse" "spectrum reflectance" [ 400 1 500 ])",
            R"(2:20: warning: a spectrum takes pairs of wavelength and value: the last of 3 numbers is ignored)"},
        Case{
            R"(Material "diffuse" "spectrum reflectance" [ 400 1 400 2 ])",
            R"(2:51: warning: wavelengths must increase: they are sorted, and the first value of each holds)"},
        Case{R"(Material "diffuse" "spectrum reflectance" [ 400 -1 500 2 ])",
             R"(2:49: warning: a spectrum must not be negative: such values become zero)"},
        Case{R"(Material "diffuse" "texture reflectance" "wood")",
             R"(2:42: warning: no texture is named `wood` up to here: `reflectance` keeps its default)"},
        Case{R"(LightSource "point" "blackbody I" 0)",
             R"(2:35: error: `I` takes a temperature from 100 to 10000000 kelvin and an optional factor)"},
        Case{R"(LightSource "point" "spectrum I" [ 300 1 350 1 ])",
             R"(2:36: error: the light of `I` is invisible: its spectrum is zero from 360 nm to 830 nm)"},
        Case{R"(LightSource "point" "blackbody scale" 5500)",
             R"(2:21: error: "blackbody scale" is not supported: light "point" takes only "float scale")"},
        Case{R"(Material "diffuse" "float reflectance" .5)",
             R"(2:20: warning: "float reflectance" of material "diffuse" is read as "rgb reflectance")"},
        Case{R"(Material "conductor" "string k" "x")",
             R"(2:22: error: "string k" has the wrong type: material "conductor" takes "rgb k" or "float k" )"
             R"(or "texture k")"},
        Case{R"(Material "conductor" "float k" [1 2])",
             R"(2:22: error: `k` of material "conductor" takes 1 or 3 values, not 2)"},
        Case{R"(Material "diffuse" "rgb reflectance" [.5 .5])",
             R"(2:20: error: `reflectance` of material "diffuse" takes 3 values, not 2)"},
        Case{R"(Material "diffuse" "rgb reflectance" [.5 1.5 .5])",
             R"(2:42: warning: `reflectance` of material "diffuse" must be >= 0 and <= 1: 1.5 becomes 1)"},
        Case{R"(Material "orennayar" "float sigma" 91)",
             R"(2:36: warning: `sigma` of material "orennayar" must be >= 0 and <= 90: 91 becomes 90)"},
        Case{R"(Material "coateddiffuse" "float albedo" .5)",
             R"(2:26: warning: `albedo` of material "coateddiffuse" is ignored: the coat holds no medium)"},
        Case{
            R"(Material "hair")",
            R"(2:10: warning: material "hair" is approximated: as "diffuse" in the colour of a head of such hair)"},
        Case{
            R"(Material "measured" "string filename" "x.bsdf" Material "measured")",
            R"(2:10: warning: material "measured" is approximated: as "diffuse" with reflectance 0.5: the file is )"
            R"(not read)"},
        Case{R"(Material "mix" "float amount" 1.5)",
             "2:10: error: material \"mix\" needs `materials`, the names of two materials\n"
             R"(2:31: warning: `amount` of material "mix" must be >= 0 and <= 1: 1.5 becomes 1)"},
        Case{R"(Material "diffuse" "string normalmap" "n.png")",
             R"(2:39: error: cannot open "n.png": no such file)"},
        Case{R"(Shape "sphere" "float radius" 1 "float radius" 2)",
             R"(2:33: warning: this `radius` replaces an earlier one)"},
        Case{R"(Shape "curve")",
             R"(2:1: warning: a curve takes 4 finite points or more: this one is left out)"},
        Case{R"(Shape "sphere" "float zmin" .5 "float zmax" .5)",
             R"(2:29: error: no part of the sphere lies between `zmin` = 0.5 and `zmax` = 0.5)"},
        Case{R"(Shape "disk" "float phimax" 361)",
             R"(2:29: warning: `phimax` of shape "disk" must be > 0 and <= 360: 361 becomes 360)"},
        Case{R"(Shape "disk" "float innerradius" 1)",
             R"(2:34: error: `innerradius` = 1 leaves nothing of a disk of radius 1)"},
        Case{R"(Shape "trianglemesh" "integer indices" [0 1 2])",
             R"(2:7: error: shape "trianglemesh" needs `P`)"},
        Case{R"(Shape "trianglemesh" "point3 P" [0 0 0 1 0 0 0 1 0] "integer indices" [0 1 3])",
             R"(2:76: error: index 3 is out of range: there are 3 vertices)"},
        Case{
            R"(Shape "trianglemesh" "point3 P" [0 0 0 1 0 0 0 1 0] "integer indices" [0 1 2 0])",
            R"(2:53: warning: `indices` of shape "trianglemesh" come in groups of 3, but there are 4: the last ones )"
            R"(are ignored)"},
        Case{R"(Shape "trianglemesh" "point3 P" [0 0 0 1 0 0 0 1 0] "normal N" [0 0 1])",
             R"(2:53: warning: `N` has 1 entries for 3 vertices and is ignored)"},
        Case{R"(Shape "trianglemesh" "point3 P" [0 0 0 1 0 0 0 1])",
             R"(2:22: error: `P` of shape "trianglemesh" takes 9 values or more, in groups of 3, not 8)"},
        Case{R"(Shape "trianglemesh" "point3 P" [0 0 0 1 0 0 2 0 0])",
             R"(2:1: warning: 1 of 1 triangles have no area and are left out)"},
        Case{R"(Scale 1 0 1 Shape "sphere")",
             R"(2:13: warning: the transform of this shape has no inverse: it is left out)"},
        Case{R"(Scale 1e30 1 1 Scale 1e30 1 1 Shape "trianglemesh" "point3 P" [0 0 0 1 0 0 0 1 0])",
             R"(2:31: warning: the transform of this shape has no inverse: it is left out)"},
        Case{
            R"(Scale 1 2 1 AreaLightSource "diffuse" Shape "sphere")",
            R"(2:39: warning: a light on a sphere or cylinder that is scaled non-uniformly shines as triangles)"},
        Case{R"(Material "interface" AreaLightSource "diffuse" Shape "sphere")",
             R"(2:48: warning: the area light is ignored: material "interface" is not a surface)"},
        Case{R"(LightSource "point" "rgb I" [0 0 0] "float power" 3)",
             R"(2:51: error: `power` is given for a light that emits nothing)"},
        Case{R"(AreaLightSource "diffuse" "string filename" "tv.exr" Shape "sphere")",
             R"(2:45: error: cannot open "tv.exr": no such file)"},
        Case{R"(LightSource "projection")",
             R"(2:1: error: light "projection" needs an image: "string filename")"},
        Case{R"(Scale 1 2 1 LightSource "goniometric" "string filename" "light.exr")",
             "2:13: warning: the transform of this light scales non-uniformly or shears: only its rotation "
             "counts\n"
             R"(2:57: error: cannot open "light.exr": no such file)"},
        Case{R"(LightSource "infinite" "string filename" "sky.exr" "rgb L" [1 1 1])",
             R"(2:42: error: cannot open "sky.exr": no such file)"},
        Case{R"(LightSource "infinite" "point3 portal" [0 0 0 1 0 0 1 1 0])",
             R"(2:24: error: `portal` of light "infinite" takes 12 values, not 9)"},
        Case{R"(LightSource "infinite" "point3 portal" [0 0 0 1 0 0 1 1 0 0 2 0])",
             R"(2:41: warning: `portal` must be the four corners of a rectangle, in order: it is ignored)"},
        Case{R"(LightSource "spot" "point3 to" [0 0 0])",
             R"(2:33: error: `from` and `to` must be two points)"},
        Case{R"(AreaLightSource "difuse" Shape "sphere")",
             R"(2:17: error: unknown area light "difuse"; did you mean `diffuse`?)"}));

INSTANTIATE_TEST_SUITE_P(
    Directives, ImportErrorTable,
    testing::Values(
        Case{R"(Texture "a" "imagemap")", R"(2:23: error: `Texture` needs a type in quotes)"},
        Case{R"(MakeNamedMedium "fog" "string type" "homogeneous" "rgb Le" [1 -1 1])",
             R"(2:63: error: `Le` of medium "homogeneous" must be >= 0, not -1)"},
        Case{R"(MakeNamedMedium "fog" "string type" "homogeneous" "float g" 1.5)",
             R"(2:61: error: `g` of medium "homogeneous" must be >= -1 and <= 1, not 1.5)"},
        Case{R"(MakeNamedMedium "fog" "float scale" 2)",
             R"(2:17: error: medium `fog` needs its type: "string type" "homogeneous")"},
        Case{R"(MakeNamedMedium "fog" "string type" "cloud")",
             "2:37: error: pbrt's medium \"cloud\" is not supported; known: homogeneous, uniformgrid"},
        Case{R"(MakeNamedMedium "s" "string type" "uniformgrid" "integer nx" 2 "float density" [1 2 3])",
             "2:81: error: `density` has 3 values, but `nx`, `ny` and `nz` make 2 points"},
        Case{R"(MakeNamedMedium "s" "string type" "uniformgrid" "integer nx" 2)",
             "2:35: error: medium \"uniformgrid\" needs `density`"},
        Case{R"(MakeNamedMedium "s" "string type" "uniformgrid" "float density" [1e38] "float scale" 1e3)",
             "2:66: error: `density` takes coefficients beyond the range of floats"},
        Case{R"(MakeNamedMedium "s" "string type" "uniformgrid" "float density" [-1])",
             "2:66: error: `density` of medium \"uniformgrid\" must be >= 0, not -1"},
        Case{R"(MakeNamedMedium "s" "string type" "uniformgrid" "integer nx" 0 "float density" [1])",
             "2:62: error: `nx` of medium \"uniformgrid\" must be >= 1 and <= 4096, not 0"},
        Case{R"(MakeNamedMedium "s" "string type" "uniformgrid" "point3 p1" [1 0 1] "float density" [1])",
             "2:62: error: the box of this grid, from `p0` to `p1`, is flat or too small, or its "
             "transform cannot be inverted"},
        Case{R"(Scale 1e30 1e30 1e30 LightSource "point" "point3 from" [1e30 0 0])",
             "2:22: error: the transform takes this light beyond the range of floats"},
        Case{R"(Scale 1e30 1e30 1e30 LightSource "spot" "point3 from" [1e30 0 0])",
             "2:22: error: the transform takes this light beyond the range of floats"},
        Case{R"(MakeNamedMedium "fog" "string type" "homogeneous" "rgb sigma_a" [1 -1 0])",
             "2:68: error: `sigma_a` of medium \"homogeneous\" must be >= 0, not -1"},
        Case{"MakeNamedMedium \"fog\" \"string type\" \"homogeneous\" \"rgb sigma_s\" [0 0 0]\n"
             "MakeNamedMedium \"fog\" \"string type\" \"homogeneous\" \"rgb sigma_s\" [0 0 0]",
             "3:17: error: medium `fog` is defined twice"},
        Case{"MakeNamedMedium \"fog\" \"string type\" \"homogeneous\" \"rgb sigma_s\" [0 0 0]\n"
             "MediumInterface \"\" \"fogg\" Shape \"sphere\"",
             "3:20: error: no medium is named `fogg`; did you mean `fog`?"},
        Case{R"(MediumInterface fog)", "2:17: error: `MediumInterface` needs the medium inside in quotes"},
        Case{R"(ActiveTransform EndTime)",
             R"(2:1: warning: motion is not rendered: everything stays where it is when the shutter opens)"},
        Case{R"(ActiveTransform Sometimes)",
             R"(2:1: error: `ActiveTransform` needs All, StartTime or EndTime)"},
        Case{
            "WorldEnd\nWorldBegin\nShape \"none\"",
            R"(3:1: warning: what follows `WorldEnd` is another picture: only the first one of the file is read)"},
        Case{R"(WorldBegin)", R"(2:1: error: this is a second `WorldBegin`)"},
        Case{R"(Film "rgb")", R"(2:1: warning: `Film` belongs before `WorldBegin`; it is read here, too)"},
        Case{R"(Camera "perspective")", R"(2:1: error: `Camera` belongs before `WorldBegin`)"},
        Case{
            R"(ColorSpace "rec2021")",
            R"(2:12: warning: unknown color space "rec2021": "srgb" remains; did you mean `rec2020`? known: srgb, dci-p3, )"
            R"(rec2020, aces2065-1)"},
        Case{
            R"(CoordSysTransform "wrold")",
            R"(2:19: warning: no coordinate system is named `wrold`: the transform stays as it is; did you mean `world`?)"},
        Case{R"(LookAt 0 0 0  0 1 0  0 1 0)",
             R"(2:1: warning: the up vector of `LookAt` points along the view or is zero: +z is up)"},
        Case{R"(LookAt 0 1 0  0 1 0  0 1 0)",
             R"(2:1: error: `LookAt` needs an eye and another point to look at)"},
        Case{R"(Rotate 90 0 0 0)", R"(2:1: error: the axis of `Rotate` has length zero)"},
        Case{R"(Transform [1 2 3])",
             R"(2:17: error: `Transform` takes 16 numbers: expected number 4, not `]`)"},
        Case{R"(Translate 1e40 0 0)", R"(2:11: error: `1e40` is beyond the range of floats)"},
        Case{R"(AttributeEnd)", R"(2:1: warning: `AttributeEnd` closes no open block and is ignored)"},
        Case{R"(AttributeBegin)", R"(2:1: warning: this block is not closed: expected `AttributeEnd`)"},
        Case{"ObjectBegin \"a\"\nAttributeEnd\nObjectEnd",
             R"(3:1: error: `AttributeEnd` does not close this block)"},
        Case{"ObjectBegin \"a\" ObjectEnd\nObjectBegin \"a\" ObjectEnd",
             R"(3:13: warning: object `a` is defined again: later instances show this definition)"},
        Case{"ObjectBegin \"a\"\nObjectInstance \"a\"\nObjectEnd",
             R"(3:1: warning: an object cannot contain an instance, which is left out as in pbrt)"},
        Case{"ObjectBegin \"tree\" ObjectEnd\nObjectInstance \"tre\"",
             R"(3:16: error: no object is named `tre`; did you mean `tree`?)"},
        Case{R"(NamedMaterial "gold" Shape "sphere" Shape "sphere")",
             R"(2:15: warning: no material is named `gold`: diffuse with reflectance 0.5 stands in)"},
        Case{R"(MakeNamedMaterial "gold" "rgb reflectance" [1 1 1])",
             R"(2:19: error: material `gold` needs its type: "string type" "diffuse")"},
        Case{
            "MakeNamedMaterial \"a\" \"string type\" \"mirror\"\nMakeNamedMaterial \"a\" \"string type\" "
            "\"mirror\"",
            R"(3:19: warning: material `a` is defined again, as pbrt-v3 allows: this definition holds up to the end of the block)"},
        Case{
            R"(Attribute "shpae" "float radius" 2)",
            R"(2:11: error: unknown target "shpae" of `Attribute`; did you mean `shape`? known: shape, light, )"
            R"(material, medium, texture)"},
        Case{R"(Attribute "shape" "float radiuss" 2)", R"(2:19: error: no shape has a parameter `radiuss`)"},
        Case{R"(Include "none.pbrt")", R"(2:9: error: cannot open "none.pbrt": no such file)"},
        Case{R"(Include "scene.pbrt")", R"(2:9: error: "scene.pbrt" includes itself)"},
        Case{R"(Include ".")", R"(2:9: error: cannot read ".": not a regular file)"},
        Case{R"(Shape sphere)", R"(2:7: error: `Shape` needs a type in quotes)"},
        Case{R"(3 4)", R"(2:1: error: expected a directive, not `3`)"},
        Case{R"(Shape "sphere" 3)",
             R"(2:16: error: expected a parameter "type name" or a directive, not `3`)"}));

INSTANTIATE_TEST_SUITE_P(
    Values, ImportErrorTable,
    testing::Values(
        Case{R"(Shape "sphere" "radius" 3)",
             R"(2:16: error: expected a parameter "type name", not "radius")"},
        Case{R"(Shape "sphere" "flaot radius" 3)",
             R"(2:16: error: unknown parameter type `flaot`; did you mean `float`?)"},
        Case{R"(Shape "sphere" "float radius" "3")", R"(2:31: error: expected a number, not "3")"},
        Case{R"(Shape "sphere" "float radius" [ 1 Shape "sphere")",
             R"(2:35: error: expected a value or `]`, not `Shape`)"},
        Case{R"(Shape "sphere" "float radius")",
             R"(2:30: error: expected a number for `radius`, not the end of the file)"},
        Case{R"(Shape "sphere" "float radius" 1.2.3)", R"(2:31: error: expected a number, not `1.2.3`)"},
        Case{R"(Shape "sphere" "float radius" 1e400)",
             R"(2:31: error: `1e400` is beyond the range of floats)"},
        Case{R"(Shape "trianglemesh" "point3 P" [0 0 0 1 0 0 0 1 0] "integer indices" [0 2 0.9])",
             R"(2:76: warning: `0.9` is rounded: `indices` is an integer)"},
        Case{R"(AreaLightSource "diffuse" "bool twosided" 2)",
             R"(2:43: error: expected true or false, not `2`)"},
        Case{"Shape \"sphere", "2:7: error: this string is not closed on its line"}));

TEST_F(ImportErrors, MissingWorldBeginIsReportedOnce) {
  EXPECT_EQ(messages("Shape \"sphere\"\nShape \"sphere\"\n"),
            "scene.pbrt:1:1: error: `Shape` belongs after `WorldBegin`\nShape \"sphere\"\n^\n");
  EXPECT_EQ(messages("Scale 1 1 1\n"), "scene.pbrt: error: the file ends without `WorldBegin`\n");
}

TEST_F(ImportErrors, IgnoredParametersAreWarnedAboutOnce) {
  const std::string P = "\"point3 P\" [0 0 0 1 0 0 0 1 0]", P4 = "\"point3 P\" [0 0 0 1 0 0 0 1 0 1 1 0]";
  EXPECT_EQ(
      first_lines("Shape \"trianglemesh\" \"integer faceIndices\" 0 " + P +
                  "\nShape \"trianglemesh\" \"integer faceIndices\" 1 " + P +
                  "\nShape \"bilinearmesh\" \"integer faceIndices\" 0 " + P4),
      "2:22: warning: `faceIndices` of shape \"trianglemesh\" is ignored: numbers of the original faces\n"
      "4:22: warning: `faceIndices` of shape \"bilinearmesh\" is ignored: numbers of the original faces\n");
  EXPECT_TRUE(loaded_);
}

TEST_F(ImportErrors, ErrorsInIncludedFilesNameThoseFiles) {
  write("sub/part.pbrt", "Shape \"spere\"\n");
  EXPECT_EQ(messages("WorldBegin\nInclude \"sub/part.pbrt\"\n"),
            "sub/part.pbrt:1:7: error: unknown shape \"spere\"; did you mean `sphere`?\nShape \"spere\"\n    "
            "  ^\n");
}

TEST_F(ImportErrors, MissingFileIsReported) {
  Diagnostics d;
  EXPECT_FALSE(load_scene(folder_ / "none.pbrt", d));
  EXPECT_EQ(d.format_all(),
            "error: cannot open \"" + (folder_ / "none.pbrt").string() + "\": no such file\n");
}

}  // namespace
}  // namespace kaustik::pbrt
