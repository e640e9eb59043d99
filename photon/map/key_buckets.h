#pragma once
// Ranges of Morton keys that hold about equally many photons, so that each can be sorted within the caches.

#include <cstdint>
#include <span>
#include <vector>

#include "photon/map/morton.h"

namespace kaustik::photon {

class KeyBuckets {
 public:
  // sample: keys of some photons, ascending. About `wanted` buckets, at most twice as many; one when the
  // sample is empty. A key that much of the sample shares has a bucket of its own.
  KeyBuckets(std::span<const uint64_t> sample, size_t wanted);

  size_t size() const { return first_keys_.size(); }
  // All of its photons have one key.
  bool single_key(size_t bucket) const {
    return bucket + 1 < size() && first_keys_[bucket + 1] - first_keys_[bucket] == 1;
  }
  // Which bucket holds the key: ascending in the key.
  uint32_t of(uint64_t key) const {
    const Prefix prefix = prefixes_[key >> prefix_shift_];
    uint32_t bucket = prefix.bucket;
    for (uint32_t more = prefix.more; more > 0; more /= 2) {
      const uint32_t half = (more + 1) / 2;
      bucket += half * uint32_t(first_keys_[bucket + half] <= key);  // a product: this branch is a coin toss
    }
    return bucket;
  }

 private:
  // The keys that begin with the same bits lie in buckets [bucket, bucket + more].
  struct Prefix {
    uint16_t bucket, more;
  };

  int prefix_shift_;                  // what is right of it is not prefix
  std::vector<uint64_t> first_keys_;  // of each bucket: ascending, from 0
  std::vector<Prefix> prefixes_;
};

}  // namespace kaustik::photon
