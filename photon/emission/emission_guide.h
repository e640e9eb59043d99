#pragma once
// Guided emission: a density of the random numbers from which photons start, learned from photons that served
// (after Grittmann et al. 2018, "Efficient Caustic Rendering with Lightweight Photon Mapping"; the tree after
// Ram and Gray 2011, "Density Estimation Trees"; the warp after McCool and Harwood 1997, "Probability
// Trees").
//
// A photon starts from numbers u in the unit cube: position, direction, light. Instead of uniformly they are
// drawn with a density p(u) that is constant over boxes, and the flux is divided by p. Lights and emission
// know nothing of it, and each number is warped monotonically on the way to its box, so that points which are
// spread evenly stay so.

#include <array>
#include <cstdint>
#include <vector>

#include "photon/emission/emission_lanes.h"

namespace kaustik::photon {

// Position, direction, light: EmissionNumbers as a point.
inline constexpr uint32_t kEmissionNumbers = 5;
using EmissionPoint = std::array<float, kEmissionNumbers>;

// A start that served.
struct GuideHit {
  EmissionPoint u{};
  double weight = 1;  // above zero: flux^2, divided by the density at u of all starts that were tried
};

class EmissionGuide {
 public:
  // Of the starts that are drawn uniformly, whatever was learned: no flux grows by more than the inverse.
  static constexpr double kUniformShare = 1.0 / 3;

  EmissionGuide() = default;  // nothing learned: uniform
  // Boxes are split where the hits say so with significance, and drawn in proportion to the root of their
  // mean weight: then the sum of flux^2 / p, the variance, is least. Numbers beyond `dimensions` are not
  // warped. A pure function of the hits and their order; the same when all weights are multiplied by 2^k.
  EmissionGuide(std::vector<GuideHit> hits, uint32_t dimensions);

  bool empty() const { return nodes_.empty(); }
  size_t boxes() const { return boxes_.size(); }
  // Sum of flux^2 / p over that of flux^2, as the hits have it: the variance of guided photons over that of
  // as many uniform ones. At most 1 / (1 - kUniformShare).
  double variance() const { return variance_; }

  // Uniform u becomes one of density p; returns 1/p. Thread-safe.
  float warp(EmissionPoint& u) const;
  // The same for the first `count` starts.
  void warp(EmissionLanes& starts, size_t count, EmissionLanes::Column& weights) const;
  // p(u). Thread-safe.
  float density(const EmissionPoint& u) const;

  // The weights 1/p lie around 2^this.
  int middle_exponent() const { return middle_exponent_; }

 private:
  friend class GuideBuilder;
  static constexpr uint32_t kLeaf = kEmissionNumbers;
  // A box that is split along one dimension, or a leaf.
  struct Node {
    float at = 0;                           // where it is split
    float left = 0;                         // probability of the part below
    float to_left = 0, to_right = 0;        // inverses of both parts' probabilities
    uint32_t dimension = kLeaf, child = 0;  // child: the part below, the other follows; of a leaf, its box
  };
  struct Box {
    EmissionPoint low{}, extent{};
    float weight = 1;  // 1/p
  };

  std::vector<Node> nodes_;
  std::vector<Box> boxes_;
  double variance_ = 1;
  int middle_exponent_ = 0;
};

}  // namespace kaustik::photon
