// Tests the radii that are chosen for gathers in the photon maps.

#include "render/maps/radius.h"

#include <gtest/gtest.h>

#include "tests/photon/support/photon_sets.h"
#include "tests/photon/support/trace_scenes.h"

namespace kaustik::render {
namespace {

// Half of the photons lie in a small spot and carry hardly any flux, as guided photons may; the other half
// carry the light.
TEST(CausticRadius, FollowsTheFluxNotTheCount) {
  constexpr int kEach = 20'000;
  constexpr float kSide = 1.8f, kSpot = 0.02f;
  photon::PhotonMaker make(3);
  std::vector<photon::Photon> photons;
  for (int i = 0; i < kEach; ++i) {
    const auto add = [&](float side, float flux) {
      const Point3 p(side * (make.uniform() - 0.5f), -1, side * (make.uniform() - 0.5f));
      photons.push_back({p, {0, 1, 0}, Rgb(flux), {0, 1, 0}, 0});
    };
    add(kSide, 1);
    add(kSpot, 1e-4f);
  }
  PhotonMaps maps;
  maps.caustic.map = photon::PhotonMap::build(photon::make_buffer(photons, 1));
  const Scene scene = test::lit_room(Rgb(0.5f), Rgb(1));
  const accel::Bvh bvh(scene);
  const RenderSettings settings;
  const EstimatorPlan plan;
  const GatherRadii radii = choose_radii({scene, bvh, settings, plan}, {}, maps);
  // At the even density k photons lie within half that radius. The distance to the k-th photon has the
  // relative deviation 1/(2 sqrt k), and the median of 1024 of them 1.25/32 of that; 1 in 20 points is so
  // near the border that its disc is wider.
  const double k = 232 * std::pow(2 * kEach / 1e6, 2 / 3.0);
  const double expected = 2 * std::sqrt(k * double(kSide * kSide) / (double(kPi) * kEach));
  EXPECT_NEAR(double(radii.caustic), expected, 0.05 * expected);
}

}  // namespace
}  // namespace kaustik::render
