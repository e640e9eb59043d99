#pragma once
// The order of a few thousand keys: a sort that stays within the caches of one core.

#include <cstdint>
#include <span>

#include "core/memory/uninitialised_array.h"

namespace kaustik::photon {

// Keeps its memory from one call to the next. Not for several threads at a time.
class KeyOrder {
 public:
  // The indices 0 ... keys.size() - 1 in ascending order of (key, index), in the low halves; valid until the
  // next call. Fewer than 2^32 keys below 2^63.
  std::span<const uint64_t> sort(std::span<const uint64_t> keys);

 private:
  UninitialisedArray<uint64_t> items_, spare_;
};

}  // namespace kaustik::photon
