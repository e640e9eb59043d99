#include <gtest/gtest.h>

#include <array>

#include "core/diagnostics/diagnostics.h"
#include "core/diagnostics/nearest_name.h"

namespace kaustik {
namespace {

TEST(Diagnostics, ShowsPlaceLineAndCaret) {
  Diagnostics d;
  const uint32_t file = d.files.add("dir/a.pbrt", "first\nsecond line\n");
  d.error({file, 2, 8}, "wrong", {{{file, 1, 1}, "because of this"}});
  EXPECT_EQ(d.format_all(),
            "dir/a.pbrt:2:8: error: wrong\n"
            "second line\n"
            "       ^\n"
            "dir/a.pbrt:1:1: note: because of this\n"
            "first\n"
            "^\n");
}

// Only the beginning of every 1,024th line is kept.
TEST(Diagnostics, FindsTheLinesOfLongFiles) {
  Diagnostics diagnostics;
  std::string text;
  for (int i = 1; i <= 5000; ++i) text += std::to_string(i) + "\r\n";
  const uint32_t file = diagnostics.files.add("long.obj", text);
  for (const uint32_t line : {1u, 2u, 1023u, 1024u, 1025u, 2048u, 2049u, 5000u})
    EXPECT_EQ(diagnostics.files.line(file, line), std::to_string(line));
  for (const uint32_t line : {0u, 5001u, 5002u, 6144u, 1000000u})
    EXPECT_EQ(diagnostics.files.line(file, line), "");
}

TEST(Diagnostics, KeepsTabsSoThatTheCaretIsAligned) {
  Diagnostics d;
  const uint32_t file = d.files.add("a", "\tx\ty");
  d.warning({file, 1, 4}, "w");
  EXPECT_EQ(d.format_all(), "a:1:4: warning: w\n\tx\ty\n\t \t^\n");
}

TEST(Diagnostics, CountsMultibyteLettersOnce) {
  Diagnostics d;
  const uint32_t file = d.files.add("a", "\xc3\xa4\xc3\xb6 x");  // two letters of two bytes each
  d.error({file, 1, 6}, "e");
  EXPECT_EQ(d.format_all(), "a:1:6: error: e\n\xc3\xa4\xc3\xb6 x\n   ^\n");
}

TEST(Diagnostics, CutsLongLinesAroundTheCaret) {
  Diagnostics d;
  const std::string line = std::string(1000, 'a') + "X" + std::string(1000, 'b');
  const uint32_t file = d.files.add("a", line);
  d.error({file, 1, 1001}, "e");
  EXPECT_EQ(d.format_all(), "a:1:1001: error: e\n..." + std::string(50, 'a') + "X" + std::string(49, 'b') +
                                "...\n" + std::string(53, ' ') + "^\n");
}

TEST(Diagnostics, LeavesOutControlCharactersAndCarriageReturns) {
  Diagnostics d;
  const uint32_t file = d.files.add("a", std::string("a\0b\r\nc", 6));
  d.error({file, 1, 3}, "e");
  EXPECT_EQ(d.format_all(), "a:1:3: error: e\na b\n  ^\n");
}

TEST(Diagnostics, FormatsMessagesWithoutALocation) {
  Diagnostics d;
  d.error({}, "no file");
  const uint32_t file = d.files.add("a", "");
  d.error({file, 0, 0}, "whole file");
  d.error({file, 7, 3}, "past the end");
  EXPECT_EQ(d.format_all(), "error: no file\na: error: whole file\na:7:3: error: past the end\n");
}

TEST(Diagnostics, SortsByLocationAndKeepsTheOrderWithinOne) {
  Diagnostics d;
  d.error({0, 2, 1}, "c");
  d.error({0, 1, 5}, "a");
  d.warning({0, 1, 5}, "b");
  d.sort_by_location();
  EXPECT_EQ(d.entries()[0].message, "a");
  EXPECT_EQ(d.entries()[1].message, "b");
  EXPECT_EQ(d.entries()[2].message, "c");
  EXPECT_EQ(d.error_count(), 2u);
  EXPECT_EQ(d.warning_count(), 1u);
}

TEST(NearestName, EditDistanceCountsEditsAndSwaps) {
  EXPECT_EQ(edit_distance("", "abc"), 3u);
  EXPECT_EQ(edit_distance("kitten", "sitting"), 3u);
  EXPECT_EQ(edit_distance("Shpae", "Shape"), 1u);  // two neighbours swapped
  EXPECT_EQ(edit_distance("FOV", "fov"), 0u);
}

TEST(NearestName, FindsTheNearestNameWithinReach) {
  const std::array<std::string_view, 3> names = {"reflectance", "sigma", "eta"};
  EXPECT_EQ(nearest_name("reflectanc", names), "reflectance");
  EXPECT_EQ(nearest_name("etta", names), "eta");
  EXPECT_EQ(nearest_name("photons", names), std::nullopt);
  EXPECT_EQ(name_hint("etta", names), "; did you mean `eta`? known: reflectance, sigma, eta");
  EXPECT_EQ(name_hint("photons", names), "; known: reflectance, sigma, eta");
  EXPECT_EQ(nearest_name(std::string(1'000'000, 'e'), names), std::nullopt);
}

// A file may name thousands of things that it does not define among thousands that it does.
TEST(Diagnostics, HintsEndAfterManyComparisons) {
  Diagnostics d;
  const std::vector<std::string> all(10'000, "material");
  int hints = 0, lists = 0;
  const auto names = [&] {
    ++lists;
    return std::vector<std::string_view>(all.begin(), all.end());
  };
  for (int i = 0; i < 1000; ++i) hints += d.hint("materail", names) == "; did you mean `material`?";
  EXPECT_GE(hints, 100);
  EXPECT_LT(hints, 110);
  EXPECT_EQ(lists, hints);
}

TEST(Diagnostics, EqualWarningsAreCountedButNoErrors) {
  Diagnostics d;
  const uint32_t file = d.files.add("a.pbrt", "x\ny\n");
  d.warning({file, 1, 1}, "ignored");
  d.error({file, 1, 1}, "wrong");
  d.warning({file, 2, 1}, "ignored");
  d.warning({file, 2, 1}, "another");
  d.error({file, 2, 1}, "wrong");
  d.merge_equal_warnings();
  ASSERT_EQ(d.entries().size(), 4u);
  EXPECT_EQ(d.entries()[0].message, "ignored (2 times)");
  EXPECT_EQ(d.entries()[0].location.line, 1u);
  EXPECT_EQ(d.entries()[2].message, "another");
  EXPECT_EQ(d.error_count(), 2u);
}

}  // namespace
}  // namespace kaustik
