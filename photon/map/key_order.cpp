// Least-significant-digit radix sort by the highest 32 key bits that vary; the rare ties are then sorted by
// the lower bits. An item is 64 bits: 32 bits of a key in its high half, an index in its low half.

#include "photon/map/key_order.h"

#include <algorithm>
#include <array>
#include <bit>
#include <utility>

namespace kaustik::photon {

namespace {

constexpr int kDigits = 3, kDigitBits = 11;
constexpr size_t kDigitValues = size_t(1) << kDigitBits;
constexpr size_t kFew = 512;  // with fewer items histograms cost more than they save

using Items = std::span<uint64_t>;
using Histogram = std::array<uint32_t, kDigitValues>;

uint32_t high(uint64_t item) {
  return uint32_t(item >> 32);
}
size_t digit(uint64_t item, int d) {
  return high(item) >> (d * kDigitBits) & (kDigitValues - 1);
}

void sort_digit(Items from, uint64_t* to, int d, Histogram& counts) {
  uint32_t sum = 0;
  for (uint32_t& count : counts) sum += std::exchange(count, sum);
  for (const uint64_t item : from) to[counts[digit(item, d)]++] = item;
}

// Sorts by all 64 bits, provided that the indices of items with equal high halves ascend. The result is
// either in items or at the start of spare.
Items sort_items(Items items, uint64_t* spare) {
  if (items.size() <= kFew) {
    std::sort(items.begin(), items.end());
    return items;
  }
  std::array<Histogram, kDigits> counts{};
  for (const uint64_t item : items) {
    for (int d = 0; d < kDigits; ++d) ++counts[size_t(d)][digit(item, d)];
  }
  Items from = items, to{spare, items.size()};
  for (int d = 0; d < kDigits; ++d) {
    Histogram& count = counts[size_t(d)];
    if (count[digit(from[0], d)] == from.size()) continue;
    sort_digit(from, to.data(), d, count);
    std::swap(from, to);
  }
  return from;
}

// Sorts runs of items with equal high halves by the `below` lower bits of their keys.
void sort_ties(Items items, std::span<const uint64_t> keys, int below, uint64_t* spare) {
  const uint64_t mask = (uint64_t(1) << below) - 1;
  for (size_t begin = 0, end = 1; end < items.size(); begin = end++) {
    if (high(items[begin]) != high(items[end])) continue;
    while (end < items.size() && high(items[end]) == high(items[begin])) ++end;
    const Items run = items.subspan(begin, end - begin);
    for (uint64_t& item : run) item = (keys[uint32_t(item)] & mask) << 32 | uint32_t(item);
    const Items sorted = sort_items(run, spare);
    if (sorted.data() != run.data()) std::ranges::copy(sorted, run.begin());
  }
}

}  // namespace

std::span<const uint64_t> KeyOrder::sort(std::span<const uint64_t> keys) {
  const size_t size = keys.size();
  if (items_.size() < size) {
    items_ = UninitialisedArray<uint64_t>(size);
    spare_ = UninitialisedArray<uint64_t>(size);
  }
  uint64_t varying = 0;
  for (const uint64_t key : keys) varying |= key ^ keys[0];
  // Bits above the varying ones are the same in all items and do not affect the order.
  const int below = std::max(0, int(std::bit_width(varying)) - 32);
  for (size_t i = 0; i < size; ++i) items_[i] = keys[i] >> below << 32 | i;
  const Items sorted = sort_items({items_.data(), size}, spare_.data());
  uint64_t* const free = sorted.data() == items_.data() ? spare_.data() : items_.data();
  if (below > 0) sort_ties(sorted, keys, below, free);
  return sorted;
}

}  // namespace kaustik::photon
