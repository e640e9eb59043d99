// Division of photons and samples among passes.

#include "render/plan/pass_share.h"

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

}  // namespace kaustik::render
