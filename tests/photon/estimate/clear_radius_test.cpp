// Tests that discs are narrower where other surfaces are near, as the clearance says.

#include "photon/estimate/clear_radius.h"

#include <gtest/gtest.h>

#include "tests/support/shapes.h"

namespace kaustik::photon {
namespace {

using namespace test;

// A floor, y = 0, and a ceiling above it; both large.
Scene floor_and_ceiling(float height) {
  Scene scene;
  scene.materials.push_back(Lambertian{Rgb(0.5f)});
  scene.material_names.push_back("grey");
  const float s = 1000 * height;
  scene.shapes = {quad({-s, 0, -s}, {-s, 0, s}, {s, 0, s}, {s, 0, -s}, 0),
                  quad({-s, height, -s}, {s, height, -s}, {s, height, s}, {-s, height, s}, 0)};
  for (uint32_t i = 0; i < 2; ++i) {
    scene.shapes[i].surface_group = i;
    scene.surface_group_names.push_back("group " + std::to_string(i));
  }
  finalize_scene(scene);
  return scene;
}

float radius_on_floor(float height, float widest, double photons) {
  const Scene scene = floor_and_ceiling(height);
  const accel::Bvh bvh(scene);
  SurfaceInteraction si;
  EXPECT_TRUE(bvh.intersect({{0.1f * height, 0.5f * height, 0}, {0, -1, 0}}, &si));
  return ClearRadius(bvh, widest, photons).at(si, {0, 1, 0});
}

// Below a ceiling at the height h, the mean of 1 / t over cosine-weighted directions is that of cos / h, 2 /
// 3h. So c = 1.5 h, and r^6 = c^4 / (2 b^2 n pi) with b = 0.7 and n pi = photons / widest^2. Sixteen
// directions give the mean within 2 %, r within 2 %.
TEST(ClearRadius, BelowACeilingIsThatOfTheClosedForm) {
  constexpr double kPhotons = 4000, kWidest = 1, kHeight = 3;
  const double r = std::pow(std::pow(1.5 * kHeight, 4) / (2 * 0.49 * kPhotons), 1.0 / 6);
  ASSERT_GT(r, 0.5);
  ASSERT_LT(r, 1);
  EXPECT_NEAR(double(radius_on_floor(float(kHeight), float(kWidest), kPhotons)), r, 0.02 * r);
}

TEST(ClearRadius, IsTheWidestFarFromAllAndTheNarrowestInACrack) {
  EXPECT_EQ(radius_on_floor(1e4f, 1, 4000), 1);
  EXPECT_EQ(radius_on_floor(1e-3f, 1, 4000), 0.375f);
}

TEST(ClearRadius, ScalesWithTheScene) {
  EXPECT_EQ(radius_on_floor(3 * 1024, 1024, 4000), 1024 * radius_on_floor(3, 1, 4000));
}

}  // namespace
}  // namespace kaustik::photon
