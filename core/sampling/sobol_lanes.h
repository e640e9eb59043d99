#pragma once
// Whole Sobol sets for many points at once: the values of Sampler, computed side by side in SIMD lanes.

#include <cstddef>

#include "core/sampling/sampler.h"

namespace kaustik {

// Most points per call.
inline constexpr size_t kSobolLanes = 64;

// u[d][k]: dimension d of the set, point k.
struct SobolLanes {
  alignas(64) float u[4][kSobolLanes];
};

// The first `dimensions` (three or four) dimensions of a set for `count` points, as Sampler draws them. keys:
// of the points' seed and the set. reversed_index[k]: reverse_bits(lower half of the index of point k), for
// all kSobolLanes of which those from `count` on mean nothing. The same bits on every instruction set.
// Thread-safe.
void draw_sobol_lanes(const SobolSetKeys& keys, const uint32_t reversed_index[kSobolLanes], size_t count,
                      int dimensions, SobolLanes* numbers);

}  // namespace kaustik
