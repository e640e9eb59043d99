// Traces straight photons from each light and collects their observations.

#include "photon/visibility/visibility_shoot.h"

#include <tbb/enumerable_thread_specific.h>

#include "core/parallel/parallel.h"
#include "photon/shoot/shoot.h"

namespace kaustik::photon {

namespace {

using Observations = std::vector<uint64_t>;

// Pass number that keeps these photons' random sequences apart from those of any real pass.
constexpr uint64_t kVisibilityPass = 0x7669736962696c69;

TraceSettings straight_photons(const VisibilitySettings& settings, uint32_t light, double share) {
  TraceSettings trace;
  trace.seed = settings.seed;
  trace.pass = kVisibilityPass + light;
  trace.photons = static_cast<uint64_t>(std::llround(static_cast<double>(settings.photons) * share));
  trace.max_bounces = 1;
  trace.emission = settings.emission;
  trace.kinds.direct = trace.kinds.shadow = true;
  trace.shadow_behind_specular = true;
  trace.light = light;
  return trace;
}

}  // namespace

VisibilityTree predict_visibility(const Scene& scene, const accel::Bvh& bvh,
                                  const VisibilitySettings& settings) {
  const MortonCube cube = MortonCube::around(scene.bounds);
  if (scene.light_power.empty() || !(scene.light_power.total() > 0)) return {};
  const SurfaceTable surfaces(scene);
  tbb::enumerable_thread_specific<Observations> by_thread;
  const size_t lights = std::min<size_t>(scene.lights.size(), VisibilityTree::kMostLights);
  const auto power = [&](uint32_t light) {
    return is_infinite(scene.lights[light]) ? 0.0 : double(scene.light_power.pdf(light));
  };
  double sum = 0;
  for (uint32_t light = 0; light < scene.lights.size(); ++light) sum += power(light);
  for (uint32_t light = 0; light < lights; ++light) {
    if (!(power(light) > 0)) continue;
    const TraceSettings trace = straight_photons(settings, light, power(light) / sum);
    const uint64_t blocks = (trace.photons + kLearnBlock - 1) / kLearnBlock;
    parallel::for_index(uint64_t{0}, blocks, [&](uint64_t block) {
      Observations& observations = by_thread.local();
      TraceCounters ignored;
      const uint64_t first = block * kLearnBlock, end = std::min(trace.photons, first + kLearnBlock);
      const auto sink = [&](PhotonKind kind, const Photon& photon) {
        observations.push_back(
            VisibilityTree::observation(cube, light, photon.p, photon.n, kind == PhotonKind::kDirect));
      };
      trace_photons(scene, surfaces, bvh, trace, first, end, sink, ignored);
    });
  }
  Observations all;
  for (const Observations& observations : by_thread)
    all.insert(all.end(), observations.begin(), observations.end());
  return {cube, std::move(all)};
}

}  // namespace kaustik::photon
