// Rooms with walls of no thickness: light stays on its side, and neither walls nor corners darken.

#include <gtest/gtest.h>

#include "tests/render/support/image_statistics.h"
#include "tests/support/packed_flux.h"

namespace kaustik::render {
namespace {

using namespace test;

// A box from (-1, 0, -1) to (1, 1, 1) of six shapes, which end at each other.
void add_room(Scene& scene, uint32_t material) {
  add_shape(scene, horizontal({0, 0, 0}, 1, 1, true, material));
  add_shape(scene, horizontal({0, 1, 0}, 1, 1, false, material));
  for (const float side : {-1.0f, 1.0f}) {
    add_shape(scene, parallelogram({side, 0, -1}, {0, 1, 0}, {0, 0, 2}, material));
    add_shape(scene, parallelogram({-1, 0, side}, {0, 1, 0}, {2, 0, 0}, material));
  }
}

// A wall at x = 0 divides the box; the left half has a light, the camera is in the right one.
Scene divided_room(int size) {
  Scene scene;
  const uint32_t white = add_material(scene, Lambertian{Rgb(0.7f)});
  add_room(scene, white);
  add_shape(scene, parallelogram({0, 0, -1}, {0, 1, 0}, {0, 0, 2}, white));
  make_light(scene, add_shape(scene, horizontal({-0.3f, 0.9f, 0}, 0.2f, 0.2f, false, white)), Rgb(5));
  look_at(scene, {0.9f, 0.5f, 0}, {0, 0.4f, 0}, {0, 1, 0}, 100, size, size);
  finalize_scene(scene);
  return scene;
}

TEST(Walls, TheOtherRoomIsBlack) {
  const Scene scene = divided_room(24);
  RenderSettings settings;
  settings.spp = 2;
  settings.photons = 20'000;
  settings.radius = 0.3f;
  for (const Method method : {Method::kAuto, Method::kHybrid, Method::kPhoton}) {
    settings.method = method;
    EXPECT_EQ(total_mean(render_with_threads(scene, settings).film), 0) << int(method);
  }
  settings.lookup = Lookup::kLeaf;
  EXPECT_EQ(total_mean(render_with_threads(scene, settings).film), 0);
  settings.lookup = Lookup::kExact;
  settings.nearest = 50;
  EXPECT_EQ(total_mean(render_with_threads(scene, settings).film), 0);
}

// All surfaces of a divided room with a box on its floor emit 1 and reflect half: the radiance is 2
// everywhere. The camera looks into a corner of wall, floor and box with discs that reach past all of them.
Scene furnace_with_walls() {
  Scene scene;
  const uint32_t grey = add_material(scene, Lambertian{Rgb(0.5f)});
  add_room(scene, grey);
  add_shape(scene, parallelogram({0, 0, -1}, {0, 1, 0}, {0, 0, 2}, grey));
  for (const float side : {0.1f, 0.3f}) {
    add_shape(scene, parallelogram({side, 0, -0.2f}, {0, 0.2f, 0}, {0, 0, 0.4f}, grey));
    add_shape(scene, parallelogram({0.1f, 0, 2 * side - 0.4f}, {0, 0.2f, 0}, {0.2f, 0, 0}, grey));
  }
  add_shape(scene, horizontal({0.2f, 0.2f, 0}, 0.1f, 0.2f, true, grey));
  for (Shape& shape : scene.shapes) make_light(scene, shape, Rgb(1), true);
  look_at(scene, {0.6f, 0.5f, 0.5f}, {0.1f, 0, 0}, {0, 1, 0}, 60, 16, 16);
  finalize_scene(scene);
  return scene;
}

// Emission, and all reflected light from photons. With 400,000 photons on 13 m^2, and their reflections, at
// least 800 are within each full disc and 50 in the narrowest part between box and wall, so the mean over all
// pixels has an error of less than a percent, which the seeds measure.
TEST(Walls, AFurnaceIsEvenUpToTheWalls) {
  const Scene scene = furnace_with_walls();
  RenderSettings settings;
  settings.method = Method::kPhoton;
  settings.direct = DirectEstimator::kPhotons;
  settings.spp = 4;
  settings.photons = 400'000;
  settings.radius = 0.15f;
  std::vector<double> means;
  for (settings.seed = 0; settings.seed < 6; ++settings.seed)
    means.push_back(total_mean(render_with_threads(scene, settings).film));
  const Estimate mean = estimate_of(means);
  const double truncated = std::pow(0.5, 17) / 0.5;
  EXPECT_NEAR(mean.mean, 2, 4.5 * mean.standard_error + 2 * (1 / 511.0 + truncated + 1.0 / 128));
}

}  // namespace
}  // namespace kaustik::render
