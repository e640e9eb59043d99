// Least-significant-digit radix sort in fixed blocks.

#include "photon/radix_sort.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <array>
#include <vector>

namespace kaustik::photon {

namespace {

constexpr int kDigitBits = 8;
constexpr size_t kDigits = size_t(1) << kDigitBits;
constexpr size_t kBlock = size_t(1) << 17;  // fixed, so that blocks do not depend on the threads

using Histogram = std::array<uint64_t, kDigits>;

struct Pairs {
  UninitialisedArray<uint64_t> keys;
  UninitialisedArray<uint32_t> values;
};

size_t digit(uint64_t key, int shift) {
  return size_t(key >> shift) & (kDigits - 1);
}

template <class Fn>
void for_each_block(size_t size, const Fn& fn) {
  const size_t blocks = (size + kBlock - 1) / kBlock;
  tbb::parallel_for(size_t(0), blocks,
                    [&](size_t b) { fn(b, b * kBlock, std::min(size, (b + 1) * kBlock)); });
}

// Bits that differ between any two keys.
uint64_t varying_bits(const UninitialisedArray<uint64_t>& keys) {
  std::vector<uint64_t> blocks((keys.size() + kBlock - 1) / kBlock);
  for_each_block(keys.size(), [&](size_t b, size_t begin, size_t end) {
    uint64_t bits = 0;
    for (size_t i = begin; i < end; ++i) bits |= keys[i] ^ keys[0];
    blocks[b] = bits;
  });
  uint64_t bits = 0;
  for (const uint64_t block : blocks) bits |= block;
  return bits;
}

// Counts become the places of each block's first key of each digit.
void exclusive_sum(std::vector<Histogram>& blocks) {
  uint64_t sum = 0;
  for (size_t d = 0; d < kDigits; ++d) {
    for (Histogram& block : blocks) {
      const uint64_t count = block[d];
      block[d] = sum;
      sum += count;
    }
  }
}

void sort_digit(const Pairs& from, Pairs& to, int shift, std::vector<Histogram>& blocks) {
  for_each_block(from.keys.size(), [&](size_t b, size_t begin, size_t end) {
    Histogram count{};
    for (size_t i = begin; i < end; ++i) ++count[digit(from.keys[i], shift)];
    blocks[b] = count;
  });
  exclusive_sum(blocks);
  for_each_block(from.keys.size(), [&](size_t b, size_t begin, size_t end) {
    Histogram place = blocks[b];
    for (size_t i = begin; i < end; ++i) {
      const uint64_t at = place[digit(from.keys[i], shift)]++;
      to.keys[at] = from.keys[i];
      to.values[at] = from.values[i];
    }
  });
}

}  // namespace

void radix_sort(UninitialisedArray<uint64_t>& keys, UninitialisedArray<uint32_t>& values) {
  if (keys.size() < 2) return;
  const uint64_t varying = varying_bits(keys);
  Pairs from{std::move(keys), std::move(values)};
  Pairs to{UninitialisedArray<uint64_t>(from.keys.size()), UninitialisedArray<uint32_t>(from.values.size())};
  std::vector<Histogram> blocks((from.keys.size() + kBlock - 1) / kBlock);
  for (int shift = 0; shift < 64; shift += kDigitBits) {
    if (digit(varying, shift) == 0) continue;
    sort_digit(from, to, shift, blocks);
    std::swap(from, to);
  }
  keys = std::move(from.keys);
  values = std::move(from.values);
}

}  // namespace kaustik::photon
