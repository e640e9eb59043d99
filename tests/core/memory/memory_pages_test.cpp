#include "core/memory/memory_pages.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

namespace kaustik {
namespace {

// Pages have between 4096 and 65536 bytes. Nothing outside the given bytes may change, nor what is near their
// ends, and the memory can be written again.
TEST(MemoryPages, ReturningPagesChangesNothingElse) {
  constexpr size_t kSize = 1 << 20, kBegin = 100001, kEnd = 900001;
  std::vector<unsigned char> bytes(kSize, 7);
  prefer_large_pages(bytes.data(), bytes.size());
  give_back_pages(bytes.data() + kBegin, kEnd - kBegin);
  const auto is_seven = [](unsigned char b) { return b == 7; };
  EXPECT_TRUE(std::all_of(bytes.begin(), bytes.begin() + kBegin, is_seven));
  EXPECT_TRUE(std::all_of(bytes.begin() + kEnd, bytes.end(), is_seven));
  std::fill(bytes.begin(), bytes.end(), 9);
  EXPECT_EQ(std::count(bytes.begin(), bytes.end(), 9), ptrdiff_t(kSize));
}

TEST(MemoryPages, RangesBelowAPageAreLeftAlone) {
  std::vector<unsigned char> bytes(4096, 7);
  give_back_pages(bytes.data() + 1, 4094);
  give_back_pages(bytes.data(), 0);
  EXPECT_EQ(std::count(bytes.begin(), bytes.end(), 7), 4096);
}

}  // namespace
}  // namespace kaustik
