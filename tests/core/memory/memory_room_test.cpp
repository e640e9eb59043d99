// Tests the measure of what the process holds, and limits of it.

#include "core/memory/memory_room.h"

#include <gtest/gtest.h>

#include <cstring>
#include <memory>

#include "core/memory/process_memory.h"

namespace kaustik {
namespace {

// Of a large array only the pages that are written count. Others of this process change by less than a tenth.
TEST(MemoryRoom, HeldMemoryGrowsByWhatIsWritten) {
  constexpr size_t kBytes = 100'000'000;
  const uint64_t before = held_memory();
  const auto array = std::make_unique_for_overwrite<char[]>(2 * kBytes);
  std::memset(array.get(), 1, kBytes);
  EXPECT_NEAR(double(held_memory() - before), double(kBytes), 0.1 * double(kBytes));
}

TEST(MemoryRoom, SaysWhatIsLackingAndWhy) {
  EXPECT_EQ(MemoryRoom().lacks(uint64_t{1} << 60), "");
  const MemoryRoom room(held_memory() + 200'000'000, "--memory");
  EXPECT_EQ(room.lacks(100'000'000), "");
  const std::string lack = room.lacks(3'000'000'000);
  EXPECT_TRUE(lack.starts_with("it needs about 3 GB of memory, but --memory leaves ")) << lack;
  EXPECT_EQ(MemoryRoom(1, "--memory").left(), 0u);
  EXPECT_EQ(room.exceeded(), "");
  EXPECT_EQ(MemoryRoom(1, "--memory").exceeded(),
            "the shapes up to this one take more memory than --memory allows");
}

}  // namespace
}  // namespace kaustik
