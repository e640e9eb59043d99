#pragma once
// Counter-based Owen-scrambled Sobol points (Burley 2020, "Practical Hash-based Owen Scrambling"). Every
// value is a pure function of (seed, index, dimension) and threads share no state, so the numbers do not
// depend on how the work is split.

#include <cstdint>

#include "core/math/hash.h"
#include "core/math/vec.h"
#include "core/sampling/sobol_table.h"

namespace kaustik {

// The scrambling seeds of one Sobol set, which all points of a sequence share.
struct SobolSetKeys {
  uint32_t index;
  uint32_t dimensions[4];
};

// Keys of set `set` (dimensions 4 set to 4 set + 3) for the points whose index has this upper half (see
// Sampler).
inline SobolSetKeys sobol_set_keys(uint64_t seed, uint64_t upper_half, uint32_t set);

// Point `index` of the sequence `seed`, whose dimensions are drawn in order. The index may use all 64 bits:
// its upper 32 bits choose an independently scrambled sequence. Values lie in [0, 1).
//
// Dimensions come in sets of four: dimensions 4k to 4k+3 are one four-dimensional Sobol set, whose index is
// shuffled by an Owen scrambling of its own (Burley 2020, section 5: padding). Every aligned block of 2^m
// points is a (0, m, 2)-net in dimensions 4k and 4k+1, and a (3, m, 4)-net in the whole set. It is best to
// draw the position and the direction of one sample from the same set.
class Sampler {
 public:
  Sampler(uint64_t seed, uint64_t index, uint32_t first_dimension = 0)
      : seed_(hash_combine(seed, index >> 32)),
        reversed_index_(reverse_bits(static_cast<uint32_t>(index))),
        dimension_(first_dimension) {}

  float next_1d() { return draw(dimension_++); }
  // Draws an aligned pair of dimensions of one Sobol set, which is stratified in two dimensions. Skips a
  // dimension when the next one is odd.
  Point2 next_2d() {
    dimension_ += dimension_ & 1u;
    const float x = draw(dimension_);
    const float y = draw(dimension_ + 1);
    dimension_ += 2;
    return {x, y};
  }
  uint32_t dimension() const { return dimension_; }

 private:
  friend SobolSetKeys sobol_set_keys(uint64_t seed, uint64_t upper_half, uint32_t set);
  static constexpr uint32_t kNoSet = 0xffffffffu;
  static constexpr uint64_t kGoldenRatio = 0x9e3779b97f4a7c15ull;

  float draw(uint32_t dimension) {
    const uint32_t set = dimension >> 2;
    if (set != set_) {
      set_ = set;
      shuffled_ = reverse_bits(laine_karras(reversed_index_, hash(seed_, index_key(set))));
    }
    const uint32_t scrambled =
        reverse_bits(laine_karras(sobol_reversed(shuffled_, dimension & 3u), hash(seed_, dimension)));
    // Truncated rather than rounded, so that a point never moves into the next stratum, nor to 1.
    return static_cast<float>(scrambled >> 8) * 0x1p-24f;
  }
  static constexpr uint64_t index_key(uint32_t set) { return (uint64_t{1} << 32) | set; }
  static uint32_t hash(uint64_t seed, uint64_t key) {
    return static_cast<uint32_t>(mix64(seed + key * kGoldenRatio));
  }

  uint64_t seed_;
  uint32_t reversed_index_;
  uint32_t dimension_;
  uint32_t set_ = kNoSet;
  uint32_t shuffled_ = 0;
};

inline SobolSetKeys sobol_set_keys(uint64_t seed, uint64_t upper_half, uint32_t set) {
  const uint64_t sequence = hash_combine(seed, upper_half);
  SobolSetKeys keys{Sampler::hash(sequence, Sampler::index_key(set)), {}};
  for (uint32_t d = 0; d < 4; ++d) keys.dimensions[d] = Sampler::hash(sequence, 4 * set + d);
  return keys;
}

}  // namespace kaustik
