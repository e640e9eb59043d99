// Tests features of pbrt that kaustik approximates.

#include <gmock/gmock.h>

#include "core/bsdf/bsdf.h"
#include "tests/apps/import/gzipped.h"
#include "tests/apps/import/import_support.h"

namespace kaustik::pbrt {
namespace {

using testing::HasSubstr;

class ImportApproximations : public ImportTest {
 protected:
  Bsdf bsdf(const std::string& material) {
    const Scene s = world(material + " Shape \"sphere\"");
    EXPECT_TRUE(s.materials[0].constant());
    return s.materials[0].typical();
  }
};

// For metal in a coat of index n the reflectance uses the ratio: ((1 - n/eta)^2 + k^2) / ((1 + n/eta)^2 +
// k^2).
TEST_F(ImportApproximations, CoatedConductorsBecomeMetalSeenThroughTheCoat) {
  const auto metal = std::get<Conductor>(
      bsdf(R"(Material "coatedconductor" "rgb conductor.eta" [ .3 .6 .9 ] "rgb conductor.k" [ 3 1.5 6 ]
              "float conductor.roughness" .25 "float interface.roughness" .1 "rgb albedo" [ .1 .1 .1 ])"));
  EXPECT_FLOAT_EQ(metal.eta.x, 0.2f);
  EXPECT_FLOAT_EQ(metal.k.z, 4.0f);
  EXPECT_FLOAT_EQ(metal.facets.alpha_x, 0.5f);  // alpha is the root of the roughness
  EXPECT_THAT(diagnostics_.format_all(), HasSubstr("material \"coatedconductor\" is approximated: as metal"));
}

// The given share of the light that enters comes back out: of even light (1 - F) Rd leaves, and F is
// reflected.
TEST_F(ImportApproximations, SubsurfaceKeepsItsReflectance) {
  const auto skin = std::get<CoatedDiffuse>(
      bsdf(R"(Material "subsurface" "rgb reflectance" [ .75 .5 .25 ] "float eta" 1.4 "float scale" 10)"));
  const double F = fresnel_diffuse(1.4);
  const Rgb albedo = skin.albedo();
  EXPECT_NEAR(albedo.x, F + (1 - F) * 0.75, 1e-5);
  EXPECT_NEAR(albedo.z, F + (1 - F) * 0.25, 1e-5);
}

TEST_F(ImportApproximations, SubsurfaceFromMediaKeepsItsAlbedo) {
  const auto white = std::get<CoatedDiffuse>(bsdf(R"(Material "subsurface" "string name" "Spectralon")"));
  EXPECT_NEAR(white.albedo().y, 1, 1e-5);
  const auto ink = std::get<CoatedDiffuse>(
      bsdf(R"(Material "subsurface" "rgb sigma_a" [ 1 0 1 ] "rgb sigma_s" [ 0 1 1 ] "float eta" 1)"));
  EXPECT_EQ(ink.albedo().x, 0.0f);
  EXPECT_NEAR(ink.albedo().y, 1, 1e-5);  // no absorption
  // Jensen's formula for albedo 1/2 without a boundary: A = 1.
  const double root = std::sqrt(1.5);
  EXPECT_NEAR(ink.albedo().z, 0.25 * (1 + std::exp(-4 * root / 3)) * std::exp(-root), 1e-6);
}

TEST_F(ImportApproximations, OtherFilmsBecomeRgbFilms) {
  EXPECT_THAT(
      messages(
          "Film \"gbuffer\" \"integer xresolution\" 8 \"string coordinatesystem\" \"camera\"\nWorldBegin"),
      HasSubstr("film \"gbuffer\" is approximated: as \"rgb\""));
  EXPECT_TRUE(loaded_);
}

// One thin element of radii 50 mm and -50 mm and index 1.5 before a plane stop: 1/f = 0.5 (1/50 + 1/50). The
// film has the ratio 3 : 4 and a diagonal of 50 mm, so it is 30 mm high.
TEST_F(ImportApproximations, LensSystemsBecomeThinLenses) {
  write("lens.dat", "# radius, thickness, index, diameter\n50 0 1.5 20\n-50 0 1 20\n0 1 0 10\n");
  Diagnostics diagnostics;
  const auto scene = import_scene(write("scene.pbrt", R"(
    Camera "realistic" "string lensfile" "lens.dat" "float focusdistance" 0.1 "float aperturediameter" 8
    Film "rgb" "integer xresolution" 400 "integer yresolution" 300 "float diagonal" 50
    WorldBegin)"),
                                  diagnostics);
  ASSERT_TRUE(scene && !diagnostics.has_errors()) << diagnostics.format_all();
  EXPECT_EQ(scene->camera->type, "perspective");
  // An object at twice the focal length is in focus as far behind the lens: 100 mm.
  EXPECT_NEAR(scene->camera->find("fov")->numbers[0], glm::degrees(2 * std::atan(0.15)), 1e-9);
  EXPECT_NEAR(scene->camera->find("lensradius")->numbers[0], 0.004, 1e-12);
  EXPECT_NEAR(scene->camera->find("focaldistance")->numbers[0], 0.1, 1e-12);
  write("lens.dat", "50 0 1.5 20 1");
  EXPECT_THAT(messages("Camera \"realistic\" \"string lensfile\" \"lens.dat\"\nWorldBegin"),
              HasSubstr("scene.pbrt:1:38: error: a lens has rows of radius"));
  EXPECT_EQ(diagnostics_.error_count(), 1u);
}

TEST_F(ImportApproximations, MotionIsTakenAtTheShuttersOpening) {
  const Scene s = world(R"(AttributeBegin ActiveTransform StartTime Translate 1 0 0
    ActiveTransform EndTime Translate 0 5 0 ActiveTransform All Translate 0 0 2 Shape "sphere" AttributeEnd)");
  EXPECT_EQ(std::get<Sphere>(s.shapes[0].geometry).to_world.point({0, 0, 0}), Point3(1, 0, 2));
}

// A sky has directions only, so a scale or translation in its matrix has no effect.
TEST_F(ImportApproximations, SkiesKeepOnlyTheRotation) {
  const Scene s = world(R"(Transform [ 0 1 0 3 -1 0 0 0 0 0 1 8.87 5 5 5 1 ] LightSource "infinite"
    LightSource "distant")");
  EXPECT_EQ(s.lights.size(), 2u);
}

TEST_F(ImportApproximations, IncludedFilesMayBeGzipped) {
  write("part.pbrt.gz", gzipped("Shape \"sphere\"\nShape \"disk\"\n"));
  EXPECT_EQ(world("Include \"part.pbrt.gz\"").shapes.size(), 2u);
}

}  // namespace
}  // namespace kaustik::pbrt
