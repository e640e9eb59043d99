#pragma once
// Guided emission: a density for the random numbers of emission, learned from photons that were useful (after
// Grittmann et al. 2018, "Efficient Caustic Rendering with Lightweight Photon Mapping"; the tree after Ram
// and Gray 2011, "Density Estimation Trees"; the warp after McCool and Harwood 1997, "Probability Trees").
//
// A photon's start is a point u of the unit cube: position, direction, light. Instead of uniformly, u is
// drawn with a density p(u) that is constant over boxes, and the flux is divided by p. Lights and emission
// need not know about this. Each coordinate is warped monotonically on its way into a box, so
// well-distributed points stay well distributed.

#include <array>
#include <cstdint>
#include <vector>

#include "photon/emission/emission_lanes.h"

namespace kaustik::photon {

// EmissionNumbers as a point of the unit cube: position (2), direction (2), light.
inline constexpr uint32_t kEmissionNumbers = 5;
using EmissionPoint = std::array<float, kEmissionNumbers>;
inline EmissionPoint point_of(const EmissionNumbers& n) {
  return {n.position.x, n.position.y, n.direction.x, n.direction.y, n.light};
}
inline EmissionNumbers numbers_of(const EmissionPoint& u) {
  return {{u[0], u[1]}, {u[2], u[3]}, u[4]};
}

// A start whose photons were useful.
struct GuideHit {
  EmissionPoint u{};
  double weight = 1;  // > 0: flux^2 divided by the density, at u, of all starts that were tried
};

class EmissionGuide {
 public:
  // Share of the starts drawn uniformly, whatever was learned: flux grows at most by the inverse of this.
  static constexpr double kUniformShare = 1.0 / 3;

  EmissionGuide() = default;  // nothing learned: uniform
  // Splits boxes where the hits are significantly uneven, and draws a box with a density proportional to the
  // root of its mean weight, which minimises the variance, the sum of flux^2 / p. Coordinates from
  // `dimensions` on are not warped. The result is a pure function of the hits and their order, and does not
  // change when all weights are multiplied by 2^k.
  EmissionGuide(std::vector<GuideHit> hits, uint32_t dimensions);

  bool empty() const { return nodes_.empty(); }
  size_t boxes() const { return boxes_.size(); }
  // Predicted ratio of the variance of guided photons to that of as many uniform ones: the sum of flux^2 / p
  // over that of flux^2, for the hits. At most 1 / (1 - kUniformShare).
  double variance() const { return variance_; }

  // Warps a uniform u to one of density p; returns 1/p. Thread-safe.
  float warp(EmissionPoint& u) const;
  // Warps the first `count` starts; weights receive 1/p. Thread-safe.
  void warp(EmissionLanes& starts, size_t count, LaneColumn& weights) const;
  // Returns p(u). Thread-safe.
  float density(const EmissionPoint& u) const;

  // Exponent of two in the middle of the range of the weights 1/p.
  int middle_exponent() const { return middle_exponent_; }

 private:
  friend class GuideBuilder;
  static constexpr uint32_t kLeaf = kEmissionNumbers;
  // An inner node, split along one dimension, or a leaf.
  struct Node {
    float at = 0;                     // coordinate of the split
    float left = 0;                   // probability of the lower part
    float to_left = 0, to_right = 0;  // inverse probabilities of the lower and the upper part
    // child: an inner node's lower part, which the upper part follows; a leaf's box.
    uint32_t dimension = kLeaf, child = 0;
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

// Where a photon starts, and 1 / p for the density p of its guide; 1 without a guide.
struct GuidedStart {
  EmissionPoint u{};
  float weight = 1;
};
// The start of the photon with the random numbers of the sampler. guide: null, or not empty.
GuidedStart start_of(const Scene& scene, Sampler sampler, const EmissionGuide* guide);

}  // namespace kaustik::photon
