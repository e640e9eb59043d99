#pragma once
// Is a light seen from here? Predicted from photons.
//
// Each photon of a light flies straight through the scene. Where it meets its first surface the light is seen
// (a direct photon), at all further ones it is hidden (shadow photons; Jensen and Christensen 1995), behind
// mirror and glass too. Each is a vote. Cells whose votes agree predict v = 1 or v = 0, all others nothing.
// A shadow ray that is traced with probability p turns what is predicted into an unbiased visibility:
//
//   V = v + (V_ray - v) [u < p] / p
//
// Its variance is that of V_ray where nothing is predicted (p = 1), zero where votes agree rightly, and at
// most 1/p where they agree by mistake. After n votes that all agree the next one differs with probability
// 1/(n + 2) (Laplace's rule of succession), and the p of least variance times time goes with the root of
// that: see probability_exponent().
//
// The cells form trees of 4 x 4 x 4 children, one tree for each light and each of six directions of the
// surface: floor and wall, a table's top and its underside do not mix. A cell is divided while its votes
// differ, so that large even regions answer after a step or two, and the edges of shadows are followed as
// finely as the votes allow.

#include <array>
#include <cstdint>
#include <iterator>
#include <vector>

#include "photon/map/morton.h"

namespace kaustik::photon {

struct VisibilityGuess {
  float v = 0;  // 0 or 1
  float p = 1;  // probability of a shadow ray, a power of two; 1 where nothing is predicted
};

// p = 2^-k with the largest k <= kMostExponent for which n + 2 >= kVotesOfFirstStep 4^(k - 1); 0 for fewer.
inline constexpr int kMostExponent = 5;
inline constexpr uint64_t kVotesOfFirstStep = 16;
int probability_exponent(uint64_t votes);

// Immutable once made; thread-safe.
class VisibilityTree {
 public:
  static constexpr uint32_t kMostLights = 64;
  // A cell of fewer votes is not divided.
  static constexpr uint64_t kDividedVotes = 32;

  // A photon's word on light < kMostLights at p, on a surface whose unit normal n is on the light's side.
  static uint64_t vote(const MortonCube& cube, uint32_t light, const Point3& p, const Normal3& n, bool seen);

  VisibilityTree() = default;
  // The same for any order of the votes, which are of this cube.
  VisibilityTree(const MortonCube& cube, std::vector<uint64_t> votes);

  // n as for votes. Nothing is predicted of lights without votes.
  VisibilityGuess guess(uint32_t light, const Point3& p, const Normal3& n) const;

 private:
  static constexpr int kLevels = 9;  // of two bits an axis
  static constexpr int kDirections = 6;
  // Of a child: above 0 the node that divides it; 0 nothing is predicted; below 0 what is: see leaf().
  using Node = std::array<int32_t, 64>;

  static uint32_t direction(const Normal3& n);
  static uint32_t digit(const MortonCell& cell, int level);
  static int32_t leaf(uint64_t votes, uint64_t hidden);
  int32_t make_node(const uint64_t* begin, const uint64_t* end, int level);

  MortonCube cube_;
  std::vector<Node> nodes_ = std::vector<Node>(1);  // the first predicts nothing
  std::array<int32_t, kMostLights * kDirections> roots_{};
};

inline uint32_t VisibilityTree::direction(const Normal3& n) {
  const Vector3 a = glm::abs(n);
  const int axis = a.x >= a.y ? (a.x >= a.z ? 0 : 2) : (a.y >= a.z ? 1 : 2);
  return static_cast<uint32_t>(2 * axis + (n[axis] < 0));
}

// Which of its parent's children the cell of level (0 up) lies in.
inline uint32_t VisibilityTree::digit(const MortonCell& cell, int level) {
  const int shift = kMortonBits - 2 * (level + 1);
  return (cell[0] >> shift & 3) | (cell[1] >> shift & 3) << 2 | (cell[2] >> shift & 3) << 4;
}

inline VisibilityGuess VisibilityTree::guess(uint32_t light, const Point3& p, const Normal3& n) const {
  if (light >= kMostLights) return {};
  int32_t entry = roots_[light * kDirections + direction(n)];
  const MortonCell cell = cube_.cell(p);
  for (int level = 0; entry > 0; ++level) entry = nodes_[static_cast<size_t>(entry)][digit(cell, level)];
  if (entry == 0) return {};
  constexpr float kProbability[] = {1.0f, 0.5f, 0.25f, 0.125f, 0.0625f, 0.03125f};
  static_assert(std::size(kProbability) == kMostExponent + 1);
  return {static_cast<float>(-entry & 1), kProbability[-entry >> 1]};
}

}  // namespace kaustik::photon
