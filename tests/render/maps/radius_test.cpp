// Tests the radii that are chosen for gathers in the photon maps.

#include "render/maps/radius.h"

#include <gtest/gtest.h>

#include <cmath>

#include "render/maps/pass_photons.h"
#include "tests/photon/support/photon_sets.h"
#include "tests/photon/support/trace_scenes.h"
#include "tests/render/support/test_scenes.h"

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
  // At the even density k photons lie within a quarter of that radius. The distance to the k-th photon has
  // the relative deviation 1/(2 sqrt k), and the median of 1024 of them 1.25/32 of that; 1 in 20 points is so
  // near the border that its disc is wider.
  const double k = 232 * std::pow(2 * kEach / 1e6, 2 / 3.0);
  const double expected = 4 * std::sqrt(k * double(kSide * kSide) / (double(kPi) * kEach));
  EXPECT_NEAR(double(radii.caustic), expected, 0.05 * expected);
}

// A point lamp of intensity 1 W/sr at height h over a plane gives the irradiance h / (h^2 + d^2)^(3/2) at the
// distance d from its foot. Most of what the camera sees is far from the lamp, where 160 photons take a disc
// of some 6 cm; at 6 cm from the foot such a disc would take in the bright spot under the lamp.
TEST(DirectRadius, ShrinksNearALamp) {
  constexpr float kHeight = 0.02f, kDistance = 0.06f;
  Scene scene;
  const uint32_t white = test::add_material(scene, Lambertian{Rgb(1)});
  test::add_shape(scene, test::horizontal({0, 0, 0}, 100, 100, true, white));
  scene.lights.push_back(PointLight{{0, kHeight, 0}, Rgb(1)});
  test::look_at(scene, {0, 2, 0}, {0, 0, 0}, {1, 0, 0}, 30, 64, 64);
  finalize_scene(scene);
  const accel::Bvh bvh(scene);
  RenderSettings settings;
  settings.method = Method::kPhoton, settings.photons = 1'000'000;
  const EstimatorPlan plan = make_plan(settings, scene.needs);
  PassPhotons photons;
  RenderStatistics ignored;
  photons.make({scene, bvh, settings, plan}, pass_share(0, 1, settings.photons, 1), {}, &ignored);
  const GatherMap& direct = photons.maps().direct;
  EXPECT_GT(direct.estimate.radius, kDistance / 2) << "the test could not fail";
  constexpr int kPoints = 8;
  double E = 0;
  for (int i = 0; i < kPoints; ++i) {
    const float turn = 2 * kPi * float(i) / kPoints;
    SurfaceInteraction si;
    si.p = {kDistance * std::cos(turn), 0, kDistance * std::sin(turn)};
    si.n = si.ns = {0, 1, 0};
    si.surface_group = scene.shapes[0].surface_group;
    photon::GatherCounters counters;
    const Bsdf bsdf = Lambertian{Rgb(1)};
    E += double(kPi / kPoints *
                photon::estimate_radiance(direct.map, si, {0, 1, 0}, bsdf, direct.estimate, counters).x);
  }
  const double expected = kHeight / std::pow(kHeight * kHeight + kDistance * kDistance, 1.5);
  // At least 160 photons count at each point.
  EXPECT_NEAR(E, expected, 4 * expected / std::sqrt(160.0 * kPoints));
}

}  // namespace
}  // namespace kaustik::render
