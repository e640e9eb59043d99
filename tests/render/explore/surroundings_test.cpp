// Tests clearances between two planes, where they have a closed form, and below a bright patch.

#include "render/explore/surroundings.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/render/support/test_scenes.h"

namespace kaustik::render {
namespace {

using namespace test;

// A floor of side 200 under a ceiling at height 1, or under the open sky, seen around the origin.
Scene two_planes(bool ceiling, float scale = 1) {
  Scene scene;
  const uint32_t white = add_material(scene, Lambertian{Rgb(0.5f)});
  add_shape(scene, horizontal({0, 0, 0}, 100 * scale, 100 * scale, true, white));
  if (ceiling) add_shape(scene, horizontal({0, scale, 0}, 100 * scale, 100 * scale, false, white));
  look_at(scene, {-0.2f * scale, 0.4f * scale, 0}, {0, 0, 0}, {0, 1, 0}, 60, 32, 32);
  finalize_scene(scene);
  return scene;
}

Surroundings surroundings_of(const Scene& scene) {
  const accel::Bvh bvh(scene);
  const RenderSettings settings;
  const EstimatorPlan plan;
  return Surroundings({scene, bvh, settings, plan});
}

// Under a plane at height 1 the distance in direction theta is 1 / cos(theta), whose inverse has the mean 2/3
// over a cosine-weighted hemisphere and the variance 1/2 - 4/9. A cell has at least 4 points of 16 rays,
// which are stratified; the share of the sky beyond the ceiling's border is 1e-4.
TEST(Surroundings, ClearanceUnderACeilingIsOneAndAHalfTimesItsHeight) {
  const Surroundings found = surroundings_of(two_planes(true));
  const double deviation = std::sqrt((1 / 2.0 - 4 / 9.0) / 64);
  for (const float x : {-0.05f, 0.0f, 0.04f})
    EXPECT_NEAR(1 / double(found.at({x, 0, 0}, {0, 1, 0}).clearance), 2 / 3.0, 4 * deviation);
}

// A low black ceiling with a slit, above which a white patch is lit: all light comes from the patch, however
// rarely a ray meets it.
TEST(Surroundings, LitClearanceIsTheDistanceOfTheOnlyBrightSurface) {
  Scene scene;
  const uint32_t white = add_material(scene, Lambertian{Rgb(0.5f)});
  const uint32_t black = add_material(scene, Lambertian{Rgb(0)});
  add_shape(scene, horizontal({0, 0, 0}, 100, 100, true, white));
  for (const float side : {-1.0f, 1.0f})
    add_shape(scene, horizontal({50.05f * side, 0.3f, 0}, 50, 100, false, black));
  add_shape(scene, horizontal({0, 1, 0}, 0.4f, 0.4f, false, white));
  scene.lights.push_back(PointLight{{0, 0.75f, 0}, Rgb(1)});
  look_at(scene, {-0.1f, 0.2f, 0}, {0, 0, 0}, {0, 1, 0}, 60, 32, 32);
  finalize_scene(scene);
  const Place place = surroundings_of(scene).at({0, 0, 0}, {0, 1, 0});
  EXPECT_GE(place.lit_clearance, 1);
  EXPECT_LE(place.lit_clearance, std::sqrt(2.0f));  // to a point of the patch, seen from one near the middle
  EXPECT_LT(place.clearance, 1);
}

TEST(Surroundings, IsInfiniteInTheOpenAndUnknownElsewhere) {
  const Surroundings found = surroundings_of(two_planes(false));
  EXPECT_EQ(found.at({0, 0, 0}, {0, 1, 0}).clearance, kInfinity);
  EXPECT_EQ(found.at({0, 0, 0}, {0, -1, 0}).clearance, 0);  // the camera does not see this side
  EXPECT_EQ(found.at({0, 5, 0}, {0, 1, 0}).clearance, 0);
}

TEST(Surroundings, ScalesByPowersOfTwo) {
  const Surroundings one = surroundings_of(two_planes(true));
  for (const int k : {-20, 15}) {
    const float scale = std::ldexp(1.0f, k);
    const Surroundings scaled = surroundings_of(two_planes(true, scale));
    for (int i = -5; i <= 5; ++i) {
      const Point3 p(0.02f * float(i), 0, 0.01f * float(i));
      EXPECT_EQ(scaled.at(scale * p, {0, 1, 0}).clearance, scale * one.at(p, {0, 1, 0}).clearance);
    }
  }
}

}  // namespace
}  // namespace kaustik::render
