// Tests how many photons of each kind are emitted where their numbers are balanced.

#include "render/maps/photon_counts.h"

#include <gtest/gtest.h>

#include "render/maps/photon_shoots.h"
#include "tests/render/support/test_scenes.h"
#include "tests/support/statistics.h"

namespace kaustik::render {
namespace {

using namespace test;
using photon::PhotonKind;

RenderSettings balanced(uint64_t photons) {
  RenderSettings settings;
  settings.caustics = CausticEstimator::kPhotons, settings.indirect = IndirectEstimator::kPhotons;
  settings.photons = photons, settings.balance = Balance::kOn;
  return settings;
}

// The numbers that are learned for the scene.
PhotonCounts counts_in(const Scene& scene) {
  const accel::Bvh bvh(scene);
  const RenderSettings settings = balanced(100'000);
  const EstimatorPlan plan = make_plan(settings, scene.needs);
  PhotonGuides guides;
  RenderStatistics ignored;
  learn_guides({scene, bvh, settings, plan}, &guides, &ignored);
  EXPECT_TRUE(guides.counts);
  return guides.counts.value_or(PhotonCounts{});
}

// Rays for both kinds add up if they are shot apart; a kind that is not shot takes none.
TEST(PhotonCounts, AreWithinTheLimitsOfRays) {
  const PhotonNeed two{2, 2};
  const PhotonCounts apart = within_limits(two, two, false), together = within_limits(two, two, true);
  EXPECT_DOUBLE_EQ(apart.caustic, 1);
  EXPECT_DOUBLE_EQ(apart.indirect, 1);
  EXPECT_DOUBLE_EQ(together.caustic, 2);
  const PhotonCounts alone = within_limits({}, {100, 0.5}, false);
  EXPECT_EQ(alone.caustic, 0);
  EXPECT_EQ(alone.indirect, PhotonCounts::kMost);
  EXPECT_GT(within_limits({0, 1}, {}, false).caustic, 0);
}

// In a box most light is indirect; beside a lamp over an open floor there is hardly any.
TEST(PhotonCounts, FollowTheShareOfTheLight) {
  const PhotonCounts box = counts_in(cornell(64));
  Scene open = cornell(64);
  std::erase_if(open.shapes, [](const Shape& s) {
    const Bounds3 b = bounds_of(s);
    return s.light == kNoIndex && !(b.max.y < 1e-3f);
  });
  finalize_scene(open);
  const PhotonCounts floor = counts_in(open);
  EXPECT_GT(box.indirect, 0.5);
  EXPECT_GT(box.caustic, 0);
  EXPECT_LT(floor.indirect, box.indirect / 4);
  EXPECT_LE(floor.caustic, 1.0 / 16);
}

// The sum of the flux of a kind over the maps of independent shoots.
Estimate flux_of(const Scene& scene, const accel::Bvh& bvh, RenderSettings settings, PhotonKind kind) {
  const EstimatorPlan plan = make_plan(settings, scene.needs);
  std::vector<double> sums;
  for (settings.seed = 0; settings.seed < 12; ++settings.seed) {
    const RenderInput input{scene, bvh, settings, plan};
    PhotonGuides guides;
    RenderStatistics ignored;
    learn_guides(input, &guides, &ignored);
    photon::ShootResult shot;
    shoot_kinds(input, pass_share(0, 1, settings.photons, 1), guides, {}, &shot, &ignored);
    const auto map = photon::PhotonMap::build(std::move(shot.buffers[size_t(kind)]), {scene.bounds});
    double sum = 0;
    for (uint64_t i = 0; i < map.size(); ++i) sum += double(luminance(map.photon(i).flux));
    sums.push_back(sum);
  }
  return estimate_of(sums);
}

// Whatever the numbers are, the photons carry the same light.
TEST(PhotonCounts, DoNotChangeTheFlux) {
  const Scene scene = cornell(32);
  const accel::Bvh bvh(scene);
  RenderSettings exact = balanced(20'000);
  exact.balance = Balance::kOff;
  for (const PhotonKind kind : {PhotonKind::kCaustic, PhotonKind::kIndirect}) {
    const Estimate a = flux_of(scene, bvh, exact, kind), b = flux_of(scene, bvh, balanced(20'000), kind);
    EXPECT_NEAR(a.mean, b.mean, 4 * std::hypot(a.standard_error, b.standard_error));
    EXPECT_GT(a.mean, 20 * a.standard_error);  // the test can fail
  }
}

}  // namespace
}  // namespace kaustik::render
