#include "photon/map/key_order.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <vector>

namespace kaustik::photon {
namespace {

std::vector<uint32_t> indices(std::span<const uint64_t> items) {
  return std::vector<uint32_t>(items.begin(), items.end());
}

std::vector<uint32_t> expected(const std::vector<uint64_t>& keys) {
  std::vector<uint32_t> order(keys.size());
  for (size_t i = 0; i < order.size(); ++i) order[i] = uint32_t(i);
  std::stable_sort(order.begin(), order.end(), [&](uint32_t a, uint32_t b) { return keys[a] < keys[b]; });
  return order;
}

// The masks give: all bits; few and many ties; ties in the highest 32 bits that lower bits settle; a single
// key. The sizes lie on both sides of the change from comparisons to a radix sort.
TEST(KeyOrder, AgreesWithAStableSort) {
  std::mt19937_64 random(7);
  KeyOrder order;
  for (const size_t size : {0, 1, 2, 3, 255, 512, 513, 70000, 1000}) {
    for (const uint64_t mask : {~uint64_t(0) >> 1, uint64_t(0xff), uint64_t(0x7000000000000003),
                                uint64_t(0x40000000000fffff), uint64_t(0x00000007ffffffff), uint64_t(0)}) {
      std::vector<uint64_t> keys(size);
      for (uint64_t& key : keys) key = (random() & mask) | (0x0120000000ff0000 & ~mask);
      EXPECT_TRUE(indices(order.sort(keys)) == expected(keys)) << size << " keys, mask " << mask;
    }
  }
}

TEST(KeyOrder, SortsSortedAndReversedKeys) {
  std::vector<uint64_t> keys(5000);
  for (size_t i = 0; i < keys.size(); ++i) keys[i] = i << 40;
  KeyOrder order;
  EXPECT_TRUE(indices(order.sort(keys)) == expected(keys));
  std::reverse(keys.begin(), keys.end());
  EXPECT_TRUE(indices(order.sort(keys)) == expected(keys));
}

}  // namespace
}  // namespace kaustik::photon
