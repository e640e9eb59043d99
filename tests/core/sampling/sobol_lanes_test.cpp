#include "core/sampling/sobol_lanes.h"

#include <gtest/gtest.h>

namespace kaustik {
namespace {

// Every dimension of every lane equals what Sampler draws, bit for bit: at both ends of the range of indices,
// for any count, and with neighbours from the same and from other sets of dimensions.
TEST(SobolLanes, MatchTheSamplersNumbers) {
  constexpr uint64_t kSeed = 0x1234567890abcdefull;
  constexpr uint32_t kLastSet = 1000;
  for (const uint64_t first :
       {uint64_t{0}, uint64_t{1} << 20, (uint64_t{1} << 32) - kSobolLanes, uint64_t{7} << 33}) {
    SobolKeyTable keys(kSeed, first >> 32);
    keys.make(kLastSet);
    for (const uint32_t stride : {0u, 1u, 13u}) {
      uint32_t reversed[kSobolLanes], set[kSobolLanes];
      for (uint32_t k = 0; k < kSobolLanes; ++k) {
        reversed[k] = reverse_bits(static_cast<uint32_t>(first + k));
        set[k] = kLastSet - k * stride;
      }
      for (const size_t count : {size_t{1}, size_t{9}, kSobolLanes}) {
        for (const int dimensions : {3, 4}) {
          SobolLanes numbers;
          draw_sobol_lanes(keys, set, reversed, count, dimensions, &numbers);
          for (size_t k = 0; k < count; ++k) {
            Sampler sampler(kSeed, first + k, 4 * set[k]);
            for (int d = 0; d < dimensions; ++d)
              ASSERT_EQ(numbers.u[d][k], sampler.next_1d()) << d << ' ' << k;
          }
        }
      }
    }
  }
}

}  // namespace
}  // namespace kaustik
