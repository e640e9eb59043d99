#pragma once
#include "core/light/choice/light_tree.h"

namespace kaustik {

// Chooses the light of a shadow ray. All estimators that choose one ask here, and here for the probability.
//
// Of at most kMostByPower lights one is chosen in proportion to its power, wherever the light arrives: so few
// are better all sampled (render/estimators/lighting.cpp). Of more, lights that have a place are chosen by a
// LightTree; those without (distant, infinite) beside it, each as often as the whole tree (pbrt-v4's rule);
// one choice in eight is made by power all the same. Immutable; thread-safe.
class LightSampler {
 public:
  // Measured: docs/accuracy.md.
  static constexpr size_t kMostByPower = 4;

  LightSampler() = default;
  explicit LightSampler(const std::vector<Light>& lights, size_t most_by_power = kMostByPower);

  struct Choice {
    uint32_t light;
    float probability;
    float u_remapped;  // the random number, uniform again in [0, 1)
  };
  // u in [0, 1). Nothing where no light can give anything.
  std::optional<Choice> choose(const LightReceiver& x, float u) const;
  // By which choose() finds this light.
  float probability(const LightReceiver& x, uint32_t light) const;

 private:
  // Of each of the lights without a place, and of the tree.
  float share() const { return 1 / static_cast<float>(placeless_.size() + (tree_.empty() ? 0 : 1)); }

  bool by_power_ = true;
  DiscreteDistribution power_;
  LightTree tree_;
  std::vector<uint32_t> placeless_;
};

}  // namespace kaustik
