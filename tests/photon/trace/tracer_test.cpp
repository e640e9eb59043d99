// Tests the tracing of single photons: kinds, counts and positions in small scenes, energy, scale.

#include "photon/trace/tracer.h"

#include <gtest/gtest.h>

#include <limits>

#include "tests/photon/support/trace_scenes.h"
#include "tests/support/shapes.h"

namespace kaustik::photon {
namespace {

using test::settings_for;
using test::trace_all;
using test::Traced;
using enum PhotonKind;

bool same(const Photon& a, const Photon& b) {
  return a.p == b.p && a.wi == b.wi && a.flux == b.flux && a.n == b.n && a.surface_group == b.surface_group;
}

// Every photon meets a wall of the closed room once. The fluxes are equal floats, each off by a few
// roundings.
TEST(Tracer, FirstHitsCarryTheLightsPower) {
  const Traced t =
      trace_all(test::lit_room(Rgb(0.5f), {1, 2, 3}), settings_for(20000, {true, false, false, false}));
  EXPECT_EQ(t[kDirect].size(), 20000u);
  const glm::dvec3 flux = test::total_flux(t[kDirect]);
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(flux[c], M_PI / 4 * (c + 1), 1e-6 * M_PI);
  EXPECT_EQ(t.counters.emitted, 20000u);
  EXPECT_EQ(t.counters.rays, 20000u);
  EXPECT_EQ(t.counters.stored[0], 20000u);
  for (const Photon& p : t[kDirect]) {
    EXPECT_GT(glm::dot(p.n, p.wi), 0);
    EXPECT_FLOAT_EQ(std::max({std::abs(p.p.x), std::abs(p.p.y), std::abs(p.p.z)}), 1.0f);
  }
}

// The irradiance is I h / (r^2 + h^2)^(3/2), and the flux within radius r is that of the cone, 2 pi I (1 - h
// / sqrt(r^2 + h^2)).
TEST(Tracer, PointLightOverAPlaneGivesTheClosedForm) {
  Scene scene;
  scene.materials = {Lambertian{}};
  scene.shapes = {test::parallelogram({-100, 0, -100}, {0, 0, 200}, {200, 0, 0})};
  scene.lights = {PointLight{{0, 2, 0}, Rgb(1)}};
  finalize_scene(scene);
  const uint64_t n = 100000;
  const Traced t = trace_all(scene, settings_for(n, {true, false, false, false}));
  const auto within = [](double r) { return 2 * M_PI * (1 - 2 / std::sqrt(r * r + 4)); };
  for (double r = 0; r < 10; r += 0.5) {
    double flux = 0;
    for (const Photon& p : t[kDirect]) {
      const double d = std::hypot(p.p.x, p.p.z);
      if (d >= r && d < r + 0.5) flux += static_cast<double>(p.flux.x);
    }
    const double expected = within(r + 0.5) - within(r), share = expected / (4 * M_PI);
    // The tolerance is four times the binomial standard error, an upper bound since the points are
    // stratified.
    EXPECT_NEAR(flux, expected, 4 * 4 * M_PI * std::sqrt(share * (1 - share) / double(n))) << "ring " << r;
  }
}

// A light at height 3 over a square plate (half width 0.5, height 2), a floor (height 0) and a lower floor
// (height -3).
Scene plate_over_floors(Bsdf plate) {
  Scene scene;
  scene.materials = {Lambertian{Rgb(0.5f)}, plate};
  scene.shapes = {test::parallelogram({-50, 0, -50}, {0, 0, 100}, {100, 0, 0}),
                  test::parallelogram({-50, -3, -50}, {0, 0, 100}, {100, 0, 0}),
                  test::parallelogram({-0.5f, 2, -0.5f}, {1, 0, 0}, {0, 0, 1}, 1)};
  for (uint32_t i = 0; i < 3; ++i) scene.shapes[i].surface_group = i;
  scene.lights = {PointLight{{0, 3, 0}, Rgb(1)}};
  finalize_scene(scene);
  return scene;
}

TEST(Tracer, ShadowPhotonsLieBehindTheFirstSurfaceOnTheStraightRay) {
  const Traced t =
      trace_all(plate_over_floors(Lambertian{}), settings_for(20000, {true, true, false, false}));
  uint64_t direct[3] = {}, shadow[3] = {};
  for (const Photon& p : t[kDirect]) ++direct[p.surface_group];
  for (const Photon& p : t[kShadow]) ++shadow[p.surface_group];
  EXPECT_GT(direct[2], 0u);
  EXPECT_GT(direct[0], 0u);
  EXPECT_EQ(direct[1], 0u);
  EXPECT_EQ(shadow[2], 0u);
  EXPECT_EQ(shadow[0], direct[2]);  // on the floor, in the plate's shadow
  EXPECT_EQ(t.counters.stored[1], shadow[0] + shadow[1]);
  const Point3 light(0, 3, 0);
  for (const Photon& p : t[kShadow]) {
    // Shadow photons lie on the straight line from the light, carry its flux and face it. The ray left the
    // floor, 100 m wide, with that triangle's error bound: at most gamma(16) * 200 m = 0.2 mm, seen from 3 m
    // or more.
    ASSERT_LT(glm::length(p.wi - glm::normalize(light - p.p)), 7e-5f);
    EXPECT_EQ(p.n, Normal3(0, 1, 0));
    EXPECT_EQ(p.flux, t[kDirect][0].flux);
    // The plate's shadow on the floor is three times as wide as the plate.
    if (p.surface_group == 0) {
      EXPECT_LE(std::max(std::abs(p.p.x), std::abs(p.p.z)), 1.5f * (1 + 1e-5f));
    }
  }
  // Each direct photon has one segment more than shadow photons: the last, which leaves the scene.
  EXPECT_EQ(t.counters.shadow_rays, t[kDirect].size() + t[kShadow].size());
}

TEST(Tracer, SpecularFirstSurfaceLeavesNeitherDirectNorShadowPhotons) {
  for (const Bsdf& plate : {Bsdf(Dielectric{1.5f}), Bsdf(Mirror{}), Bsdf(Conductor{Rgb(0.2f), Rgb(3)})}) {
    const Traced t = trace_all(plate_over_floors(plate), settings_for(20000, test::kAllKinds));
    for (PhotonKind k : {kDirect, kShadow}) {
      for (const Photon& p : t[k]) {
        ASSERT_NE(p.surface_group, 2u);
        // None lie in the plate's shadow on the floor; those on the lower floor came through the floor.
        if (p.surface_group == 0) {
          ASSERT_GE(std::max(std::abs(p.p.x), std::abs(p.p.z)), 1.5f * (1 - 1e-5f));
        }
      }
    }
    for (const Photon& p : t[kIndirect]) ASSERT_NE(p.surface_group, 2u);
  }
}

// With the option set, glass and mirrors cast the shadow photons that a diffuse plate casts, and nothing else
// changes.
TEST(Tracer, SpecularSurfacesCastShadowPhotonsIfAsked) {
  TraceSettings settings = settings_for(20000, test::kAllKinds);
  const Traced diffuse = trace_all(plate_over_floors(Lambertian{}), settings);
  for (const Bsdf& plate : {Bsdf(Dielectric{1.5f}), Bsdf(Mirror{}), Bsdf(Conductor{Rgb(0.2f), Rgb(3)})}) {
    const Scene scene = plate_over_floors(plate);
    settings.shadow_behind_specular = false;
    const Traced without = trace_all(scene, settings);
    settings.shadow_behind_specular = true;
    const Traced with = trace_all(scene, settings);
    ASSERT_EQ(with[kShadow].size(), diffuse[kShadow].size());
    for (size_t i = 0; i < with[kShadow].size(); ++i)
      ASSERT_TRUE(same(with[kShadow][i], diffuse[kShadow][i])) << i;
    for (const PhotonKind k : {kDirect, kCaustic, kIndirect}) {
      ASSERT_EQ(with[k].size(), without[k].size());
      for (size_t i = 0; i < with[k].size(); ++i) ASSERT_TRUE(same(with[k][i], without[k][i])) << i;
    }
  }
}

// The mirror's image of the light at (0, 1, 0) in the plane y = 0 is at (0, -1, 0): every caustic photon on
// the ceiling comes from there.
TEST(Tracer, MirrorCausticComesFromTheImageOfTheLight) {
  Scene scene;
  scene.materials = {Lambertian{}, Mirror{Rgb(0.75f)}};
  scene.shapes = {test::parallelogram({-50, 2, -50}, {100, 0, 0}, {0, 0, 100}),
                  test::parallelogram({-1, 0, -1}, {0, 0, 2}, {2, 0, 0}, 1)};
  scene.lights = {PointLight{{0, 1, 0}, Rgb(1)}};
  finalize_scene(scene);
  const uint64_t n = 20000;
  const Traced t = trace_all(scene, settings_for(n, {false, false, true, false}));
  // Seen from height 1 the square has the solid angle 4 asin(1/2) = 2 pi / 3 of 4 pi. Three quarters of those
  // photons survive.
  const double share = 0.75 / 6;
  EXPECT_NEAR(double(t[kCaustic].size()), double(n) * share, 4 * std::sqrt(double(n) * share * (1 - share)));
  EXPECT_EQ(t.counters.stored[0], 0u);
  for (const Photon& p : t[kCaustic]) {
    EXPECT_LT(glm::length(p.wi - glm::normalize(Point3(0, -1, 0) - p.p)), 1e-5f);
    EXPECT_LE(std::max(std::abs(p.p.x), std::abs(p.p.z)), 3 * (1 + 1e-5f));
    EXPECT_EQ(p.n, Normal3(0, -1, 0));
    // Roulette keeps the flux of the survivors at 4 pi I / n.
    EXPECT_NEAR(p.flux.x, 4 * M_PI / double(n), 1e-5 / double(n) * 4 * M_PI);
  }
}

// Smooth glass absorbs nothing: direct and caustic photons together carry the light's power. Only paths that
// grazing reflection keeps inside the sphere for 60 bounces are lost; an internal reflectance above 0.9
// (0.9^60 = 0.2 % remain) needs incidence beyond 88 degrees, which is a thousandth of those that enter.
TEST(Tracer, GlassSphereFocusesAndLosesNothing) {
  Scene scene = test::lit_room(Rgb(0.5f), Rgb(1));
  scene.materials.emplace_back(Dielectric{1.5f});
  scene.shapes.push_back(test::sphere({0, 0, 0}, 0.5f, 1));
  finalize_scene(scene);
  TraceSettings settings = settings_for(30000, {true, false, true, false});
  settings.max_bounces = 64;
  const Traced t = trace_all(scene, settings);
  EXPECT_GT(t[kCaustic].size(), 2000u);
  EXPECT_NEAR(double(t[kDirect].size() + t[kCaustic].size()), 30000, 10);
  const double flux = test::total_flux(t[kDirect]).x + test::total_flux(t[kCaustic]).x;
  EXPECT_NEAR(flux, M_PI / 4, M_PI / 4 * 10 / 30000);
}

TEST(Tracer, KindsDoNotChangeEachOther) {
  const Scene scene = test::full_room();
  const Traced all = trace_all(scene, settings_for(3000, test::kAllKinds));
  for (int k = 0; k < 4; ++k) ASSERT_GT(all.photons[k].size(), 50u);
  for (int mask = 0; mask < 16; ++mask) {
    const KindMask kinds{(mask & 1) != 0, (mask & 2) != 0, (mask & 4) != 0, (mask & 8) != 0};
    const Traced some = trace_all(scene, settings_for(3000, kinds));
    for (int k = 0; k < kPhotonKinds; ++k) {
      const auto& expected = all.photons[k];
      const auto& got = some.photons[k];
      ASSERT_EQ(got.size(), kinds[static_cast<PhotonKind>(k)] ? expected.size() : 0)
          << "mask " << mask << " kind " << k;
      for (size_t i = 0; i < got.size(); ++i)
        ASSERT_TRUE(same(got[i], expected[i])) << "mask " << mask << " kind " << k;
    }
    EXPECT_LE(some.counters.rays, all.counters.rays);
  }
}

TEST(Tracer, TracesOnlyTheKindsThatAreAskedFor) {
  const Scene scene = test::full_room();
  EXPECT_EQ(trace_all(scene, settings_for(1000, {true, false, false, false})).counters.rays, 1000u);
  EXPECT_EQ(trace_all(scene, settings_for(1000, {false, true, false, false})).counters.rays, 1000u);
  const Traced caustic = trace_all(scene, settings_for(1000, {false, false, true, false}));
  const Traced direct = trace_all(scene, settings_for(1000, {true, false, false, false}));
  // Photons that meet a diffuse surface first end there.
  EXPECT_GE(caustic.counters.rays, 1000u + caustic[kCaustic].size());
  EXPECT_LT(caustic.counters.rays, 1000u + 10 * (1000u - direct[kDirect].size()));
}

// In a closed room of reflectance rho the flux of order j is rho^(j-1) of the light's, so the indirect
// photons carry rho / (1 - rho) of it. The number of records per photon is geometric, with a variance of rho
// / (1 - rho)^2.
TEST(Tracer, RouletteIsUnbiasedInAClosedFurnace) {
  const double rho = 0.75, n = 20000;
  TraceSettings settings = settings_for(20000, {false, false, false, true});
  settings.max_bounces = 1000;
  const Traced t = trace_all(test::lit_room(Rgb(0.75f), Rgb(1)), settings);
  EXPECT_NEAR(test::total_flux(t[kIndirect]).x / (M_PI / 4), rho / (1 - rho),
              4 * std::sqrt(rho / n) / (1 - rho));
}

TEST(Tracer, BounceLimitCutsTheSeries) {
  const double rho = 0.75, n = 20000;
  const Scene scene = test::lit_room(Rgb(0.75f), Rgb(1));
  double expected = 0;
  for (int bounces = 0; bounces <= 4; ++bounces) {
    TraceSettings settings = settings_for(20000, {true, false, false, true});
    settings.max_bounces = bounces;
    const Traced t = trace_all(scene, settings);
    if (bounces >= 2) expected += std::pow(rho, bounces - 1);
    // A photon leaves fewer than `bounces` records, so the variance is below bounces^2 / 4.
    EXPECT_NEAR(test::total_flux(t[kIndirect]).x / (M_PI / 4), expected, 2 * bounces / std::sqrt(n))
        << bounces;
    EXPECT_EQ(t[kDirect].size(), bounces > 0 ? 20000u : 0u);
    EXPECT_EQ(t[kIndirect].empty(), bounces < 2);
  }
}

// Roulette goes by the largest channel; the series of each channel must still be right.
TEST(Tracer, RouletteIsUnbiasedPerChannel) {
  const double n = 20000;
  TraceSettings settings = settings_for(20000, {false, false, false, true});
  settings.max_bounces = 1000;
  const Traced t = trace_all(test::lit_room({0.8f, 0.5f, 0.1f}, Rgb(1)), settings);
  const glm::dvec3 flux = test::total_flux(t[kIndirect]) / (M_PI / 4);
  const double rho[] = {0.8, 0.5, 0.1};
  for (int c = 0; c < 3; ++c) {
    // A channel's sum over one photon is at most that of the red one, so its variance is at most the second
    // moment of that, rho_r (1 + rho_r) / (1 - rho_r)^2.
    EXPECT_NEAR(flux[c], rho[c] / (1 - rho[c]), 4 * std::sqrt(0.8 * 1.8 / n) / 0.2) << c;
  }
}

TEST(Tracer, ScalingByPowersOfTwoScalesPhotonsExactly) {
  const Traced one = trace_all(test::foggy_room(), settings_for(1000, test::kAllKinds));
  for (int k : {-20, -3, 1, 7, 20}) {
    const float s = std::ldexp(1.0f, k);
    const Traced scaled = trace_all(test::foggy_room(s), settings_for(1000, test::kAllKinds));
    for (int kind = 0; kind < kPhotonKinds; ++kind) {
      ASSERT_EQ(one.photons[kind].size(), scaled.photons[kind].size()) << k;
      for (size_t i = 0; i < one.photons[kind].size(); ++i) {
        Photon expected = one.photons[kind][i];
        expected.p *= s;
        expected.flux *= s * s;  // the radiance stays, the area grows
        ASSERT_TRUE(same(expected, scaled.photons[kind][i]))
            << "k " << k << " kind " << kind << " photon " << i;
      }
    }
  }
}

TEST(Tracer, InvalidFluxIsDroppedAndCounted) {
  for (float bad : {std::numeric_limits<float>::quiet_NaN(), kInfinity}) {
    Scene scene = test::lit_room({0.5f, 0.5f, bad}, Rgb(1));
    const Traced t = trace_all(scene, settings_for(100, test::kAllKinds));
    EXPECT_EQ(t[kDirect].size(), 100u);
    EXPECT_TRUE(t[kIndirect].empty());
    EXPECT_EQ(t.counters.dropped_invalid, 100u);
  }
  Scene negative = test::lit_room({0.5f, -0.5f, 0.5f}, Rgb(1));
  EXPECT_EQ(trace_all(negative, settings_for(100, test::kAllKinds)).counters.dropped_invalid, 100u);
}

}  // namespace
}  // namespace kaustik::photon
