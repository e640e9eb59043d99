// Tests indirect light where the indirect map's disc is larger than the surface that it lies on, or than the
// gap that it lies in: a final gather gives there what paths give.

#include <gtest/gtest.h>

#include "tests/render/support/class_agreement.h"

namespace kaustik::render {
namespace {

using namespace test;

constexpr float kRadius = 0.25f;

// The box [-1, 1] x [0, 2] x [-1, 1] with its light and a further surface; the camera sees only the target.
Scene box_with(const Shape& surface, const Point3& target, float fov) {
  Scene scene = cornell(kSize);
  add_shape(scene, surface);
  look_at(scene, {0, 1, 0.9f}, target, {0, 1, 0}, fov, kSize, kSize);
  finalize_scene(scene);
  return scene;
}

// A strip 2 cm wide, 1 cm before the back wall, like the frame of a picture.
Scene frame_on_the_wall() {
  const float x = 0.3f, half = 0.01f, z = -0.99f;
  return box_with(quad({x - half, 0.7f, z}, {x + half, 0.7f, z}, {x + half, 1.7f, z}, {x - half, 1.7f, z}, 0),
                  {x, 1.2f, z}, 0.4f);
}

// The floor in a gap of 6 cm below a plate, of which the camera sees the middle.
Scene gap_below_a_plate() {
  return box_with(horizontal({0, 0.06f, -0.6f}, 0.25f, 0.25f, false, 1), {0, 0, -0.45f}, 2);
}

double mean_indirect(const std::vector<Film>& of) {
  return block_estimate(of, Layer::kIndirect, -1).mean;
}

// The seeds' scatter is the noise; the map at the ends of the paths is off by its own kernel's bias, which is
// below two per cent of the light on the walls of this box.
void expect_final_gather_agrees(const Scene& scene, const std::string& name) {
  const auto by_paths = films(scene, settings_of(Method::kMc, 256, kRadius, 1));
  const auto found = films(scene, settings_of(Method::kAuto, 64, kRadius, 20));
  const Estimate a = block_estimate(by_paths, Layer::kIndirect, -1),
                 b = block_estimate(found, Layer::kIndirect, -1);
  EXPECT_NEAR(b.mean, a.mean, kErrors * std::hypot(a.standard_error, b.standard_error) + 0.02 * a.mean);
  EXPECT_LT(std::hypot(a.standard_error, b.standard_error), 0.02 * a.mean);  // the test can fail
  write_if_failed(by_paths[0], name + "_paths");
  write_if_failed(found[0], name + "_final_gather");
}

TEST(NarrowPlaces, FrameOnTheWallKeepsItsLight) {
  const Scene scene = frame_on_the_wall();
  expect_final_gather_agrees(scene, "frame");
}

TEST(NarrowPlaces, GapBelowAPlateIsAsDarkAsItIs) {
  const Scene scene = gap_below_a_plate();
  expect_final_gather_agrees(scene, "gap");
  // Discs are wrong here by more than the tolerance.
  RenderSettings discs = settings_of(Method::kAuto, 16, kRadius, 40);
  discs.indirect = IndirectEstimator::kPhotons;
  const double by_paths = mean_indirect(films(scene, settings_of(Method::kMc, 256, kRadius, 1)));
  EXPECT_GT(std::abs(mean_indirect(films(scene, discs)) - by_paths), 0.04 * by_paths);
}

}  // namespace
}  // namespace kaustik::render
