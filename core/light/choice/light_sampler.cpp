// The choice of a light by power, by the tree, or among the lights without a position.

#include "core/light/choice/light_sampler.h"

namespace kaustik {
namespace {

// Share of the choices made by power although there is a tree. It bounds the weight of a sample where the
// tree overestimates the importance of other lights, as beside a light that faces away.
constexpr float kByPower = 0.125f;

float mixed(float by_tree, float by_power) {
  return kByPower * by_power + (1 - kByPower) * by_tree;
}

}  // namespace

LightSampler::LightSampler(const std::vector<Light>& lights, size_t most_by_power)
    : by_power_(lights.size() <= most_by_power), power_(light_power_distribution(lights)), tree_(lights) {
  if (by_power_) return;
  for (uint32_t i = 0; i < lights.size(); ++i) {
    if (!bounds_of(lights[i]) && luminance(power(lights[i])) > 0) placeless_.push_back(i);
  }
}

std::optional<LightSampler::Choice> LightSampler::choose(const LightReceiver& x, float u) const {
  if (power_.empty() || !(power_.total() > 0)) return std::nullopt;
  if (by_power_ || u < kByPower) {
    const DiscreteDistribution::Sample s = power_.sample(by_power_ ? u : u / kByPower);
    return Choice{s.index, by_power_ ? s.pdf : probability(x, s.index), s.u_remapped};
  }
  if (placeless_.empty() && tree_.empty()) return std::nullopt;
  const float at = (u - kByPower) / (1 - kByPower) / share();
  const auto i = static_cast<size_t>(at);
  const float rest = std::min(at - static_cast<float>(i), kOneMinusEpsilon);
  // Without a tree, rounding may lead past the last light.
  if (i < placeless_.size() || tree_.empty()) {
    const uint32_t light = placeless_[std::min(i, placeless_.size() - 1)];
    return Choice{light, probability(x, light), rest};
  }
  const auto chosen = tree_.choose(x, rest);
  if (!chosen) return std::nullopt;
  return Choice{chosen->light, mixed(share() * chosen->probability, power_.pdf(chosen->light)),
                chosen->u_remapped};
}

float LightSampler::probability(const LightReceiver& x, uint32_t light) const {
  const float by_power = power_.pdf(light);
  if (by_power_) return by_power;
  if (std::binary_search(placeless_.begin(), placeless_.end(), light)) return mixed(share(), by_power);
  return mixed(tree_.empty() ? 0 : share() * tree_.probability(x, light), by_power);
}

}  // namespace kaustik
