// Tests which emitters replace the sky that files without light get.

#include "apps/import/view/stand_in_sky.h"

#include <cmath>
#include <limits>

#include "tests/apps/import/gltf/gltf_support.h"

namespace kaustik::pbrt {
namespace {

using testing::HasSubstr;
using testing::Not;

class StandInSky : public ImportGltf {
 protected:
  // A floor of side 2 with normal +y, and a square of side `side` at height 1 with normal -y that emits `Ke`.
  std::string floor_below(double side, const std::string& Ke) {
    write("light.mtl", "newmtl light\nKd 0 0 0\nKe " + Ke + "\nnewmtl floor\nKd 0.5 0.5 0.5\n");
    const double h = side / 2;
    return fmt::format(
        "mtllib light.mtl\nv -1 0 -1\nv -1 0 1\nv 1 0 1\nv 1 0 -1\n"
        "v -{0} 1 -{0}\nv {0} 1 -{0}\nv {0} 1 {0}\nv -{0} 1 {0}\nusemtl floor\nf 1 2 3 4\n",
        h);
  }
  SceneDescription obj(const std::string& text) { return describe(write("scene.obj", text)); }
  double share(const SceneDescription& scene) const { return emitted_share(scene, diagnostics_.files); }
};

TEST_F(StandInSky, UnusedEmissionKeepsTheSky) {
  const auto s = obj(floor_below(1, "60 60 60"));
  EXPECT_EQ(share({}), 0);
  EXPECT_EQ(share(s), std::numeric_limits<double>::infinity()) << "the sky counts as a light";
  ASSERT_EQ(s.lights.size(), 1u);
  EXPECT_EQ(s.lights[0].type, "infinite");
  EXPECT_THAT(diagnostics_.format_all(), HasSubstr("the file has no light:"));
}

// The light is small against its distance of 1: at (x, z) of the floor its area A gives the irradiance
// L A / (1 + x^2 + z^2)^2.
TEST_F(StandInSky, LightsReplaceTheSky) {
  double mean = 0;
  constexpr int kCells = 200;
  for (int i = 0; i < kCells * kCells; ++i) {
    const double x = (i % kCells + 0.5) / kCells, z = (i / kCells + 0.5) / kCells;
    mean += std::pow(1 + x * x + z * z, -2.0) / (kCells * kCells);
  }
  const auto s = obj(floor_below(0.1, "20 20 20") + "usemtl light\nf 5 6 7 8\n");
  EXPECT_TRUE(s.lights.empty());
  EXPECT_THAT(diagnostics_.format_all(), Not(HasSubstr("no light")));
  const double expected = 20 * 0.01 * mean / 3.14159265;
  // Of 2,048 points, the integrand's standard deviation being below its mean: five standard errors are 11 %.
  // The light itself is left out, for it is bright.
  EXPECT_NEAR(share(s), expected, 0.11 * expected);
}

TEST_F(StandInSky, FaintLightsKeepIt) {
  const auto s = obj(floor_below(0.1, "1 1 1") + "usemtl light\nf 5 6 7 8\n");
  ASSERT_EQ(s.lights.size(), 1u);
  EXPECT_EQ(s.area_lights.size(), 1u) << "the emitters glow nevertheless";
  EXPECT_THAT(diagnostics_.format_all(), HasSubstr("the file has no light that reaches its surfaces:"));
}

// The same light turned round lights nothing.
TEST_F(StandInSky, EmittersThatFaceAwayKeepIt) {
  const auto s = obj(floor_below(1, "60 60 60") + "usemtl light\nf 8 7 6 5\n");
  EXPECT_EQ(s.lights.size(), 1u);
}

TEST_F(StandInSky, ABrightThingAloneNeedsNoSky) {
  const auto s = describe(triangle(R"({ "emissiveFactor": [ 1, 1, 1 ], "extensions": {
      "KHR_materials_emissive_strength": { "emissiveStrength": 5 } } })"));
  EXPECT_TRUE(s.lights.empty());
}

TEST_F(StandInSky, PunctualLightsReplaceIt) {
  const auto s = describe(gltf(std::string(kTriangleParts) + R"("materials": [ {} ], "nodes": [ { "mesh": 0,
      "extensions": { "KHR_lights_punctual": { "light": 0 } } } ], "extensions": { "KHR_lights_punctual": {
      "lights": [ { "type": "point" } ] } })"));
  ASSERT_EQ(s.lights.size(), 1u);
  EXPECT_EQ(s.lights[0].type, "point");
}

// One of 64 pixels emits: the image counts with its mean, here below the least share though its brightest
// pixel is far above.
TEST_F(StandInSky, EmissionImagesCountWithTheirMean) {
  for (const int lit : {1, 64}) {
    std::string image = "P3 8 8 255\n";
    for (int i = 0; i < 64; ++i) image += i < lit ? "255 255 255\n" : "0 0 0\n";
    write("glow.ppm", image);
    const std::string text = floor_below(1, "2 2 2") + "usemtl light\nf 5 6 7 8\n";
    write("light.mtl", "newmtl light\nKd 0 0 0\nKe 2 2 2\nmap_Ke glow.ppm\nnewmtl floor\nKd 0.5 0.5 0.5\n");
    const auto s = obj(text);
    EXPECT_EQ(s.area_lights.size(), 1u);
    EXPECT_EQ(s.lights.empty(), lit == 64);
  }
}

}  // namespace
}  // namespace kaustik::pbrt
