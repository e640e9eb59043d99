#pragma once
// The upper limit of speed for building an index by sorting: a parallel radix sort of (key, index) pairs
// only, least significant digit first.

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

#include "core/memory/memory_pages.h"
#include "core/memory/uninitialised_array.h"
#include "photon/map/morton.h"
#include "photon/record/photon_record.h"

namespace kaustik::benchmarks {

struct KeyIndex {
  uint64_t key;
  uint32_t index;
};
using KeyIndices = UninitialisedArray<KeyIndex>;

// Allocates large pages, as the photon map does for its columns.
inline KeyIndices make_key_indices(size_t size) {
  KeyIndices pairs(size);
  prefer_large_pages(pairs.data(), size * sizeof(KeyIndex));
  return pairs;
}

// Fills in the pairs of the records' Morton keys and 0, 1, 2 ...
inline void fill_key_indices(const photon::PhotonRecords& records, const photon::MortonCube& cube,
                             KeyIndices& pairs) {
  tbb::parallel_for(size_t(0), records.size(), [&](size_t i) {
    const photon::PhotonRecord& r = records[i];
    pairs[i] = {photon::morton_key(cube.cell({r.x, r.y, r.z})), uint32_t(i)};
  });
}

// Sorts by one digit of kBits bits. Sixteen blocks are enough for a few threads, and more would cost time.
template <int kBits>
void sort_digit(const KeyIndices& from, KeyIndices& to, int shift) {
  constexpr size_t kBlocks = 16, kDigits = size_t(1) << kBits;
  const size_t block = (from.size() + kBlocks - 1) / kBlocks;
  std::vector<std::vector<uint32_t>> places(kBlocks, std::vector<uint32_t>(kDigits));
  const auto each_block = [&](const auto& fn) {
    tbb::parallel_for(size_t(0), kBlocks, [&](size_t b) {
      uint32_t* const place = places[b].data();
      const size_t end = std::min(from.size(), (b + 1) * block);
      for (size_t i = b * block; i < end; ++i) fn(place[from[i].key >> shift & (kDigits - 1)], from[i]);
    });
  };
  each_block([](uint32_t& count, const KeyIndex&) { ++count; });
  uint32_t sum = 0;
  for (size_t d = 0; d < kDigits; ++d) {
    for (size_t b = 0; b < kBlocks; ++b) sum += std::exchange(places[b][d], sum);
  }
  each_block([&](uint32_t& place, const KeyIndex& pair) { to[place++] = pair; });
}

// Stably sorts by the 63 bits of the key. spare: of the same size.
template <int kBits>
void lsd_radix_sort(KeyIndices& pairs, KeyIndices& spare) {
  for (int shift = 0; shift < 3 * photon::kMortonBits; shift += kBits) {
    sort_digit<kBits>(pairs, spare, shift);
    std::swap(pairs, spare);
  }
}

}  // namespace kaustik::benchmarks
