#pragma once
// Sorts a few thousand keys within the caches of one core.

#include <cstdint>
#include <span>

#include "core/memory/uninitialised_array.h"

namespace kaustik::photon {

// Keeps its memory between calls. Not thread-safe.
class KeyOrder {
 public:
  // Returns the indices 0 ... keys.size() - 1 in ascending order of (key, index), in the low halves of the
  // items; valid until the next call. Requires fewer than 2^32 keys, all below 2^63.
  std::span<const uint64_t> sort(std::span<const uint64_t> keys);

 private:
  UninitialisedArray<uint64_t> items_, spare_;
};

}  // namespace kaustik::photon
