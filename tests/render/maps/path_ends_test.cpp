// Tests that paths which end where photons tell the light bring the light of those that go on.

#include "render/maps/path_ends.h"

#include <gtest/gtest.h>

#include "core/geometry/boundary_edges.h"
#include "photon/shoot/shoot.h"
#include "render/estimators/path_integrator.h"
#include "render/settings/names.h"
#include "tests/render/support/image_statistics.h"
#include "tests/support/packed_flux.h"
#include "tests/support/statistics.h"

namespace kaustik::render {
namespace {

using namespace test;
using photon::Photon;
using photon::PhotonKind;

RenderSettings by_paths(bool final_gather) {
  RenderSettings settings;
  settings.method = Method::kAuto;
  settings.caustics = CausticEstimator::kPaths, settings.indirect = IndirectEstimator::kPaths;
  settings.spp = 16;
  settings.final_gather = final_gather;
  return settings;
}

// Inside a surface of emission Le and reflectance rho the radiance is Le / (1 - rho).
TEST(PathEnds, FurnaceHasItsRadiance) {
  constexpr float kRho = 0.5f;
  Scene scene;
  const uint32_t white = add_material(scene, Lambertian{Rgb(kRho)});
  make_light(scene, add_shape(scene, sphere({0, 0, 0}, 1, white, true)), Rgb(1));
  look_at(scene, {0.1f, -0.2f, 0.3f}, {1, 0.5f, 0}, {0, 1, 0}, 70, 16, 16);
  finalize_scene(scene);
  std::vector<double> means;
  uint64_t ended = 0, gone_on = 0;
  RenderSettings settings = by_paths(true);
  for (settings.seed = 0; settings.seed < 8; ++settings.seed) {
    const RenderResult result = render_with_threads(scene, settings);
    means.push_back(total_mean(result.film));
    ended += result.statistics.rays.bounce;
    RenderSettings without = by_paths(false);
    without.seed = settings.seed;
    gone_on += render_with_threads(scene, without).statistics.rays.bounce;
  }
  const Estimate found = estimate_of(means);
  // Five standard errors of eight seeds; what 16 events cut off; the rounding of packed fluxes.
  constexpr double kExpected = 1 / (1 - double(kRho));
  const double truncated = std::pow(double(kRho), 17) * kExpected;
  EXPECT_NEAR(found.mean, kExpected, 5 * found.standard_error + truncated + kExpected * kPackedFluxError);
  EXPECT_LT(found.standard_error, 0.01);
  // One of two paths survives each reflection after the second, so those that go on have three rays or so.
  EXPECT_LT(double(ended), 0.8 * double(gone_on));
}

// Photons either carry the light of a surface on or leave it to paths, so that both shoots leave what one of
// all light leaves.
TEST(PathEnds, PhotonsOfPathsAreThoseThatPhotonsLeave) {
  Scene scene;
  const uint32_t grey = add_material(scene, Lambertian{Rgb(0.5f)});
  make_light(scene, add_shape(scene, sphere({0, 0.5f, 0}, 0.1f, grey)), Rgb(10));
  add_shape(scene, sphere({0, 0, 0}, 1, grey, true));
  finalize_scene(scene);
  const accel::Bvh bvh(scene);
  photon::TraceSettings trace;
  trace.photons = 10'000;
  trace.kinds.direct = trace.kinds.indirect = true;
  const photon::ShootResult all = photon::shoot(scene, bvh, trace);
  std::vector<Photon> firsts;
  const photon::PhotonBuffer& direct = all.buffers[size_t(PhotonKind::kDirect)];
  for (size_t i = 0; i < direct.records.size(); ++i) firsts.push_back(direct.photon(i));
  const photon::SourceSplit split(scene, firsts, 0.3f);
  trace.split = &split, trace.split_indirect = true;
  const auto left = [&] {
    return photon::shoot(scene, bvh, trace).counters.stored[size_t(PhotonKind::kIndirect)];
  };
  const uint64_t of_photons = left();
  trace.of_paths = true, trace.kinds.direct = false;
  const uint64_t of_paths = left();
  EXPECT_EQ(of_photons + of_paths, all.counters.stored[size_t(PhotonKind::kIndirect)]);
  EXPECT_GT(std::min(of_photons, of_paths), 500u);
}

// Light of a lamp that a mirror and a glass ball send on: whoever brings it, the picture is that of paths
// which go on.
TEST(PathEnds, RoomWithMirrorAndGlassKeepsItsLight) {
  const Scene scene = cornell(16);
  struct Plan {
    CausticEstimator caustics;
    IndirectEstimator indirect;
  };
  for (const Plan& plan : {Plan{CausticEstimator::kPaths, IndirectEstimator::kPaths},
                           Plan{CausticEstimator::kPhotons, IndirectEstimator::kPaths},
                           Plan{CausticEstimator::kSplit, IndirectEstimator::kSplit}}) {
    std::vector<double> ended, gone_on;
    for (const bool final_gather : {true, false}) {
      RenderSettings settings = by_paths(final_gather);
      settings.caustics = plan.caustics, settings.indirect = plan.indirect;
      settings.spp = 64, settings.photons = 50'000;
      for (settings.seed = 0; settings.seed < 8; ++settings.seed) {
        const RenderResult result = render_with_threads(scene, settings);
        (final_gather ? ended : gone_on).push_back(total_mean(result.film));
      }
    }
    const Estimate a = estimate_of(ended), b = estimate_of(gone_on);
    const double error = 5 * std::hypot(a.standard_error, b.standard_error);
    EXPECT_NEAR(a.mean, b.mean, error) << name_of(plan.caustics) << " " << name_of(plan.indirect);
    EXPECT_LT(error, 0.05 * b.mean);
  }
}

}  // namespace
}  // namespace kaustik::render
