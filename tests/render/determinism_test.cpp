// Tests that pictures keep their bits: for any number of threads, for a crop, for a scene scaled by a power
// of two.

#include <gtest/gtest.h>

#include <tbb/task_arena.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <mutex>

#include "render/camera/camera_rays.h"
#include "render/camera/pixel_range.h"
#include "tests/render/support/image_statistics.h"

namespace kaustik::render {
namespace {

using namespace test;

RenderSettings settings_of(Method method) {
  RenderSettings settings;
  settings.method = method;
  settings.spp = 4;
  settings.photons = 50'000;
  return settings;
}

constexpr size_t layer_bytes() {
  size_t bytes = 0;
  for (const LayerRow& row : kLayerTable) bytes += row.channels.size() * sizeof(float);
  return bytes;
}
static_assert(sizeof(PixelResult) == layer_bytes(), "bytes are compared: no padding, a row for each member");

bool same_bytes(const Film& a, const Film& b) {
  if (a.width() != b.width() || a.height() != b.height()) return false;
  const size_t bytes = sizeof(PixelResult) * size_t(a.width()) * size_t(a.height());
  return std::memcmp(&a.at(0, 0), &b.at(0, 0), bytes) == 0;
}

class Determinism : public ::testing::TestWithParam<Method> {};

TEST_P(Determinism, AnyNumberOfThreadsGivesTheSameBits) {
  for (const Scene& scene : {cornell(40), coloured_cornell(40)}) {
    const auto one = render_with_threads(scene, settings_of(GetParam()), 1);
    EXPECT_GT(total_mean(one.film), 0);
    for (const int threads : {2, 3, 8}) {
      const auto many = render_with_threads(scene, settings_of(GetParam()), threads);
      EXPECT_TRUE(same_bytes(one.film, many.film)) << threads << " threads";
      EXPECT_EQ(one.statistics.rays.bounce, many.statistics.rays.bounce);
      EXPECT_EQ(one.statistics.gather_accepted, many.statistics.gather_accepted);
      EXPECT_EQ(one.statistics.photons.stored, many.statistics.photons.stored);
      EXPECT_EQ(one.statistics.radius, many.statistics.radius);
      write_if_failed(many.film, "threads_" + std::to_string(threads));
    }
  }
}

// A render that is followed takes its blocks coarse to fine, which changes neither bits nor counts. The crop
// cuts blocks, and adaptive samples follow. The cells of the first grid cover it.
TEST_P(Determinism, FollowedRendersHaveTheSameBits) {
  const Scene scene = cornell(40);
  RenderSettings settings = settings_of(GetParam());
  settings.crop = {3, 37, 5, 40};
  settings.adaptive = 1;
  const auto alone = render_with_threads(scene, settings);
  const accel::Bvh bvh(scene, 2);
  std::mutex mutex;
  std::vector<int> times(40 * 40);        // that a pixel was shown
  std::vector<std::array<int, 3>> cells;  // size, and the corner of lower coordinates
  RenderTask task;
  task.on_pixels = [&](const PixelRange& range, int cell, const FilmSums& sums) {
    const std::lock_guard lock(mutex);
    cells.push_back({cell, range.x0 - range.x0 % kRayBlock, range.y0 - range.y0 % kRayBlock});
    for (int y = range.y0; y < range.y1; ++y)
      for (int x = range.x0; x < range.x1; ++x) {
        ++times[size_t(y * 40 + x)];
        EXPECT_GT(sums.at(x - sums.x0(), y - sums.y0()).count, 0u);
      }
  };
  RenderResult followed;
  tbb::task_arena(2).execute([&] { followed = render(scene, bvh, settings, {}, std::move(task)); });
  EXPECT_TRUE(same_bytes(alone.film, followed.film));
  EXPECT_EQ(alone.statistics.gather_candidates, followed.statistics.gather_candidates);
  EXPECT_EQ(alone.statistics.rays.all(), followed.statistics.rays.all());
  // Cells of one grid may be shown before the last of the grid before.
  std::sort(cells.begin(), cells.end());
  const int finest = cells.front()[0], coarsest = cells.back()[0];
  std::vector<bool> covered(40 * 40);  // by cells of the first grid
  for (const auto& [size, x0, y0] : cells)
    for (int y = y0; size == coarsest && y < std::min(y0 + size, 40); ++y)
      for (int x = x0; x < std::min(x0 + size, 40); ++x) covered[size_t(y * 40 + x)] = true;
  for (int y = 5; y < 40; ++y)
    for (int x = 3; x < 37; ++x) {
      ASSERT_GE(times[size_t(y * 40 + x)], 1) << x << ' ' << y;
      ASSERT_TRUE(covered[size_t(y * 40 + x)]) << x << ' ' << y;
    }
  EXPECT_GE(coarsest, 16) << "the first blocks stand for a large part of the picture";
  EXPECT_EQ(finest, kRayBlock);
}

// Neither the image nor the window consists of whole blocks of rays, and the samples do not fill the last
// packets.
TEST_P(Determinism, CropEqualsThatPartOfTheImage) {
  const Scene scene = cornell(30);
  RenderSettings settings = settings_of(GetParam());
  settings.spp = 6;
  settings.adaptive = 0;  // adaptive sampling would distribute adaptive samples over the crop alone
  const auto whole = render_with_threads(scene, settings);
  settings.crop = {7, 30, 11, 29};
  const auto part = render_with_threads(scene, settings);
  ASSERT_EQ(part.film.width(), 23);
  ASSERT_EQ(part.film.height(), 18);
  EXPECT_EQ(part.film.x0(), 7);
  EXPECT_EQ(part.film.y0(), 11);
  for (int y = 0; y < part.film.height(); ++y)
    for (int x = 0; x < part.film.width(); ++x)
      ASSERT_EQ(std::memcmp(&part.film.at(x, y), &whole.film.at(7 + x, 11 + y), sizeof(PixelResult)), 0)
          << x << y;
}

TEST_P(Determinism, SeedsChangeTheNoise) {
  const Scene scene = cornell(16);
  RenderSettings settings = settings_of(GetParam());
  const auto a = render_with_threads(scene, settings);
  settings.seed = 1;
  EXPECT_FALSE(same_bytes(a.film, render_with_threads(scene, settings).film));
}

// Scales from 2^-20 to 2^20, twelve decades. The lights' radiance stays, so the picture stays; depth and
// radius scale.
TEST_P(Determinism, ScaledSceneGivesTheSameBits) {
  const auto one = render_with_threads(coloured_cornell(24), settings_of(GetParam()));
  for (const int exponent : {-20, -3, 20}) {
    const float scale = std::ldexp(1.0f, exponent);
    auto scaled = render_with_threads(coloured_cornell(24, scale), settings_of(GetParam()));
    EXPECT_EQ(scaled.statistics.radius, one.statistics.radius * scale);
    for (int y = 0; y < 24; ++y)
      for (int x = 0; x < 24; ++x) {
        scaled.film.at(x, y).depth /= scale;
        scaled.film.at(x, y).denoising_depth /= scale;
      }
    EXPECT_TRUE(same_bytes(one.film, scaled.film)) << "2^" << exponent;
    write_if_failed(scaled.film, "scaled");
  }
}
INSTANTIATE_TEST_SUITE_P(Methods, Determinism,
                         ::testing::Values(Method::kRaytrace, Method::kMc, Method::kHybrid, Method::kPhoton,
                                           Method::kAuto));

// The leaf lookup, the nearest-K rule and the kernels depend on the query only, too.
TEST(DeterminismOptions, LookupsAndKernelsGiveTheSameBits) {
  const Scene scene = cornell(24);
  for (const Kernel kernel : {Kernel::kCone, Kernel::kEpanechnikov}) {
    RenderSettings settings = settings_of(Method::kPhoton);
    settings.kernel = kernel;
    settings.nearest = kernel == Kernel::kCone ? 50 : 0;
    settings.lookup = kernel == Kernel::kCone ? Lookup::kExact : Lookup::kLeaf;
    settings.emission = EmissionMode::kUniformAngle;
    EXPECT_TRUE(same_bytes(render_with_threads(scene, settings, 1).film,
                           render_with_threads(scene, settings, 3).film));
  }
}

}  // namespace
}  // namespace kaustik::render
