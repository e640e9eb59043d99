// Tests how threads that decode images share the memory that is left.

#include "images/decoding_memory.h"

#include <gtest/gtest.h>

#include <atomic>
#include <optional>
#include <thread>

namespace kaustik::images {
namespace {

TEST(DecodingMemory, IsRefusedToWhatDoesNotFitAlone) {
  DecodingMemory all;
  const std::function<uint64_t()> left = [] { return uint64_t{100}; };
  DecodingMemory::Part fits(all, left), another(all, left);
  EXPECT_TRUE(fits.take(60));
  EXPECT_TRUE(another.take(40));
  DecodingMemory empty;
  DecodingMemory::Part too_large(empty, left);
  EXPECT_FALSE(too_large.take(101));
}

TEST(DecodingMemory, IsWaitedForWhereOthersHaveIt) {
  DecodingMemory all;
  std::atomic<int> asked = 0;
  const std::function<uint64_t()> left = [&] {
    ++asked;
    return uint64_t{100};
  };
  std::optional<DecodingMemory::Part> first(std::in_place, all, left);
  ASSERT_TRUE(first->take(60));
  std::atomic<bool> ended = false;
  std::thread other([&] {
    DecodingMemory::Part second(all, left);
    EXPECT_TRUE(second.take(60));
    EXPECT_TRUE(ended);
  });
  while (asked < 2) std::this_thread::yield();  // until the other thread has been told to wait
  ended = true;
  first.reset();
  other.join();
}

}  // namespace
}  // namespace kaustik::images
