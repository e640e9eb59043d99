// Share of each pass, radius reduction, and the number of passes that memory requires.

#include "render/passes/passes.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "photon/shoot/memory_estimate.h"
#include "render/estimators/path_integrator.h"
#include "render/maps/photon_maps.h"
#include "render/passes/pass_set.h"

namespace kaustik::render {

PassShare pass_share(uint64_t pass, uint64_t shares, uint64_t photons, int spp) {
  const auto share = [shares](uint64_t whole) { return whole / shares + (whole % shares != 0); };
  const uint64_t samples = share(static_cast<uint64_t>(spp));
  return {pass, shares, share(photons), samples * pass, samples * (pass + 1)};
}

PassSamples pass_samples(const PassShare& pass, const RenderSettings& settings, const EstimatorPlan& plan) {
  if (settings.adaptive == 0 || pass.shares > 1 || traces_paths(plan))
    return {pass.first_sample, pass.end_sample, 0};
  const uint64_t strata = pass.pass << 32;
  return {strata, strata + pass.end_sample - pass.first_sample, double(settings.adaptive)};
}

double RadiusShrink::squared(uint64_t pass, float alpha) {
  if (alpha == 1) return 1;
  if (pass < pass_ || alpha != alpha_) *this = {};
  alpha_ = alpha;
  for (; pass_ < pass; ++pass_) {
    const double i = static_cast<double>(pass_ + 1);
    squared_ *= (i + double(alpha)) / (i + 1);
  }
  return squared_;
}

double radius_shrink_squared(uint64_t pass, float alpha) {
  return RadiusShrink().squared(pass, alpha);
}

photon::TraceSettings trace_settings(const RenderSettings& settings, const EstimatorPlan& plan,
                                     const PassShare& pass) {
  photon::TraceSettings trace;
  trace.seed = settings.seed;
  trace.pass = pass.pass;
  trace.photons = pass.photons;
  trace.max_bounces = settings.max_bounces;
  trace.emission = settings.emission;
  trace.kinds = kinds_needed(plan);
  trace.shadow_behind_specular = plan.direct == DirectEstimator::kSigned;
  return trace;
}

uint64_t choose_passes(const Scene& scene, const accel::Bvh& bvh, const RenderSettings& settings,
                       EstimatorPlan* plan) {
  if (settings.passes > 0) {
    if (kinds_needed(*plan).any() && settings.passes > settings.photons)
      throw std::invalid_argument("there must be at least as many photons as passes");
    const PassShare each = pass_share(0, settings.passes, settings.photons, settings.spp);
    photon::check_memory(scene, bvh, trace_settings(settings, *plan, each), photon::PhotonUse::kMaps,
                         settings.photon_memory, guided_photons(settings, *plan, each.photons));
    return settings.passes;
  }
  if (!kinds_needed(*plan).any()) return 1;
  const PassShare whole = pass_share(0, 1, settings.photons, settings.spp);
  const uint64_t passes =
      photon::shoots_that_fit(scene, bvh, trace_settings(settings, *plan, whole), settings.photon_memory,
                              guided_photons(settings, *plan, whole.photons));
  if (passes > kMostPasses) {  // each takes a sample of each pixel
    throw std::runtime_error(fmt::format(
        "{} photons would need {} passes to fit into memory, which is too many", settings.photons, passes));
  }
  if (passes > 1) {
    plan->notes.push_back(fmt::format(
        "the photons are divided into {} passes, since the maps of all of them would not fit into "
        "memory{}",
        passes, passes > uint64_t(settings.spp) ? "; each takes one sample per pixel" : ""));
  }
  return passes;
}

}  // namespace kaustik::render
