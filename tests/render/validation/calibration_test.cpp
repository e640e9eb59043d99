// Tests whether a render's statement of its own error is true.

#include <gtest/gtest.h>

#include "render/film/error_estimate.h"
#include "tests/render/support/image_statistics.h"
#include "tests/render/support/scene_files.h"
#include "tests/render/support/wave_scene.h"

namespace kaustik::render {
namespace {

using namespace test;

constexpr int kSize = 48;
constexpr int kSeeds = 10;

Scene sized(const std::string& file) {
  Scene scene = scene_from(file);
  scene.camera.width = scene.camera.height = kSize;
  return scene;
}

RenderResult render_all(const Scene& scene, const RenderSettings& settings) {
  const accel::Bvh bvh(scene, 2);
  RenderResult result;
  tbb::task_arena(2).execute([&] { result = render(scene, bvh, settings); });
  return result;
}

// 80 times the photons and 64 times the samples of the tested render, so a ninth of its noise, with a
// shrinking radius.
Film converged(const Scene& scene) {
  RenderSettings settings;
  settings.photons = 8'000'000;
  settings.spp = 1024;
  settings.passes = 16;
  settings.alpha = 0.8f;
  settings.caustics = CausticEstimator::kPhotons, settings.indirect = IndirectEstimator::kPhotons;
  settings.seed = 1000;
  return render_all(scene, settings).film;
}

struct Coverage {
  uint64_t within = 0, all = 0;
  double share() const { return double(within) / double(all); }
  void add(const RenderResult& result, const Film& reference) {
    const double factor = confidence_factor(result.sums.passes.count());
    for (int y = 0; y < reference.height(); ++y)
      for (int x = 0; x < reference.width(); ++x) {
        const PixelResult &p = result.film.at(x, y), &r = reference.at(x, y);
        for (int c = 0; c < 3; ++c) {
          const double bound = factor * std::hypot(double(p.error[c]), double(p.bias[c]));
          within += std::abs(double(p.radiance()[c]) - double(r.radiance()[c])) <= bound;
          ++all;
        }
      }
  }
};

struct Case {
  const char* name;
  Scene (*scene)();
};

class Calibration : public ::testing::TestWithParam<Case> {};

// Between 85 and 97 % of the pixels must lie within a bound that is stated for 90 %: an error estimate from
// eight passes is itself rough, and light that few passes saw has long tails.
TEST_P(Calibration, NinetyPercentBoundHolds) {
  const Scene scene = GetParam().scene();
  const Film reference = converged(scene);
  Coverage coverage;
  RenderResult result;
  for (uint64_t seed = 1; seed <= kSeeds; ++seed) {
    RenderSettings settings;
    settings.photons = 100'000;
    settings.spp = 16;
    settings.passes = 8;
    settings.seed = seed;
    settings.estimate_bias = true;
    result = render_all(scene, settings);
    coverage.add(result, reference);
  }
  RecordProperty("share", std::to_string(coverage.share()));
  EXPECT_GE(coverage.share(), 0.85);
  EXPECT_LE(coverage.share(), 0.97);
  write_if_failed(result.film, std::string("calibration_") + GetParam().name);
}

INSTANTIATE_TEST_SUITE_P(
    Scenes, Calibration,
    ::testing::Values(Case{"Light2", [] { return sized("cornell-spheres/square-lamp-2.pbrt"); }},
                      Case{"Light1", [] { return sized("cornell-spheres/square-lamp-1.pbrt"); }},
                      Case{"Room", [] { return sized("tncg15-room/tncg15-room.pbrt"); }},
                      Case{"Waves", [] { return wave_scene(kSize); }}),
    [](const auto& c) { return std::string(c.param.name); });

}  // namespace
}  // namespace kaustik::render
