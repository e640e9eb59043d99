#pragma once
#include <cstdint>
#include <optional>
#include <vector>

#include "core/light/choice/light_bounds.h"

namespace kaustik {

// A binary tree over lights from which one is chosen by what it may give at a point (Conty Estevez and Kulla
// 2018, "Importance Sampling of Many Lights with Adaptive Tree Splitting", without splitting; Pharr et al.
// 2023, section 12.6.3). Choosing takes one step per level, about log2 of the lights. Immutable; thread-safe.
class LightTree {
 public:
  LightTree() = default;
  // Those of `lights` that have bounds; the others are never chosen.
  explicit LightTree(const std::vector<Light>& lights);

  struct Choice {
    uint32_t light;
    float probability;
    float u_remapped;  // the random number, uniform again in [0, 1)
  };
  // Nothing where no light of the tree can give anything.
  std::optional<Choice> choose(const LightReceiver& x, float u) const;
  // By which choose() finds this light.
  float probability(const LightReceiver& x, uint32_t light) const;

  bool empty() const { return nodes_.empty(); }

 private:
  // Children lie side by side.
  struct Node {
    LightBounds bounds;
    uint32_t first_child = 0;  // or the light
    bool leaf = false;
  };
  struct Item {
    LightBounds bounds;
    uint32_t light;
  };
  // How a light is reached from the root: bit d is set where the right child of depth d is taken.
  struct Trail {
    uint64_t turns = 0;
    uint32_t depth = kNotThere;
  };
  static constexpr uint32_t kNotThere = ~0u;

  void build(uint32_t node, Item* begin, Item* end, Trail trail);
  static Item* split(Item* begin, Item* end, uint32_t depth);
  static Item* halve(Item* begin, Item* end, const Vector3& extent);
  // Probability of the left child; nothing where neither can give anything.
  std::optional<float> left_share(const Node& node, const LightReceiver& x) const;

  std::vector<Node> nodes_;
  std::vector<Trail> trails_;  // of each light
};

}  // namespace kaustik
