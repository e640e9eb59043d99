// Tests what pbrt itself would only warn about: such files render with the nearest thing.

#include <gmock/gmock.h>

#include "core/scene/bsdf_at.h"
#include "tests/apps/import/import_support.h"

namespace kaustik::pbrt {
namespace {

using testing::HasSubstr;

class ImportRepairs : public ImportTest {
 protected:
  // The scene of a whole file, and the warnings about it.
  Scene scene(const std::string& text) { return load(text).scene; }
  std::string warnings() const {
    EXPECT_FALSE(diagnostics_.has_errors()) << diagnostics_.format_all();
    return diagnostics_.format_all();
  }
  Bsdf bsdf(const std::string& material) {
    const Scene s = world(material + " Shape \"sphere\"");
    return s.materials[s.shapes.at(0).material].typical();
  }
  Rgb reflectance(const std::string& material) { return std::get<Lambertian>(bsdf(material)).reflectance; }
};

// What the picture does not depend on.
TEST_F(ImportRepairs, UnknownSettingsAreWarnings) {
  const Scene s = scene(R"(Sampler "adaptive" "integer minsamples" 4 "integer maxsamples" 64
    Accelerator "grid" "bool refineimmediately" "true"
    PixelFilter "blackmanharris" "float xwidth" 2
    Film "png" "integer xresolution" 30 "integer yresolution" [ 20 ] "string display" "x"
    Option "wavefrontt" true
    ColorSpace "adobe"
    Camera "perspective" "float fov" 40 "float iso" 5
    WorldBegin Shape "sphere")");
  EXPECT_EQ(s.camera.width, 30);
  for (const std::string said :
       {"unknown sampler \"adaptive\": \"zsobol\" stands in",
        "unknown accelerator \"grid\": \"bvh\" stands in",
        "unknown pixel filter \"blackmanharris\": \"gaussian\" stands in",
        "unknown film \"png\": \"rgb\" stands in",
        "film \"rgb\" has no parameter `display`, which is ignored",
        "unknown option `wavefrontt` is ignored; did you mean `wavefront`?",
        "unknown color space \"adobe\": \"srgb\" remains", "camera \"perspective\" has no parameter `iso`"})
    EXPECT_THAT(warnings(), HasSubstr(said));
  const auto description = load("Sampler \"adaptive\" \"integer maxsamples\" 64 WorldBegin").description;
  EXPECT_EQ(description.sampler->find("pixelsamples")->numbers[0], 64);
}

TEST_F(ImportRepairs, UnknownMaterialsKeepTheirColour) {
  EXPECT_EQ(reflectance(R"(Material "toon" "rgb Kd" [ .25 .5 .75 ] "float rim" 3)"), Rgb(.25f, .5f, .75f));
  EXPECT_THAT(warnings(), HasSubstr("unknown material \"toon\": \"diffuse\" stands in"));
  EXPECT_EQ(diagnostics_.warning_count(), 1u);
  EXPECT_TRUE(
      std::holds_alternative<CoatedDiffuse>(bsdf(R"(Material "subsurfaceSPPM" "string name" "Skin1")")));
  EXPECT_TRUE(std::holds_alternative<Conductor>(bsdf(R"(Material "shinymetal" "color Kr" [ .25 .5 .75 ])")));
}

// pbrt-v3 does not darken a picture by the time for which its shutter is open, and its pictures are smaller.
TEST_F(ImportRepairs, FilmsOfVersion3HaveItsDefaults) {
  const Scene s = scene(R"(Film "image" Camera "perspective" "float shutterclose" .25 WorldBegin)");
  EXPECT_TRUE(s.sensor.neutral);
  EXPECT_EQ(s.camera.width, 640);
  EXPECT_EQ(s.camera.height, 480);
  scene(R"(Film "rgb" Camera "perspective" "float shutteropen" 0 "float shutterclose" 0 WorldBegin)");
  EXPECT_THAT(warnings(), HasSubstr("the shutter opens for no time: one second is taken"));
}

// No surface at all.
TEST_F(ImportRepairs, MaterialsWithoutANameAreNone) {
  const Scene s = world(R"(AttributeBegin Material "" Shape "sphere" AttributeEnd
    MakeNamedMaterial "gone" "string type" "" NamedMaterial "gone" Shape "sphere")");
  EXPECT_TRUE(s.shapes.empty());
  EXPECT_THAT(warnings(), HasSubstr("pbrt-v3's material \"\" becomes \"interface\""));
}

TEST_F(ImportRepairs, UndefinedNamesKeepDefaults) {
  EXPECT_EQ(reflectance(R"(Texture "wood" "spectrum" "constant" Material "matte" "texture Kd" "wod" )"
                        R"(Material "matte" "texture Kd" "wod")"),
            Rgb(0.5f));
  EXPECT_THAT(warnings(),
              HasSubstr("no texture is named `wod` up to here: `Kd` keeps its default; did you mean "
                        "`wood`? (and 1 more)"));
  EXPECT_EQ(reflectance(R"(NamedMaterial "gold")"), Rgb(0.5f));
  EXPECT_THAT(warnings(), HasSubstr("no material is named `gold`: diffuse with reflectance 0.5 stands in"));
}

TEST_F(ImportRepairs, ValuesOfOtherTypesAreRead) {
  EXPECT_EQ(reflectance(R"(Material "diffuse" "float reflectance" .25)"), Rgb(0.25f));
  EXPECT_EQ(reflectance(R"(Material "diffuse" "rgb reflectance" .25)"), Rgb(0.25f));
  EXPECT_EQ(reflectance(R"(Material "diffuse" "rgb reflectance" [ .25 .5 1.5 1 ])"), Rgb(.25f, .5f, 1));
  EXPECT_EQ(std::get<Dielectric>(bsdf(R"(Material "dielectric" "rgb eta" [ 1 2 3 ])")).eta, 2);
  EXPECT_THAT(warnings(),
              HasSubstr("\"rgb eta\" with 3 values of material \"dielectric\" is read as \"float eta\""));
  const Scene s = world(R"(Shape "sphere" "integer radius" 2 Shape "sphere" "integer radius" 3
    AreaLightSource "diffuse" "string twosided" "true"
    Shape "trianglemesh" "point3 P" [ 0 0 0 1 0 0 0 1 0 ] "float indices" [ 0 1 2 ] "float N" [ 0 0 1 0 0 1 0 0 1 ])");
  EXPECT_NEAR(s.bounds.max.x, 3, 1e-5f);  // with room for rounding
  EXPECT_TRUE(std::get<DiffuseAreaLight>(s.lights.at(0)).twosided);
  EXPECT_THAT(warnings(),
              HasSubstr("\"integer radius\" of shape \"sphere\" is read as \"float radius\" (and 1 more)"));
}

TEST_F(ImportRepairs, TexturesOfTheOtherTypeStandIn) {
  const Scene s = world(R"(Texture "t" "float" "constant" "float value" .25
    Material "diffuse" "texture reflectance" "t" Shape "sphere")");
  SurfaceInteraction si = make_interaction(s.shapes, {{0, 0, 2}, {0, 0, -1}}, {1, 0, 0, {}});
  EXPECT_EQ(std::get<Lambertian>(*BsdfAt(s, si, {0, 0, 1})).reflectance, Rgb(0.25f));
}

// The file's name says what was measured.
TEST_F(ImportRepairs, MeasuredMaterialsAreGuessedFromTheirFiles) {
  EXPECT_TRUE(std::holds_alternative<Conductor>(
      bsdf(R"(Material "fourier" "string bsdffile" "a/coated_copper.bsdf")")));
  EXPECT_THAT(warnings(),
              HasSubstr("the measured BSDF \"a/coated_copper.bsdf\" is not read: \"conductor\" of Cu "
                        "stands in, after the file's name"));
  const auto glass =
      std::get<Dielectric>(bsdf(R"(Material "fourier" "string bsdffile" "roughglass_alpha_0.1.bsdf")"));
  EXPECT_FLOAT_EQ(glass.facets.alpha_x, 0.1f);
  EXPECT_TRUE(
      std::holds_alternative<CoatedDiffuse>(bsdf(R"(Material "measured" "string filename" "ceramic.bsdf")")));
  EXPECT_TRUE(std::holds_alternative<Lambertian>(bsdf(R"(Material "measured" "string filename" "x.bsdf")")));
}

// The inverse of the reflectance of a head of hair: sigma_a = (ln c / 5.969)^2 for beta_n = 0.
TEST_F(ImportRepairs, HairHasTheColourOfItsAbsorption) {
  const Rgb c = reflectance(R"(Material "hair" "float beta_n" 0 "rgb sigma_a" [ 0 0.0134851 0.0134851 ])");
  EXPECT_EQ(c.x, 1);
  EXPECT_NEAR(c.y, 0.5, 1e-4);  // ln 2 / 5.969 squared, to six digits
  EXPECT_EQ(reflectance(R"(Material "hair" "rgb color" [ .25 .5 .75 ])"), Rgb(.25f, .5f, .75f));
}

TEST_F(ImportRepairs, LaterObjectsReplaceEarlierOnes) {
  const Scene s = world(R"(ObjectBegin "a" Shape "sphere" ObjectEnd ObjectInstance "a"
    ObjectBegin "a" Shape "disk" ObjectEnd ObjectInstance "a" ObjectInstance "a")");
  ASSERT_EQ(s.shapes.size(), 3u);
  EXPECT_TRUE(std::holds_alternative<Sphere>(s.shapes[0].geometry));
  EXPECT_TRUE(std::holds_alternative<Disk>(s.shapes[1].geometry));
  EXPECT_TRUE(std::holds_alternative<Disk>(s.shapes[2].geometry));
}

TEST_F(ImportRepairs, FlatShapesAndInstancesAreLeftOut) {
  const Scene s = world(R"(Shape "sphere" ObjectBegin "a" Shape "sphere" ObjectEnd
    Scale 1 0 1 Shape "sphere" Shape "disk" ObjectInstance "a")");
  EXPECT_EQ(s.shapes.size(), 1u);
  EXPECT_THAT(warnings(),
              HasSubstr("the transform of this shape has no inverse: it is left out (2 shapes in all)"));
  EXPECT_THAT(warnings(), HasSubstr("the transform of this instance has no inverse: it is left out"));
}

TEST_F(ImportRepairs, HolesOfMeshesAreLeftOut) {
  const Scene s = world(R"(Shape "trianglemesh" "point3 P" [ 0 0 0 1 0 0 0 1 0 nan -nan inf ]
    "integer indices" [ 0 1 2 0 1 3 ] "normal N" [ nan nan nan nan nan nan nan nan nan 0 0 1 ])");
  const TriangleMesh& mesh = *s.shapes.at(0).mesh();
  EXPECT_EQ(mesh.indices.size(), 1u);
  const SurfaceInteraction si = make_interaction(s.shapes, {}, {1, 0, 0, {0.25f, 0.25f}});
  EXPECT_EQ(si.ns, Normal3(0, 0, 1));
  EXPECT_THAT(warnings(), HasSubstr("1 of 2 triangles have a position that is not finite and are left out"));
  EXPECT_THAT(warnings(), HasSubstr("3 of 4 normals are not finite: those of the faces stand in"));
}

TEST_F(ImportRepairs, EmptyMeshesAreLeftOut) {
  const Scene s = world(R"(Shape "trianglemesh" "point3 P" [ ] "integer indices" [ ] Shape "sphere")");
  EXPECT_EQ(s.shapes.size(), 1u);
  EXPECT_THAT(warnings(), HasSubstr("a shape with an empty list `P` is left out"));
}

TEST_F(ImportRepairs, FilesOfVersion2SayThatTheyAre) {
  const Scene s = scene(R"(Renderer "sampler" SurfaceIntegrator "photonmap" "integer causticphotons" 10
    VolumeIntegrator "single" Sampler "lowdiscrepancy" "integer pixelsamples" 4 Camera "perspective"
    WorldBegin Volume "homogeneous" "color sigma_a" [ 1 1 1 ]
    Material "shinymetal" "color Kr" [ .25 .5 .75 ] Shape "sphere" WorldEnd)");
  EXPECT_EQ(s.shapes.size(), 1u);
  EXPECT_THAT(warnings(),
              HasSubstr("`Renderer` makes this a file of pbrt-v2: it is read as one of pbrt-v3, without "
                        "integrators, renderers and volumes (and 3 more)"));
}

// A light that no closed form samples by area shines as triangles, whose area is within 0.1 % of it. The area
// of this spheroid with the axes 1, 1, 2 is 2 pi (1 + 2 asin(e) / e) for e = sqrt(3) / 2.
TEST_F(ImportRepairs, SquashedSpheresShine) {
  const Scene s = world(R"(Scale 1 1 2 AreaLightSource "diffuse" Shape "sphere")");
  const double e = std::sqrt(0.75), area = 2 * double(kPi) * (1 + 2 * std::asin(e) / e);
  EXPECT_NEAR(double(std::get<DiffuseAreaLight>(s.lights.at(0)).area), area, 1e-3 * area);
}

}  // namespace
}  // namespace kaustik::pbrt
