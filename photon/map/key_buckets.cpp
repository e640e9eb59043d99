// Chooses the buckets' first keys from a sorted sample, and indexes them by key prefix.

#include "photon/map/key_buckets.h"

#include <algorithm>
#include <bit>

namespace kaustik::photon {

namespace {

// The key in (lo, hi] with the most trailing zeros. It is mostly the corner of a large cell, which a short
// prefix separates from its neighbours.
uint64_t roundest(uint64_t lo, uint64_t hi) {
  return hi & ~(std::bit_floor(lo ^ hi) - 1);
}

std::vector<uint64_t> find_first_keys(std::span<const uint64_t> sample, size_t wanted) {
  std::vector<uint64_t> keys{0};
  for (size_t i = 1; i < wanted && !sample.empty(); ++i) {
    const size_t around = sample.size() / (4 * wanted), middle = sample.size() * i / wanted;
    const uint64_t lo = sample[middle - around], hi = sample[std::min(middle + around, sample.size() - 1)];
    if (lo < hi) {
      keys.push_back(roundest(lo, hi));
    } else {
      keys.insert(keys.end(), {hi, hi + 1});
    }
  }
  std::sort(keys.begin(), keys.end());
  keys.erase(std::unique(keys.begin(), keys.end()), keys.end());
  return keys;
}

// Length of a key prefix that separates most buckets. On surfaces, photons fill only few of the cells of a
// level.
int prefix_bits(size_t buckets) {
  return std::min(int(std::bit_width(buckets)) + 6, 3 * kMortonBits);
}

}  // namespace

KeyBuckets::KeyBuckets(std::span<const uint64_t> sample, size_t wanted)
    : prefix_shift_(3 * kMortonBits - prefix_bits(wanted)),
      first_keys_(find_first_keys(sample, wanted)),
      prefixes_(size_t(1) << prefix_bits(wanted)) {
  size_t next = 0;  // the first bucket that begins after prefix p
  for (size_t p = 0; p < prefixes_.size(); ++p) {
    const uint64_t lowest = uint64_t(p) << prefix_shift_,
                   highest = lowest + ((uint64_t(1) << prefix_shift_) - 1);
    while (next < size() && first_keys_[next] <= lowest) ++next;
    const size_t bucket = next - 1;
    while (next < size() && first_keys_[next] <= highest) ++next;
    prefixes_[p] = {uint16_t(bucket), uint16_t(next - 1 - bucket)};
  }
}

}  // namespace kaustik::photon
