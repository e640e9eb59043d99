#pragma once
// Whole Sobol sets for many points at once: the values of Sampler, computed side by side in SIMD lanes.

#include <cstddef>
#include <vector>

#include "core/sampling/sampler.h"

namespace kaustik {

// The largest number of points per call.
inline constexpr size_t kSobolLanes = 64;

// u[d][k] is dimension d of point k.
struct SobolLanes {
  alignas(64) float u[4][kSobolLanes];
};

// The keys of the sets 0, 1, 2, ... of one sequence, for the points whose index has the given upper half (see
// Sampler).
class SobolKeyTable {
 public:
  explicit SobolKeyTable(uint64_t seed = 0, uint64_t upper_half = 0) : seed_(seed), upper_half_(upper_half) {}
  uint64_t upper_half() const { return upper_half_; }
  // Makes the missing keys of all sets up to and including this one.
  void make(uint32_t set) {
    for (auto next = static_cast<uint32_t>(words_.size() / kRowWords); next <= set; ++next) {
      const SobolSetKeys keys = sobol_set_keys(seed_, upper_half_, next);
      const auto& d = keys.dimensions;
      words_.insert(words_.end(), {keys.index, d[0], d[1], d[2], d[3], 0, 0, 0});
    }
  }
  // A row per set: word 0 is the key of the index, words 1 to 4 are those of the dimensions.
  static constexpr uint32_t kRowWords = 8;
  const uint32_t* words() const { return words_.data(); }

 private:
  uint64_t seed_, upper_half_;
  std::vector<uint32_t> words_;
};

// Draws the first `dimensions` (three or four) dimensions of a set for `count` points, with the values that
// Sampler gives. set[k] is the set of point k, whose keys must have been made in `keys`; reversed_index[k] is
// reverse_bits(lower half of its index). Both arrays need kSobolLanes valid entries, although those from
// `count` on do not matter. The result has the same bits on every instruction set. Thread-safe.
void draw_sobol_lanes(const SobolKeyTable& keys, const uint32_t set[kSobolLanes],
                      const uint32_t reversed_index[kSobolLanes], size_t count, int dimensions,
                      SobolLanes* numbers);

}  // namespace kaustik
