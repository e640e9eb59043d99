// Tests where the photons' flux goes: nothing is lost, and the entries match the scene.

#include "photon/trace/energy/energy_ledger.h"

#include <gtest/gtest.h>
#include <tbb/blocked_range.h>
#include <tbb/global_control.h>
#include <tbb/parallel_reduce.h>
#include <tbb/task_arena.h>

#include <cstdlib>

#include "photon/shoot/shoot.h"
#include "tests/photon/support/trace_scenes.h"

namespace kaustik::photon {
namespace {

using test::kAllKinds;
using test::settings_for;

EnergyLedger ledger_of(const Scene& scene, const TraceSettings& settings) {
  return shoot(scene, accel::Bvh(scene), settings).counters.energy;
}

double lights_power(const Scene& scene) {
  Rgb total(0);
  for (const Light& light : scene.lights) total += power(light);
  return double{total.x} + double{total.y} + double{total.z};
}

// Rounding error of n photons' fluxes to units, and of their float sums over three channels and over the
// lights.
double rounding(const EnergyLedger& e, uint64_t photons) {
  return 0.5 * static_cast<double>(photons) * e.watts(1) + 0x1p-20 * e.watts(e.emitted);
}

// A room with a wall that leaves gaps, and one with interpolated normals, which is not traced in lanes.
Scene open_room() {
  Scene scene = test::full_room();
  auto& ceiling = std::get<TriangleMesh>(scene.shapes[4].geometry);
  for (Point3& p : ceiling.P) p *= 4.0f;
  auto& mesh = std::get<TriangleMesh>(scene.shapes[0].geometry);
  const Vector3 n = glm::normalize(glm::cross(mesh.P[1] - mesh.P[0], mesh.P[2] - mesh.P[0]));
  for (size_t i = 0; i < mesh.P.size(); ++i)
    mesh.N.push_back(glm::normalize(n + 0.2f * Vector3(i & 1, i & 2, 0.5f)));
  finalize_scene(scene);
  return scene;
}

TEST(EnergyLedger, BalancesToTheLastUnit) {
  for (const Scene& scene : {test::lit_room(Rgb(0.5f), {1, 2, 3}), test::full_room(), open_room()}) {
    for (const KindMask kinds : {KindMask{true, false, false, false}, KindMask{false, false, true, false},
                                 KindMask{true, true, true, true}, KindMask{true, false, true, true}}) {
      for (const int bounces : {1, 2, 16, 200}) {
        TraceSettings settings = settings_for(10'000, kinds);
        settings.max_bounces = bounces;
        const EnergyLedger e = ledger_of(scene, settings);
        EXPECT_EQ(e.unaccounted(), 0);
        EXPECT_EQ(e.invalid, 0);
        EXPECT_NEAR(e.watts(e.emitted), lights_power(scene), rounding(e, settings.photons));
      }
    }
  }
}

// A room filled with a medium: what does not arrive at its walls was absorbed on the way, in whole units.
TEST(EnergyLedger, MediaHaveAnEntry) {
  Scene scene = test::lit_room(Rgb(0), Rgb(1));
  test::fill(scene, Medium{{0.5f, 1, 2}});
  const EnergyLedger e = ledger_of(scene, settings_for(10'000, kAllKinds));
  EXPECT_EQ(e.unaccounted(), 0);
  EXPECT_GT(e.in_media, e.emitted / 4);
  EXPECT_GT(e.absorbed, e.emitted / 100);
  EXPECT_EQ(e.absorbed + e.in_media, e.emitted);
}

TEST(EnergyLedger, BalancesInMediaThatScatter) {
  const auto smoke = test::grid_of({7, 8, 9}, glm::dvec3(-1), glm::dvec3(1), [](const glm::dvec3& p) {
    return std::max(4 * std::sin(4 * p.x + p.y * p.z), 0.0);
  });
  for (const Medium& medium :
       {Medium{{0.1f, 0.5f, 0}, {0.7f, 0, 3}}, Medium{{0.1f, 0.5f, 0}, {0.7f, 0, 3}, 0.9f},
        Medium{{0.1f, 0.5f, 0}, {0.7f, 0, 3}, 0.5f, smoke}}) {
    Scene scene = open_room();
    test::fill(scene, medium);
    for (const int bounces : {1, 2, 16, 200}) {
      TraceSettings settings = settings_for(10'000, kAllKinds);
      settings.max_bounces = bounces;
      const EnergyLedger e = ledger_of(scene, settings);
      EXPECT_EQ(e.unaccounted(), 0);
      EXPECT_EQ(e.invalid, 0);
      EXPECT_NE(e.in_media, 0);
      // Roulette neither gains nor loses on average: each photon takes part a few times, with its flux at
      // most.
      EXPECT_LT(std::abs(double(e.roulette)), 0.1 * double(e.emitted));
    }
  }
}

TEST(EnergyLedger, MatchesItsPhotonsOnAnyNumberOfThreads) {
  const Scene scene = open_room();
  const TraceSettings settings = settings_for(3 * kShootBlock + 77, kAllKinds);
  const EnergyLedger one_by_one = test::trace_all(scene, settings).counters.energy;
  EXPECT_GT(one_by_one.escaped, 0);
  EXPECT_GT(one_by_one.absorbed, 0);
  for (const int threads : {1, 2, 8}) {
    const tbb::global_control cap(tbb::global_control::max_allowed_parallelism, static_cast<size_t>(threads));
    tbb::task_arena arena(threads);
    arena.execute([&] { EXPECT_EQ(ledger_of(scene, settings), one_by_one) << threads; });
  }
}

TEST(EnergyLedger, ScalesExactly) {
  const TraceSettings settings = settings_for(2000, kAllKinds);
  const EnergyLedger one = ledger_of(test::full_room(), settings);
  for (const int k : {-20, -1, 20}) {
    EnergyLedger scaled = ledger_of(test::full_room(std::ldexp(1.0f, k)), settings);
    EXPECT_EQ(scaled.unit_exponent, one.unit_exponent + 2 * k);
    scaled.unit_exponent = one.unit_exponent;
    EXPECT_EQ(scaled, one);
  }
}

// Closed rooms, where each entry is known: black walls absorb everything, white ones nothing, and a path ends
// where it lands when no kind needs the rest of it.
TEST(EnergyLedger, EntriesOfAClosedRoomAreKnown) {
  const EnergyLedger black = ledger_of(test::lit_room(Rgb(0), Rgb(1)), settings_for(10'000, kAllKinds));
  EXPECT_EQ(black.absorbed, black.emitted);
  const EnergyLedger white = ledger_of(test::lit_room(Rgb(1), Rgb(1)), settings_for(10'000, kAllKinds));
  EXPECT_EQ(white.terminated, white.emitted);
  const EnergyLedger direct =
      ledger_of(test::lit_room(Rgb(0.5f), Rgb(1)), settings_for(10'000, {true, false, false, false}));
  EXPECT_EQ(direct.terminated, direct.emitted);
  Scene nothing = test::lit_room(Rgb(0.5f), Rgb(1));
  nothing.shapes.erase(nothing.shapes.begin(), nothing.shapes.begin() + 6);
  nothing.shapes[0].light = 0;
  const EnergyLedger light_alone = ledger_of(nothing, settings_for(10'000, kAllKinds));
  EXPECT_EQ(light_alone.escaped, light_alone.emitted);
}

// In a closed room of reflectance rho each vertex absorbs 1 - rho of what arrives, and a path has 1 / (1 -
// rho) vertices on average, geometrically distributed. So emitted = absorbed + roulette, where the mean of
// roulette is zero: its standard error over n photons of flux 1 is that of the absorbed flux, (1 - rho)
// sqrt(rho / n) / (1 - rho).
TEST(EnergyLedger, RouletteIsZeroOnAverage) {
  const double rho = 0.75, n = 100'000;
  TraceSettings settings = settings_for(100'000, kAllKinds);
  settings.max_bounces = 1000;
  const EnergyLedger e = ledger_of(test::lit_room(Rgb(0.75f), Rgb(1)), settings);
  EXPECT_EQ(e.terminated, 0);
  EXPECT_EQ(e.escaped, 0);
  EXPECT_NE(e.roulette, 0);
  EXPECT_NEAR(static_cast<double>(e.roulette) / static_cast<double>(e.emitted), 0, 4 * std::sqrt(rho / n));
}

TEST(EnergyLedger, InvalidFluxHasAnEntry) {
  for (const float bad : {std::numeric_limits<float>::quiet_NaN(), kInfinity, -0.5f}) {
    const EnergyLedger e =
        ledger_of(test::lit_room({0.5f, 0.5f, bad}, Rgb(1)), settings_for(1000, kAllKinds));
    EXPECT_EQ(e.invalid, e.emitted);
    EXPECT_EQ(e.unaccounted(), 0);
  }
}

// 10^7 random paths over every kind of surface: no invalid flux, and no loss. With
// KAUSTIK_LONG_TEST_PHOTONS=100000000 in the environment the test takes 10^8 paths: half a minute on two
// cores.
TEST(EnergyLedger, MillionsOfPathsStayValid) {
  const char* const wish = std::getenv("KAUSTIK_LONG_TEST_PHOTONS");
  const uint64_t photons = wish ? std::strtoull(wish, nullptr, 10) : 10'000'000;
  const Scene scene = open_room();
  const accel::Bvh bvh(scene);
  TraceSettings settings = settings_for(photons, {true, false, true, true});
  settings.max_bounces = 100;
  const SurfaceTable surfaces(scene);
  std::atomic<uint64_t> bad{0};
  const TraceCounters all = tbb::parallel_reduce(
      tbb::blocked_range<uint64_t>(0, photons, kShootBlock), TraceCounters(),
      [&](const tbb::blocked_range<uint64_t>& r, TraceCounters counters) {
        uint64_t wrong = 0;
        const auto sink = [&](PhotonKind, const Photon& p) {
          wrong += !detail::is_valid_flux(p.flux) || !is_finite(p.p) || !is_finite(p.wi);
        };
        trace_photons(scene, surfaces, bvh, settings, r.begin(), r.end(), sink, counters);
        bad += wrong;
        return counters;
      },
      [](TraceCounters a, const TraceCounters& b) { return a += b; });
  EXPECT_EQ(all.emitted, photons);
  EXPECT_EQ(all.dropped_invalid, 0u);
  EXPECT_EQ(bad, 0u);
  EXPECT_EQ(all.energy.unaccounted(), 0);
  EXPECT_NEAR(all.energy.watts(all.energy.emitted), lights_power(scene), rounding(all.energy, photons));
}

// A point light inside a glass cube: light that meets all faces beyond the critical angle c never leaves. It
// is 1 - 3 (1 - cos c) of the sphere, for cos c > 1/sqrt(2), where the six cones of escape do not overlap.
// The rest visits the faces that it may leave by at least 48 times on 110 segments (their share of the visits
// is cos c / (cos c + sqrt(2) sin c) or more), each time reflected with R ~ exp(-4 cos t / (eta cos c)) next
// to the critical angle. With 1 - cos^2 t = eta^2 (1 - cos^2 i), the integral of 3 R^48 d(cos i) is 6e-5.
TEST(EnergyLedger, ChainsOfTotalReflectionLoseNothing) {
  Scene scene;
  const float eta = 1.5f;
  scene.materials = {Lambertian{Rgb(0)}, Dielectric{eta}};
  test::add_box(scene, 1, 1);
  for (Shape& face : scene.shapes) face.flip_normal = true;  // normals point out of the cube
  scene.lights.emplace_back(PointLight{{0.1f, -0.2f, 0.3f}, Rgb(1)});
  finalize_scene(scene);
  TraceSettings settings = settings_for(100'000, kAllKinds);
  settings.max_bounces = 110;
  const EnergyLedger e = ledger_of(scene, settings);
  EXPECT_EQ(e.absorbed, 0);
  EXPECT_EQ(e.roulette, 0);
  EXPECT_EQ(e.escaped + e.terminated, e.emitted);
  const double trapped = 1 - 3 * (1 - std::sqrt(1 - 1 / (eta * eta)));
  const double share = static_cast<double>(e.terminated) / static_cast<double>(e.emitted);
  const double noise = 4 * std::sqrt(trapped / 1e5);
  EXPECT_GT(share, trapped - noise);
  EXPECT_LT(share, trapped + 1e-4 + noise);
}

}  // namespace
}  // namespace kaustik::photon
