// Tests that photons and paths together bring the light that they divide, whatever the shares are.

#include "photon/sources/source_split.h"

#include <gtest/gtest.h>

#include "photon/trace/tracer.h"
#include "render/estimators/path_integrator.h"
#include "tests/render/support/test_scenes.h"
#include "tests/support/random.h"
#include "tests/support/statistics.h"

namespace kaustik::render {
namespace {

using namespace test;
using photon::Photon;
using photon::PhotonKind;

photon::TraceSettings trace_settings_for(const photon::SourceSplit* split, uint64_t pass) {
  photon::TraceSettings trace;
  trace.pass = pass;
  trace.photons = 20'000;
  trace.kinds.caustic = trace.kinds.indirect = true;
  trace.split = split;
  trace.split_caustics = trace.split_indirect = true;
  return trace;
}

// Flux of caustic and of indirect photons on the floor, y = 0, in each of several shoots.
struct FluxOnFloor {
  std::vector<double> caustic, indirect;
};
FluxOnFloor shoot(const Scene& scene, const accel::Bvh& bvh, const photon::SourceSplit* split) {
  FluxOnFloor found;
  for (uint64_t pass = 0; pass < 16; ++pass) {
    double caustic = 0, indirect = 0;
    photon::TraceCounters ignored;
    const auto sink = [&](PhotonKind kind, const Photon& photon) {
      if (std::abs(photon.p.y) < 1e-3f && photon.n.y > 0.5f)
        (kind == PhotonKind::kCaustic ? caustic : indirect) += double(luminance(photon.flux));
    };
    trace_photons(scene, bvh, trace_settings_for(split, pass), 0, 20'000, sink, ignored);
    found.caustic.push_back(caustic), found.indirect.push_back(indirect);
  }
  return found;
}

std::vector<Photon> firsts_of(const Scene& scene, const accel::Bvh& bvh) {
  std::vector<Photon> firsts;
  photon::TraceSettings trace = trace_settings_for(nullptr, 99);
  trace.kinds.direct = true;
  photon::TraceCounters ignored;
  const auto sink = [&](PhotonKind kind, const Photon& photon) {
    if (kind != PhotonKind::kIndirect) firsts.push_back(photon);
  };
  trace_photons(scene, bvh, trace, 0, trace.photons, sink, ignored);
  return firsts;
}

// The flux that paths bring to points of the floor that lie evenly, times its area.
FluxOnFloor trace_paths_to_floor(const Scene& scene, const accel::Bvh& bvh, const LearnedSplit& split) {
  RenderSettings settings;
  settings.max_bounces = 16;
  settings.caustics = CausticEstimator::kSplit, settings.indirect = IndirectEstimator::kSplit;
  const EstimatorPlan plan = make_plan(settings, scene.needs);
  PhotonMaps maps;
  maps.split = &split;
  const RenderContext ctx{{scene, bvh, settings, plan}, maps};
  constexpr double kArea = 4, kReflectance = 0.7;
  FluxOnFloor found;
  TileCounters ignored;
  for (uint64_t i = 0; i < 60'000; ++i) {
    Sampler sampler(17, i);
    const Point2 u = sampler.next_2d();
    const Ray down{{2 * u.x - 1, 1e-3f, 2 * u.y - 1}, {0, -1, 0}};
    SurfaceInteraction si;
    EXPECT_TRUE(bvh.intersect(down, &si));
    const ShadingPoint x(scene, si, -down.d);
    const PathLight light = trace_path(ctx, x, PathReach::kRoulette, sampler, ignored);
    const double to_flux = kArea * double(kPi) / kReflectance;
    found.caustic.push_back(to_flux * double(luminance(light.caustic)));
    found.indirect.push_back(to_flux * double(luminance(light.indirect)));
  }
  return found;
}

void expect_equal(const std::vector<double>& all, const std::vector<double>& photons,
                  const std::vector<double>& paths) {
  const Estimate a = estimate_of(all), b = estimate_of(photons), c = estimate_of(paths);
  const double error = std::sqrt(a.standard_error * a.standard_error + b.standard_error * b.standard_error +
                                 c.standard_error * c.standard_error);
  EXPECT_NEAR(b.mean + c.mean, a.mean, 4 * error);
  EXPECT_LT(4 * error, std::min(b.mean, c.mean));  // the test can fail
}

// The lamp has a radiance of about 12; lit walls have one of 0.3 and less.
TEST(SourceSplit, PhotonsAndPathsAddUp) {
  const Scene scene = cornell(16);
  const accel::Bvh bvh(scene);
  const FluxOnFloor all = shoot(scene, bvh, nullptr);
  const std::vector<Photon> firsts = firsts_of(scene, bvh);
  const LearnedSplit of_walls{.sources = {scene, firsts, 0.3f}};
  expect_equal(all.indirect, shoot(scene, bvh, &of_walls.sources).indirect,
               trace_paths_to_floor(scene, bvh, of_walls).indirect);
  const LearnedSplit of_lamp{.sources = {scene, firsts, 12}};
  expect_equal(all.caustic, shoot(scene, bvh, &of_lamp.sources).caustic,
               trace_paths_to_floor(scene, bvh, of_lamp).caustic);
}

// No ray hits a point lamp, so its light behind glass and mirrors is left to photons.
TEST(SourceSplit, LeavesWhatNoRayHitsToPhotons) {
  Scene scene = cornell(16);
  scene.lights = {PointLight{{0, 1.9f, 0}, Rgb(1)}};
  for (Shape& shape : scene.shapes) shape.light = kNoIndex;
  finalize_scene(scene);
  const photon::SourceSplit split(scene, std::vector<Photon>{}, kInfinity);
  EXPECT_EQ(split.of_light(0, {{0, 1, 0}, {0, 1, 0}}), 1);
  EXPECT_EQ(split.of_surface({0, 0, 0}, {0, 1, 0}, false), 0);
  const accel::Bvh bvh(scene);
  const FluxOnFloor all = shoot(scene, bvh, nullptr), divided = shoot(scene, bvh, &split);
  EXPECT_EQ(all.caustic, divided.caustic);
}

// Paths find what a glossy surface makes of a point lamp, by their light samples there, although no ray hits
// the lamp. About half of it has a radiance of more than 0.3.
TEST(SourceSplit, DividesLightOfGlossySurfaces) {
  Scene scene = cornell(16);
  scene.lights = {PointLight{{0.1f, 1.5f, 0}, Rgb(1)}};
  const uint32_t metal = add_material(scene, Conductor{Rgb(0.2f), Rgb(4), {0.2f, 0.2f}});
  const uint32_t coated =
      add_material(scene, CoatedDiffuse::from_reflectance(Rgb(0.3f), 1.5f, {0.25f, 0.25f}));
  for (Shape& shape : scene.shapes) {
    shape.light = kNoIndex;
    if (std::holds_alternative<Sphere>(shape.geometry)) shape.material = shape.material % 2 ? metal : coated;
  }
  finalize_scene(scene);
  const accel::Bvh bvh(scene);
  const FluxOnFloor all = shoot(scene, bvh, nullptr);
  const LearnedSplit split{.sources = {scene, firsts_of(scene, bvh), 0.3f}};
  const FluxOnFloor photons = shoot(scene, bvh, &split.sources),
                    paths = trace_paths_to_floor(scene, bvh, split);
  expect_equal(all.caustic, photons.caustic, paths.caustic);
  expect_equal(all.indirect, photons.indirect, paths.indirect);
}

// A photon of 1 W in each of 64 x 64 places of a floor of 1 m^2 is an irradiance of 4096 W/m^2 from above.
TEST(IrradianceTree, TellsTheTwoSidesOfAWallApart) {
  std::vector<Photon> photons;
  for (int i = 0; i < 64 * 64; ++i)
    photons.push_back(
        {{(float(i % 64) + 0.5f) / 64, 0, (float(i / 64) + 0.5f) / 64}, {0, 1, 0}, Rgb(1), {0, 1, 0}});
  const photon::IrradianceTree tree(photons, {{0, 0, 0}, {1, 1, 1}});
  for (const Point3& p : {Point3(0.3f, 0, 0.6f), Point3(0.71f, 0, 0.22f)}) {
    const photon::IrradianceTree::Cell cell = tree.at(p, {0, 1, 0});
    EXPECT_LE(cell.photons, photon::IrradianceTree::kFullCell);
    EXPECT_NEAR(cell.irradiance(), 4096, 1);
    EXPECT_EQ(tree.at(p, {0, -1, 0}).photons, 0u);
  }
}

}  // namespace
}  // namespace kaustik::render
