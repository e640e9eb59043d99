// Tests the radii that are chosen for gathers in the photon maps.

#include "render/maps/radius.h"

#include <gtest/gtest.h>

#include <cmath>

#include "render/explore/surroundings.h"
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

// The radius of an indirect map of photons that lie evenly on a large floor, whose k-th photon is at the
// distance `rule` on average, where k is what the rule says without surroundings. height: of a ceiling above
// the floor, or 0 for the open sky.
double radius_on_floor(double rule, float height) {
  constexpr float kSide = 10;
  constexpr double kOfRule = 200;
  Scene scene;
  const uint32_t white = test::add_material(scene, Lambertian{Rgb(0.5f)});
  test::add_shape(scene, test::horizontal({0, 0, 0}, 100, 100, true, white));
  if (height > 0) test::add_shape(scene, test::horizontal({0, height, 0}, 100, 100, false, white));
  test::look_at(scene, {-0.2f, 0.4f, 0}, {0, 0, 0}, {0, 1, 0}, 60, 32, 32);
  finalize_scene(scene);
  photon::PhotonMaker make(5);
  std::vector<photon::Photon> photons;
  const int count = int(kOfRule * double(kSide * kSide) / (double(kPi) * rule * rule));
  for (int i = 0; i < count; ++i) {
    const Point3 p(kSide * (make.uniform() - 0.5f), 0, kSide * (make.uniform() - 0.5f));
    photons.push_back({p, {0, 1, 0}, Rgb(1), {0, 1, 0}, scene.shapes[0].surface_group});
  }
  const accel::Bvh bvh(scene);
  const RenderSettings settings;
  const EstimatorPlan plan;
  const RenderInput input{scene, bvh, settings, plan};
  const Surroundings surroundings(input);
  PhotonMaps maps;
  maps.surroundings = &surroundings;
  maps.indirect.map = photon::PhotonMap::build(photon::make_buffer(photons, 1));
  return double(choose_radii(input, {}, maps).indirect);
}

// The clearance under a ceiling is one and a half times its height. With the share (0.3 h / r)^(4/3) of the
// rule's photons in reach, where that is below 1 and not below a half, the radius is the root of the share
// times the rule's.
TEST(IndirectRadius, IsSmallerAmongNearSurfaces) {
  // The distance to the k-th of at least 100 photons has the relative deviation 1/(2 sqrt k); neighbouring
  // points of the small part of the floor that is seen share it. Clearances of cells deviate by 4 %, and the
  // radius by two thirds of that.
  constexpr double kTolerance = 4 * 0.5 / 10 / 2 + 0.03;
  constexpr double kRule = 0.4;
  EXPECT_NEAR(radius_on_floor(kRule, 0), kRule, kTolerance * kRule);
  EXPECT_NEAR(radius_on_floor(kRule, 3), kRule, kTolerance * kRule);
  EXPECT_NEAR(radius_on_floor(kRule, 0.5f), kRule * std::sqrt(0.5), kTolerance * kRule);
  const double between = std::pow(0.3 / kRule, 2 / 3.0);
  EXPECT_NEAR(radius_on_floor(kRule, 1), kRule * between, kTolerance * kRule);
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
