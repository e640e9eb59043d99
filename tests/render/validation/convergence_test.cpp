// Tests that method auto, with everything it chooses by itself (estimators, radii, guides), converges to the
// result of paths, and that its stated bias explains the difference.

#include <gtest/gtest.h>

#include "tests/render/support/class_agreement.h"

namespace kaustik::render {
namespace {

using namespace test;

constexpr int kBlocks = kSize / kBlock * (kSize / kBlock);

// A room seen from inside. The sky's light enters only by a window with a glass pane. The room stands on a
// plain seven times as wide, so one photon in some hundreds gets in.
Scene room_with_window() {
  Scene scene;
  const uint32_t white = add_material(scene, Lambertian{Rgb(0.7f)});
  const uint32_t red = add_material(scene, Lambertian{{0.6f, 0.1f, 0.1f}});
  const uint32_t pane = add_material(scene, ThinDielectric{1.5f});
  add_shape(scene, horizontal({0, 0, 0}, 1, 1, true, white));
  add_shape(scene, horizontal({0, 2, 0}, 1, 1, false, white));
  add_shape(scene, quad({-1, 0, -1}, {1, 0, -1}, {1, 2, -1}, {-1, 2, -1}, white));
  add_shape(scene, quad({-1, 0, 1}, {-1, 2, 1}, {1, 2, 1}, {1, 0, 1}, white));
  add_shape(scene, quad({-1, 0, -1}, {-1, 2, -1}, {-1, 2, 1}, {-1, 0, 1}, red));
  const auto wall = [&](float y0, float z0, float y1, float z1, uint32_t material) {
    add_shape(scene, quad({1, y0, z0}, {1, y0, z1}, {1, y1, z1}, {1, y1, z0}, material));
  };
  wall(0, -1, 2, -0.5f, white), wall(0, 0.5f, 2, 1, white);
  wall(0, -0.5f, 0.6f, 0.5f, white), wall(1.6f, -0.5f, 2, 0.5f, white);
  wall(0.6f, -0.5f, 1.6f, 0.5f, pane);
  add_shape(scene, horizontal({0, -0.1f, 0}, 7, 7, true, white));
  add_shape(scene, sphere({-0.3f, 0.4f, -0.3f}, 0.4f, white));
  InfiniteLight sky;
  sky.L = {3, 3.5f, 4};
  scene.lights.push_back(sky);
  look_at(scene, {0, 1, 0.99f}, {0, 0.8f, -1}, {0, 1, 0}, 80, kSize, kSize);
  finalize_scene(scene);
  return scene;
}

// The only light is inside a ball of glass, so all light starts as caustic light.
Scene room_with_bulb() {
  Scene scene = cornell(kSize);
  scene.shapes.pop_back();  // the light
  scene.lights.clear();
  make_light(scene, add_shape(scene, sphere({0, 1.5f, 0}, 0.1f, 3)), {40, 34, 24});
  add_shape(scene, sphere({0, 1.5f, 0}, 0.2f, 4));
  finalize_scene(scene);
  return scene;
}

// A room without specular surfaces.
Scene diffuse_room() {
  Scene scene = cornell(kSize);
  for (Material& material : scene.materials)
    if (material.lobes().specular) material = OrenNayar::from_sigma_degrees({0.3f, 0.4f, 0.6f}, 20);
  finalize_scene(scene);
  return scene;
}

struct Case {
  const char* name;
  Scene (*scene)();
};
void PrintTo(const Case& c, std::ostream* out) {
  *out << c.name;
}
Scene box() {
  return cornell(kSize);
}

RenderSettings settings_for(Method method, int spp, uint64_t photons, uint64_t seed) {
  RenderSettings settings;
  settings.method = method;
  settings.spp = spp;
  settings.photons = photons;
  settings.seed = seed;
  settings.estimate_bias = method == Method::kAuto;
  return settings;
}

// Means over a block's pixels and channels: of the picture without directly visible lights, and of the stated
// bias.
struct BlockMeans {
  std::vector<double> light, bias;
};
BlockMeans means_of(const std::vector<Film>& films, int block) {
  const int x0 = block % (kSize / kBlock) * kBlock, y0 = block / (kSize / kBlock) * kBlock;
  BlockMeans means;
  for (const Film& film : films) {
    glm::dvec3 light(0), bias(0);
    for (int y = y0; y < y0 + kBlock; ++y)
      for (int x = x0; x < x0 + kBlock; ++x) {
        const PixelResult& p = film.at(x, y);
        light += glm::dvec3(p.radiance() - p.emitted), bias += glm::dvec3(p.bias);
      }
    means.light.push_back((light.x + light.y + light.z) / (3 * kBlock * kBlock));
    means.bias.push_back((bias.x + bias.y + bias.z) / (3 * kBlock * kBlock));
  }
  return means;
}

class AutoConverges : public ::testing::TestWithParam<Case> {};

// The stated bias is 4/3 of the change by halving the radius. For kernels whose bias falls at least in
// proportion to r the true bias is at most 3/2 of the stated one.
TEST_P(AutoConverges, ToPathsBlockByBlock) {
  const Scene scene = GetParam().scene();
  const auto by_paths = films(scene, settings_for(Method::kMc, 512, 1, 100));
  const auto by_photons = films(scene, settings_for(Method::kAuto, 32, 800'000, 200));
  for (int block = 0; block < kBlocks; ++block) {
    const BlockMeans mc = means_of(by_paths, block), found = means_of(by_photons, block);
    const Estimate a = estimate_of(mc.light), b = estimate_of(found.light), bias = estimate_of(found.bias);
    const double noise = kErrors * std::hypot(a.standard_error, b.standard_error, 1.5 * bias.standard_error);
    const double bound = noise + 1.5 * std::abs(bias.mean) + kPackedLight * a.mean;
    EXPECT_NEAR(b.mean, a.mean, bound) << "block " << block << " noise " << noise << " bias " << bias.mean;
    EXPECT_LT(bound, 0.5 * a.mean) << "the test could not fail";
  }
  write_if_failed(by_paths[0], "mc");
  write_if_failed(by_photons[0], "auto");
}
INSTANTIATE_TEST_SUITE_P(Scenes, AutoConverges,
                         ::testing::Values(Case{"box", box}, Case{"diffuse", diffuse_room},
                                           Case{"bulb", room_with_bulb}, Case{"window", room_with_window}));

// With 64 times the photons the discs that auto chooses shrink to a 27th of their area or less (with few
// photons 100 to 200 are in reach, the minimum), so a bias in proportion to r falls to a fifth, and other
// biases to less.
TEST(AutoConverges, BiasFallsWithMorePhotons) {
  const Scene scene = diffuse_room();
  const auto stated = [&](uint64_t photons) {
    RenderSettings settings = settings_for(Method::kAuto, 4, photons, 300);
    settings.indirect = IndirectEstimator::kPhotons;
    const auto of_seeds = films(scene, settings, 24);
    double squares = 0, noise = 0;
    for (int block = 0; block < kBlocks; ++block) {
      const Estimate bias = estimate_of(means_of(of_seeds, block).bias);
      squares += bias.mean * bias.mean, noise += bias.standard_error * bias.standard_error;
    }
    // The mean of the squares minus that of their noise; the variance of the root is a kBlocks-th of a
    // block's variance.
    return Estimate{std::sqrt(std::max(0.0, squares - noise) / kBlocks), std::sqrt(noise) / kBlocks};
  };
  const Estimate few = stated(5'000), many = stated(320'000);
  EXPECT_LT(many.mean + kErrors * many.standard_error, few.mean - kErrors * few.standard_error)
      << few.mean << " " << few.standard_error << " " << many.mean << " " << many.standard_error;
}

}  // namespace
}  // namespace kaustik::render
