#pragma once
// Partitions Morton keys into ranges of about equally many photons, small enough to be sorted within the
// caches.

#include <cstdint>
#include <span>
#include <vector>

#include "photon/map/morton.h"

namespace kaustik::photon {

class KeyBuckets {
 public:
  // sample: keys of some photons, in ascending order. Makes about `wanted` buckets, at most twice as many, or
  // one if the sample is empty. A key that makes up much of the sample gets a bucket of its own.
  KeyBuckets(std::span<const uint64_t> sample, size_t wanted);

  size_t size() const { return first_keys_.size(); }
  // Whether the bucket covers only one key.
  bool single_key(size_t bucket) const {
    return bucket + 1 < size() && first_keys_[bucket + 1] - first_keys_[bucket] == 1;
  }
  // Index of the bucket that holds the key; it ascends with the key.
  uint32_t of(uint64_t key) const {
    const Prefix prefix = prefixes_[key >> prefix_shift_];
    uint32_t bucket = prefix.bucket;
    for (uint32_t more = prefix.more; more > 0; more /= 2) {
      const uint32_t half = (more + 1) / 2;
      // Branchless: this comparison is unpredictable.
      bucket += half * uint32_t(first_keys_[bucket + half] <= key);
    }
    return bucket;
  }

 private:
  // Keys that begin with this prefix lie in buckets [bucket, bucket + more].
  struct Prefix {
    uint16_t bucket, more;
  };

  int prefix_shift_;                  // number of key bits below the prefix
  std::vector<uint64_t> first_keys_;  // first key of each bucket: ascending, from 0
  std::vector<Prefix> prefixes_;
};

}  // namespace kaustik::photon
