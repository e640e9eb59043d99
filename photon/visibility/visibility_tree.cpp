// Sorts the observations by cell and builds the trees from the sorted keys.

#include "photon/visibility/visibility_tree.h"

#include <algorithm>

#include "core/parallel/parallel.h"

namespace kaustik::photon {

namespace {

// Bits of an observation, from the highest: light and direction, a digit of six bits for each level, hidden.
constexpr int kTreeShift = 55;
constexpr int kDigitBits = 6;

constexpr int digit_shift(int level) {
  return kTreeShift - kDigitBits * (level + 1);
}

uint64_t count_hidden(const uint64_t* begin, const uint64_t* end) {
  uint64_t hidden = 0;
  for (; begin < end; ++begin) hidden += *begin & 1;
  return hidden;
}

}  // namespace

int probability_exponent(uint64_t observations) {
  int k = 0;
  for (uint64_t least = kObservationsOfFirstStep; k < kMostExponent && observations + 2 >= least; least *= 4)
    ++k;
  return k;
}

uint64_t VisibilityTree::observation(const MortonCube& cube, uint32_t light, const Point3& p,
                                     const Normal3& n, bool seen) {
  const MortonCell cell = cube.cell(p);
  uint64_t key = light * kDirections + direction(n);
  for (int level = 0; level < kLevels; ++level) key = key << kDigitBits | digit(cell, level);
  return key << 1 | !seen;
}

VisibilityTree::VisibilityTree(const MortonCube& cube, std::vector<uint64_t> observations) : cube_(cube) {
  static_assert(digit_shift(kLevels - 1) == 1 && (kMostLights * kDirections) >> (64 - kTreeShift) == 0);
  parallel::sort(observations.begin(), observations.end());
  const uint64_t* const end = observations.data() + observations.size();
  for (const uint64_t* at = observations.data(); at < end;) {
    const uint64_t tree = *at >> kTreeShift;
    const uint64_t* const next =
        std::partition_point(at, end, [&](uint64_t v) { return v >> kTreeShift == tree; });
    roots_[tree] = make_node(at, next, 0);
    at = next;
  }
}

// Entry for a leaf cell: -(2 k + v) where v is predicted with p = 2^-k, or 0 where nothing is predicted.
int32_t VisibilityTree::leaf(uint64_t observations, uint64_t hidden) {
  const int k = hidden == 0 || hidden == observations ? probability_exponent(observations) : 0;
  return k == 0 ? 0 : -(2 * k + (hidden == 0));
}

// Makes the node of a cell whose children lie at `level`. Returns the node's index.
int32_t VisibilityTree::make_node(const uint64_t* begin, const uint64_t* end, int level) {
  const size_t number = nodes_.size();
  nodes_.push_back({});
  const int shift = digit_shift(level);
  while (begin < end) {
    const uint64_t cell = *begin >> shift;
    const uint64_t* const next =
        std::partition_point(begin, end, [&](uint64_t v) { return v >> shift == cell; });
    const uint64_t observations = static_cast<uint64_t>(next - begin), hidden = count_hidden(begin, next);
    const bool differ = hidden > 0 && hidden < observations;
    const bool divided = differ && observations >= kDividedObservations && level + 1 < kLevels;
    const int32_t entry = divided ? make_node(begin, next, level + 1) : leaf(observations, hidden);
    nodes_[number][cell & 63] = entry;
    begin = next;
  }
  return static_cast<int32_t>(number);
}

}  // namespace kaustik::photon
