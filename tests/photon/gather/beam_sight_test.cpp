// Tests that photons in media do not count through walls, against closed forms.

#include "photon/gather/beam_sight.h"

#include <gtest/gtest.h>

#include "core/sampling/sampler.h"
#include "core/sampling/warp.h"
#include "photon/estimate/beam_estimate.h"
#include "tests/support/packed_flux.h"
#include "tests/support/shapes.h"
#include "tests/support/statistics.h"

namespace kaustik::photon {
namespace {

using namespace test;

// A wall in the plane z = 0.
Scene walled() {
  Scene scene;
  scene.materials = {Lambertian{Rgb(0.5f)}};
  scene.shapes = {parallelogram({-2, -2, 0}, {5, 0, 0}, {0, 5, 0})};
  finalize_scene(scene);
  return scene;
}

constexpr uint64_t kPhotons = 20'000;

// Photons spread evenly over [0, 1] x [0, 1] x [-1, 1]; those below the plane have a hundred times the flux.
PhotonMap cloud(uint64_t seed) {
  PhotonBuffer buffer;
  for (uint64_t i = 0; i < kPhotons; ++i) {
    Sampler sampler(seed, i);
    Photon photon;
    photon.p = {sampler.next_1d(), sampler.next_1d(), 2 * sampler.next_1d() - 1};
    photon.wi = photon.n = sample_uniform_sphere(sampler.next_2d());
    photon.flux = Rgb(photon.p.z > 0 ? 1.0f : 100.0f);
    photon.surface_group = 1;
    buffer.records.push_back(pack(photon, buffer.flux_unit));
  }
  return PhotonMap::build(std::move(buffer));
}

// A ray along x, at this height above the wall.
Ray beside_wall(float y, float z) {
  return {{0, y, z}, {1, 0, 0}};
}

// The estimate is the one of the photons above the wall, as if they were everywhere.
TEST(BeamSight, PhotonsBehindAWallDoNotCount) {
  const Scene scene = walled();
  const accel::Bvh bvh(scene);
  const Medium thin{Rgb(0), Rgb(1e-6f)};
  for (const float z : {0.02f, 0.1f, 0.2f}) {
    std::vector<double> found;
    for (uint64_t seed = 0; seed < 8; ++seed) {
      const PhotonMap map = cloud(seed);
      double sum = 0;
      for (int i = 0; i < 40; ++i) {
        GatherCounters counters;
        const BeamQuery query{beside_wall(0.3f + 0.01f * float(i), z), 1, 0.3f, 1};
        sum += double(estimate_beam(map, query, thin, {}, 0, counters, &bvh).x) / 40;
      }
      found.push_back(sum);
    }
    const double expected = double(kPhotons) / 2 / (4 * double(kPi));
    const Estimate e = estimate_of(found);
    // One over the share that a few rays find is too large by the share's variance: less than 3 %.
    EXPECT_NEAR(e.mean, expected, 5 * e.standard_error + 0.03 * expected) << z;
    EXPECT_LT(e.standard_error, 0.05 * expected);
  }
}

// Of a disc, a wall at half its radius leaves 1 - (acos(1/2) - sqrt(3) / 4) / pi.
TEST(BeamSight, SharesAreThoseOfADiscCutByALine) {
  const Scene scene = walled();
  const accel::Bvh bvh(scene);
  std::vector<double> shares;
  for (int i = 0; i < 400; ++i) {
    const BeamSight sight(bvh, beside_wall(0.001f * float(i), 0.1f), 1, 0.2f, {});
    shares.push_back(double(sight.share(0.5f)));
    EXPECT_TRUE(sight.sees(0.5f, {0.5f, 0.2f, 0.05f}));
    EXPECT_FALSE(sight.sees(0.5f, {0.5f, 0.2f, -0.05f}));
    EXPECT_EQ(BeamSight(bvh, beside_wall(0, 0.5f), 1, 0.2f, {}).share(0.5f), 1);
  }
  const Estimate e = estimate_of(shares);
  EXPECT_NEAR(e.mean, 1 - (std::acos(0.5) - std::sqrt(3.0) / 4) / double(kPi), 5 * e.standard_error);
  EXPECT_LT(e.standard_error, 0.01);
}

}  // namespace
}  // namespace kaustik::photon
