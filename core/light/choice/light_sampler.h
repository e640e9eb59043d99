#pragma once
// The choice of one light for a shadow ray.

#include "core/light/choice/light_tree.h"

namespace kaustik {

// Chooses the light for a shadow ray, and gives the probability of the choice. All estimators that choose a
// light use this class.
//
// Up to kMostByPower lights are chosen in proportion to their power, independently of the receiver; such
// small numbers are better sampled all together (render/estimators/lighting.cpp). With more lights, those
// that have a position are chosen by a LightTree, and those without (distant, infinite) beside it, each as
// often as the whole tree (pbrt-v4's rule); one choice in eight is still made by power. Immutable;
// thread-safe.
class LightSampler {
 public:
  // The limit is measured: docs/decisions/016-one-light-sampler.md.
  static constexpr size_t kMostByPower = 4;

  LightSampler() = default;
  explicit LightSampler(const std::vector<Light>& lights, size_t most_by_power = kMostByPower);

  struct Choice {
    uint32_t light;
    float probability;
    float u_remapped;  // what is left of the random number, again uniform in [0, 1)
  };
  // u in [0, 1). Returns nothing if no light can contribute.
  std::optional<Choice> choose(const LightReceiver& x, float u) const;
  // Probability with which choose() returns this light.
  float probability(const LightReceiver& x, uint32_t light) const;
  // Whether x lies so near to an extended light that samples of the light's area are noisy there
  // (LightTree::any_near).
  bool any_near(const LightReceiver& x) const { return tree_.any_near(x); }

 private:
  // Probability of each light without a position, and of the tree.
  float share() const { return 1 / static_cast<float>(placeless_.size() + (tree_.empty() ? 0 : 1)); }

  bool by_power_ = true;
  DiscreteDistribution power_;
  LightTree tree_;
  std::vector<uint32_t> placeless_;  // in ascending order
};

}  // namespace kaustik
