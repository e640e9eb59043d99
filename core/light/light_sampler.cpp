#include "core/light/light_sampler.h"

namespace kaustik {

LightSampler::LightSampler(const std::vector<Light>& lights, size_t most_by_power)
    : by_power_(lights.size() <= most_by_power) {
  if (by_power_) {
    power_ = light_power_distribution(lights);
    return;
  }
  tree_ = LightTree(lights);
  for (uint32_t i = 0; i < lights.size(); ++i) {
    const bool placeless = is_infinite(lights[i]) || std::holds_alternative<DistantLight>(lights[i]);
    if (placeless && luminance(power(lights[i])) > 0) placeless_.push_back(i);
  }
}

std::optional<LightSampler::Choice> LightSampler::choose(const LightReceiver& x, float u) const {
  if (by_power_) {
    if (power_.empty() || !(power_.total() > 0)) return std::nullopt;
    const DiscreteDistribution::Sample s = power_.sample(u);
    return Choice{s.index, s.pdf, s.u_remapped};
  }
  if (placeless_.empty() && tree_.empty()) return std::nullopt;
  const float at = u / share();
  const auto i = static_cast<size_t>(at);
  const float rest = std::min(at - static_cast<float>(i), kOneMinusEpsilon);
  if (i < placeless_.size()) return Choice{placeless_[i], share(), rest};
  // Rounding may lead past the last lamp where there is no tree.
  if (tree_.empty()) return Choice{placeless_.back(), share(), rest};
  const auto chosen = tree_.choose(x, rest);
  if (!chosen) return std::nullopt;
  return Choice{chosen->lamp, share() * chosen->probability, chosen->u_remapped};
}

float LightSampler::probability(const LightReceiver& x, uint32_t lamp) const {
  if (by_power_) return power_.pdf(lamp);
  if (std::find(placeless_.begin(), placeless_.end(), lamp) != placeless_.end()) return share();
  return tree_.empty() ? 0 : share() * tree_.probability(x, lamp);
}

}  // namespace kaustik
