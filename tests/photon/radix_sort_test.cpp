#include "photon/radix_sort.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <random>
#include <vector>

namespace kaustik::photon {
namespace {

using Pair = std::pair<uint64_t, uint32_t>;

std::vector<Pair> sorted(const std::vector<uint64_t>& keys) {
  UninitialisedArray<uint64_t> k(keys.size());
  UninitialisedArray<uint32_t> v(keys.size());
  for (size_t i = 0; i < keys.size(); ++i) {
    k[i] = keys[i];
    v[i] = uint32_t(i);
  }
  radix_sort(k, v);
  std::vector<Pair> result;
  for (size_t i = 0; i < k.size(); ++i) result.emplace_back(k[i], v[i]);
  return result;
}

std::vector<Pair> expected(const std::vector<uint64_t>& keys) {
  std::vector<Pair> result;
  for (size_t i = 0; i < keys.size(); ++i) result.emplace_back(keys[i], uint32_t(i));
  std::sort(result.begin(), result.end());  // the index breaks ties
  return result;
}

TEST(RadixSort, AgreesWithStdSort) {
  std::mt19937_64 random(7);
  for (const size_t size : {0, 1, 2, 3, 255, 1000, 300000}) {
    for (const uint64_t mask : {~uint64_t(0), uint64_t(0xff), uint64_t(0x7000000000000003), uint64_t(0)}) {
      std::vector<uint64_t> keys(size);
      for (uint64_t& key : keys) key = (random() & mask) | (0x0120000000ff0000 & ~mask);
      EXPECT_TRUE(sorted(keys) == expected(keys)) << size << " keys, mask " << mask;
    }
  }
}

TEST(RadixSort, DoesNotDependOnTheThreads) {
  std::mt19937_64 random(8);
  std::vector<uint64_t> keys(500000);
  for (uint64_t& key : keys) key = random() & 0xffff00000fff;
  const std::vector<Pair> one = expected(keys);
  for (const size_t threads : {1, 2, 3, 8}) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    EXPECT_TRUE(sorted(keys) == one) << threads << " threads";
  }
}

}  // namespace
}  // namespace kaustik::photon
