#pragma once
// A tree of lights for importance sampling.

#include <cstdint>
#include <optional>
#include <vector>

#include "core/light/light.h"

namespace kaustik {

// A binary tree over lights, from which one is chosen by its estimated contribution at a point (Conty Estevez
// and Kulla 2018, "Importance Sampling of Many Lights with Adaptive Tree Splitting", without the splitting;
// Pharr et al. 2023, section 12.6.3). A choice takes one step per level, about log2 of the number of lights.
// Immutable; thread-safe.
class LightTree {
 public:
  LightTree() = default;
  // Contains the lights that have bounds; the others are never chosen.
  explicit LightTree(const std::vector<Light>& lights);

  struct Choice {
    uint32_t light;
    float probability;
    float u_remapped;  // what is left of the random number, again uniform in [0, 1)
  };
  // Returns nothing if no light of the tree can contribute.
  std::optional<Choice> choose(const LightReceiver& x, float u) const;
  // Probability with which choose() returns this light.
  float probability(const LightReceiver& x, uint32_t light) const;

  // Whether some light can contribute at x whose box is nearer than half the box's diagonal. There the light
  // fills a large solid angle, and the density of its area samples varies by orders of magnitude.
  bool any_near(const LightReceiver& x) const;

  bool empty() const { return nodes_.empty(); }

 private:
  // A node; its two children are adjacent in nodes_.
  struct Node {
    LightBounds bounds;
    uint32_t first_child = 0;  // for a leaf: the light
    bool leaf = false;
  };
  struct Item {
    LightBounds bounds;
    uint32_t light;
  };
  // Path from the root to a light: bit d is set if the right child is taken at depth d.
  struct Trail {
    uint64_t turns = 0;
    uint32_t depth = kNotThere;
  };
  static constexpr uint32_t kNotThere = ~0u;

  void build(uint32_t node, Item* begin, Item* end, Trail trail);
  static Item* split(Item* begin, Item* end, uint32_t depth);
  static Item* halve(Item* begin, Item* end, const Vector3& extent);
  // Probability of the left child; nothing if neither child can contribute.
  std::optional<float> left_share(const Node& node, const LightReceiver& x) const;

  std::vector<Node> nodes_;
  std::vector<Trail> trails_;  // one for each light
};

}  // namespace kaustik
