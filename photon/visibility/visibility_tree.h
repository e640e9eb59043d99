#pragma once
// Predicts from photons whether a light is visible from a point.
//
// Each photon of a light flies straight through the scene. The light is visible where the photon meets its
// first surface (a direct photon) and hidden at all further surfaces (shadow photons; Jensen and Christensen
// 1995), also behind mirrors and glass. Each of these is an observation. A cell whose observations agree
// predicts v = 1 or v = 0; other cells predict nothing. A shadow ray traced with probability p makes an
// unbiased visibility of the prediction:
//
//   V = v + (V_ray - v) [u < p] / p
//
// The variance is that of V_ray where nothing is predicted (p = 1), zero where the prediction is right, and
// at most 1/p where it is wrong. After n observations that all agree, the next one differs with probability
// 1/(n + 2) (Laplace's rule of succession), and the p that minimises variance times time is proportional to
// the root of that: see probability_exponent().
//
// The cells form trees of 4 x 4 x 4 children, one tree for each light and each of six directions of the
// surface, so that floor and wall, or a table's top and underside, are kept apart. A cell is divided while
// its observations differ: large uniform regions answer after a step or two, and the edges of shadows are
// resolved as finely as the observations allow.

#include <array>
#include <cstdint>
#include <iterator>
#include <vector>

#include "photon/map/morton.h"

namespace kaustik::photon {

struct VisibilityPrediction {
  float v = 0;  // 0 or 1
  float p = 1;  // probability of a shadow ray, a power of two; 1 where nothing is predicted
};

// Returns the k of p = 2^-k for n agreeing observations: the largest k <= kMostExponent for which n + 2 >=
// kObservationsOfFirstStep 4^(k - 1), or 0 if there is none.
inline constexpr int kMostExponent = 5;
inline constexpr uint64_t kObservationsOfFirstStep = 16;
int probability_exponent(uint64_t observations);

// Immutable after construction; thread-safe.
class VisibilityTree {
 public:
  static constexpr uint32_t kMostLights = 64;
  // A cell with fewer observations is not divided.
  static constexpr uint64_t kDividedObservations = 32;

  // Encodes one observation of light < kMostLights at p, on a surface whose unit normal n is on the light's
  // side.
  static uint64_t observation(const MortonCube& cube, uint32_t light, const Point3& p, const Normal3& n,
                              bool seen);

  VisibilityTree() = default;
  // The tree does not depend on the order of the observations, all of which must have been encoded with this
  // cube.
  VisibilityTree(const MortonCube& cube, std::vector<uint64_t> observations);

  // Prediction at p, where n is the unit normal on the light's side. Nothing is predicted for lights without
  // observations.
  VisibilityPrediction predict(uint32_t light, const Point3& p, const Normal3& n) const;

 private:
  static constexpr int kLevels = 9;  // two bits per axis each
  static constexpr int kDirections = 6;
  // Entries of the children: > 0 the index of the child's node; 0 nothing is predicted; < 0 a prediction, see
  // leaf().
  using Node = std::array<int32_t, 64>;

  static uint32_t direction(const Normal3& n);
  static uint32_t digit(const MortonCell& cell, int level);
  static int32_t leaf(uint64_t observations, uint64_t hidden);
  int32_t make_node(const uint64_t* begin, const uint64_t* end, int level);

  MortonCube cube_;
  std::vector<Node> nodes_ = std::vector<Node>(1);  // node 0 is unused, as entry 0 means no prediction
  std::array<int32_t, kMostLights * kDirections> roots_{};
};

inline uint32_t VisibilityTree::direction(const Normal3& n) {
  const Vector3 a = glm::abs(n);
  const int axis = a.x >= a.y ? (a.x >= a.z ? 0 : 2) : (a.y >= a.z ? 1 : 2);
  return static_cast<uint32_t>(2 * axis + (n[axis] < 0));
}

// Index, among its parent's children, of the cell at `level` (0 is the root's children).
inline uint32_t VisibilityTree::digit(const MortonCell& cell, int level) {
  const int shift = kMortonBits - 2 * (level + 1);
  return (cell[0] >> shift & 3) | (cell[1] >> shift & 3) << 2 | (cell[2] >> shift & 3) << 4;
}

inline VisibilityPrediction VisibilityTree::predict(uint32_t light, const Point3& p, const Normal3& n) const {
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
