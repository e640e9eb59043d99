#include "photon/map/key_buckets.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <vector>

namespace kaustik::photon {
namespace {

constexpr uint64_t kKeyMask = (uint64_t(1) << (3 * kMortonBits)) - 1;

std::vector<uint64_t> sorted_sample(size_t size, uint64_t mask, uint64_t offset) {
  std::mt19937_64 random(11);
  std::vector<uint64_t> keys(size);
  for (uint64_t& key : keys) key = ((random() & mask) + offset) & kKeyMask;
  std::sort(keys.begin(), keys.end());
  return keys;
}

void check_ascending(const KeyBuckets& buckets, std::vector<uint64_t> keys) {
  keys.insert(keys.end(), {0, kKeyMask});
  std::sort(keys.begin(), keys.end());
  for (size_t i = 0; i < keys.size(); ++i) {
    const uint32_t bucket = buckets.of(keys[i]);
    ASSERT_LT(bucket, buckets.size());
    ASSERT_LE(buckets.of(keys[i - (i > 0)]), bucket);
    if (!buckets.single_key(bucket)) continue;
    ASSERT_TRUE(keys[i] == 0 || buckets.of(keys[i] - 1) < bucket);
    ASSERT_TRUE(keys[i] == kKeyMask || buckets.of(keys[i] + 1) > bucket);
  }
}

// A bucket's ends lie within a quarter of a bucket of their exact places, so it holds at most one and a half
// times its share. The keys are spread evenly, share their first 20 bits, or have few bits above many.
TEST(KeyBuckets, HoldAboutEqualPartsOfTheSample) {
  for (const uint64_t mask : {kKeyMask, kKeyMask >> 20, uint64_t(0x7800000fffffffff)}) {
    const size_t wanted = 500, each = 64;
    const std::vector<uint64_t> sample = sorted_sample(wanted * each, mask, uint64_t(5) << 45);
    const KeyBuckets buckets(sample, wanted);
    EXPECT_EQ(buckets.size(), wanted) << mask;
    std::vector<size_t> count(buckets.size());
    for (const uint64_t key : sample) ++count[buckets.of(key)];
    EXPECT_LE(*std::ranges::max_element(count), each * 3 / 2 + 1) << mask;
    check_ascending(buckets, sample);
  }
}

TEST(KeyBuckets, FrequentKeyHasABucketOfItsOwn) {
  for (const uint64_t frequent : {uint64_t(0), uint64_t(1) << 48, kKeyMask / 3, kKeyMask}) {
    std::vector<uint64_t> sample = sorted_sample(1000, kKeyMask, 0);
    sample.insert(sample.end(), 1000, frequent);
    std::sort(sample.begin(), sample.end());
    const KeyBuckets buckets(sample, 100);
    EXPECT_TRUE(buckets.single_key(buckets.of(frequent))) << frequent;
    EXPECT_LE(buckets.size(), 200u);
    check_ascending(buckets, sample);
  }
}

TEST(KeyBuckets, EmptySampleGivesOneBucket) {
  const KeyBuckets buckets({}, 1);
  EXPECT_EQ(buckets.size(), 1u);
  EXPECT_EQ(buckets.of(0), 0u);
  EXPECT_EQ(buckets.of(kKeyMask), 0u);
  EXPECT_FALSE(buckets.single_key(0));
}

TEST(KeyBuckets, SampleOfOneKeyGivesASingleKeyBucket) {
  const KeyBuckets buckets(std::vector<uint64_t>(64, 12345), 4);
  EXPECT_TRUE(buckets.single_key(buckets.of(12345)));
  check_ascending(buckets, {12344, 12345, 12346});
}

}  // namespace
}  // namespace kaustik::photon
