// Tests scenes in the format of pbrt-v3.

#include <gmock/gmock.h>

#include "core/spectrum/colour_space.h"
#include "tests/apps/import/import_support.h"

namespace kaustik::pbrt {
namespace {

class ImportV3 : public ImportTest {
 protected:
  MaterialDescription material(const std::string& text) {
    return describe("WorldBegin\n" + text).materials.at(0);
  }
};

std::vector<double> numbers(const Directive& d, std::string_view name) {
  const Parameter* p = d.find(name);
  return p ? p->numbers : std::vector<double>{};
}

using testing::ElementsAre;
using testing::HasSubstr;

TEST_F(ImportV3, MatteBecomesDiffuse) {
  const auto plain = material("Material \"matte\" \"color Kd\" [ .1 .2 .3 ]");
  EXPECT_EQ(plain.type, "diffuse");
  EXPECT_THAT(numbers(plain, "reflectance"), ElementsAre(.1, .2, .3));
  EXPECT_EQ(diagnostics_.warning_count(), 1u);
  EXPECT_THAT(diagnostics_.format_all(), HasSubstr("pbrt-v3's material \"matte\" becomes \"diffuse\""));
  EXPECT_EQ(material("Material \"matte\" \"float sigma\" 20").type, "orennayar");
}

// Each kind of change gives one warning, however often it occurs.
TEST_F(ImportV3, WarnsOncePerKindOfChange) {
  describe("WorldBegin Material \"matte\" Material \"matte\" Material \"glass\" Material \"glass\"");
  EXPECT_EQ(diagnostics_.warning_count(), 2u);
}

// By v3's polynomial (microfacet.h) roughness 1 has the width 1.62142; the v4 scene must not remap it again.
TEST_F(ImportV3, PlasticKeepsItsWidth) {
  const auto m =
      material("Material \"plastic\" \"rgb Kd\" [ .4 .4 .4 ] \"rgb Ks\" [ .2 .2 .2 ] \"float roughness\" 1");
  EXPECT_EQ(m.type, "coateddiffuse");
  EXPECT_THAT(numbers(m, "reflectance"), ElementsAre(.4, .4, .4));
  EXPECT_THAT(numbers(m, "roughness"), ElementsAre(1.62142));
  EXPECT_THAT(numbers(m, "remaproughness"), ElementsAre(0));
  EXPECT_FALSE(m.find("Ks"));
  const auto kept =
      material("Material \"plastic\" \"float roughness\" .25 \"bool remaproughness\" \"false\"");
  EXPECT_THAT(numbers(kept, "roughness"), ElementsAre(.25));
}

TEST_F(ImportV3, GlassAndMetalAreConverted) {
  const auto glass =
      material("Material \"glass\" \"float index\" 1.33 \"rgb Kr\" [ 1 1 1 ] \"rgb Kt\" [ 1 1 1 ]");
  EXPECT_EQ(glass.type, "dielectric");
  EXPECT_THAT(numbers(glass, "eta"), ElementsAre(1.33));
  EXPECT_THAT(numbers(glass, "roughness"), ElementsAre(0));
  EXPECT_FALSE(glass.find("Kr") || glass.find("Kt"));
  EXPECT_THAT(numbers(material("Material \"glass\" \"rgb Kr\" [ .1 .2 .3 ]"), "reflectance"),
              ElementsAre(.1, .2, .3));
  EXPECT_THAT(numbers(material("Material \"glass\" \"rgb Kt\" [ .4 .5 2 ]"), "transmittance"),
              ElementsAre(.4, .5, 1));
  const auto metal =
      material("Material \"metal\" \"spectrum eta\" \"metal-Ag-eta\" \"spectrum k\" \"metal-Ag-k\"");
  EXPECT_EQ(metal.type, "conductor");
  EXPECT_EQ(metal.find("eta")->type, ParameterType::kRgb);
  EXPECT_EQ(numbers(metal, "roughness").size(), 1u);
}

TEST_F(ImportV3, OtherMaterialsAreConverted) {
  EXPECT_THAT(numbers(material("Material \"mirror\" \"rgb Kr\" [ .9 .8 .7 ]"), "reflectance"),
              ElementsAre(.9, .8, .7));
  EXPECT_EQ(material("Material \"uber\" \"rgb Kd\" 0 \"rgb Kt\" [ 1 1 1 ]").type, "dielectric");
  EXPECT_EQ(material("Material \"uber\"").type, "coateddiffuse");
  EXPECT_EQ(material("Material \"substrate\" \"float uroughness\" .1 \"float vroughness\" .2").type,
            "coateddiffuse");
  EXPECT_EQ(material("Material \"none\"").type, "interface");
  EXPECT_EQ(material("Material \"disney\" \"float metallic\" 1 \"rgb color\" [ .5 .4 .3 ]").type,
            "conductor");
  const auto sheet = material("Material \"translucent\" \"rgb Kd\" [ .4 .6 .8 ] \"rgb transmit\" [ 1 .5 0 ]");
  EXPECT_EQ(sheet.type, "diffusetransmission");
  EXPECT_THAT(numbers(sheet, "reflectance"), ElementsAre(.2, .3, .4));
  EXPECT_THAT(numbers(sheet, "transmittance"), ElementsAre(.4, .3, 0));
  const auto mix = material(
      "MakeNamedMaterial \"m\" \"string type\" \"mix\" \"rgb amount\" [ .25 .25 .25 ] "
      "\"string namedmaterial1\" \"a\" \"string namedmaterial2\" \"b\"");
  EXPECT_THAT(mix.find("materials")->strings, ElementsAre("b", "a"));
  EXPECT_THAT(numbers(mix, "amount"), ElementsAre(.25));
  const auto skin = material("Material \"kdsubsurface\" \"rgb Kd\" [ .5 .4 .3 ] \"rgb mfp\" [ 1 1 1 ]");
  EXPECT_EQ(skin.type, "subsurface");
  EXPECT_THAT(numbers(skin, "reflectance"), ElementsAre(.5, .4, .3));
  EXPECT_EQ(material("Material \"fourier\" \"string bsdffile\" \"x.bsdf\"").type, "measured");
}

// Typical output of exporters to v3: coordinates as floats, cameras in all directions, projectors with a
// colour.
TEST_F(ImportV3, OlderKeywordsAreRendered) {
  load(R"(Camera "environment" WorldBegin
    Shape "trianglemesh" "point P" [ 0 0 0 1 0 0 0 1 0 ] "integer indices" [ 0 1 2 ]
      "float uv" [ 0 0 1 0 0 1 ]
    Texture "uv" "color" "uv"
    Material "matte" "texture Kd" "uv"
    Shape "loopsubdiv" "integer nlevels" 1 "integer indices" [ 0 1 2 ] "point P" [ 0 0 0 1 0 0 0 1 0 ])");
  EXPECT_THAT(diagnostics_.format_all(), HasSubstr("`float uv` of pbrt-v3's `Shape` becomes `point2 uv`"));
  const auto s = describe("Camera \"environment\" WorldBegin LightSource \"projection\" \"rgb I\" [ 2 2 2 ]");
  EXPECT_EQ(s.camera->type, "spherical");
  EXPECT_EQ(s.camera->find("mapping")->strings[0], "equirectangular");
  EXPECT_NEAR(numbers(s.lights[0], "scale").at(0), 2, 1e-12);  // the weights add up to one
}

TEST_F(ImportV3, WholeFileIsConverted) {
  const auto s = describe(R"(Film "image" "integer xresolution" 64 "integer yresolution" 32 "float scale" 2
    Sampler "lowdiscrepancy" "integer pixelsamples" 4
    Integrator "path" "integer maxdepth" 3
    PixelFilter "box" "float xwidth" 0.5 "float ywidth" 0.5
    Camera "perspective" "float fov" 40
    WorldBegin
    LightSource "point" "color I" [ 1 2 3 ] "rgb scale" [ 2 2 2 ] "integer nsamples" 4
    LightSource "distant" "xyz L" [ 0.9504 1 1.0889 ] "rgb scale" [ 1 .5 .25 ]
    AreaLightSource "area" "blackbody L" [ 5000 2 ] "integer samples" 2
    Material "matte"
    Shape "trianglemesh" "point P" [ 0 0 0 1 0 0 0 1 0 ] "integer indices" [ 0 1 2 ] "float st" [ 0 0 1 0 0 1 ]
    WorldEnd)");
  EXPECT_EQ(s.film->type, "rgb");
  EXPECT_THAT(numbers(*s.film, "iso"), ElementsAre(200));
  EXPECT_EQ(s.sampler->type, "paddedsobol");
  EXPECT_TRUE(s.filter->find("xradius"));
  EXPECT_THAT(numbers(s.lights[0], "scale"), ElementsAre(2));
  EXPECT_EQ(s.lights[0].find("scale")->type, ParameterType::kFloat);
  EXPECT_FALSE(s.lights[0].find("nsamples"));
  // The white of D65, to the four digits above, times the scale.
  EXPECT_NEAR(numbers(s.lights[1], "L")[0], 1, 5e-4);
  EXPECT_NEAR(numbers(s.lights[1], "L")[1], 0.5, 5e-4);
  EXPECT_NEAR(numbers(s.lights[1], "L")[2], 0.25, 5e-4);
  EXPECT_EQ(s.area_lights[0].type, "diffuse");
  EXPECT_TRUE(s.shapes[0].find("uv"));
}

// v3's name of grids, and its coefficients.
TEST_F(ImportV3, HeterogeneousMediaBecomeGrids) {
  const auto medium = [&](const std::string& more) {
    return describe("MakeNamedMedium \"m\" \"string type\" \"heterogeneous\" " + more + "\nWorldBegin")
        .media.at(0);
  };
  const auto plain = medium("\"color sigma_s\" [ 3 4 5 ] \"float density\" 1");
  EXPECT_EQ(plain.type, "uniformgrid");
  EXPECT_THAT(numbers(plain, "sigma_s"), ElementsAre(3, 4, 5));
  EXPECT_THAT(numbers(plain, "sigma_a"), ElementsAre(.0011, .0024, .014));
  EXPECT_FALSE(medium("\"string preset\" \"Coke\" \"float density\" 1").find("sigma_a"));
}

}  // namespace
}  // namespace kaustik::pbrt
