#include <gtest/gtest.h>

#include <limits>

#include "apps/command_line/values.h"

namespace kaustik::app {
namespace {

TEST(ParseCount, ReadsSuffixesFractionsAndPowers) {
  EXPECT_EQ(parse_count("0"), 0u);
  EXPECT_EQ(parse_count("250"), 250u);
  EXPECT_EQ(parse_count("1k"), 1'000u);
  EXPECT_EQ(parse_count("10M"), 10'000'000u);
  EXPECT_EQ(parse_count("2.5G"), 2'500'000'000u);
  EXPECT_EQ(parse_count("1T"), 1'000'000'000'000u);
  EXPECT_EQ(parse_count("1e6"), 1'000'000u);
  EXPECT_EQ(parse_count("1.5e3k"), 1'500'000u);
  EXPECT_EQ(parse_count("3.000"), 3u);
}

TEST(ParseCount, IsExactUpTo64Bits) {
  EXPECT_EQ(parse_count("18446744073709551615"), std::numeric_limits<uint64_t>::max());
  EXPECT_EQ(parse_count("18446744073709551616"), std::nullopt);
  // 2^53 + 1 is not representable as a double.
  EXPECT_EQ(parse_count("9007199254.740993M"), 9'007'199'254'740'993u);
  EXPECT_EQ(parse_count("1e20"), std::nullopt);
}

TEST(ParseCount, RefusesOtherThanWholeNumbers) {
  for (const char* text :
       {"", "M", ".", "-1", "+1", "1.5", "0.0001k", "1 k", "1kk", "ten", "1e", "1e-1", "0x10", "nan"}) {
    EXPECT_EQ(parse_count(text), std::nullopt) << text;
  }
}

TEST(ParseNumber, ReadsFiniteDecimals) {
  EXPECT_EQ(parse_number("0.25"), 0.25f);
  EXPECT_EQ(parse_number("-3"), -3.0f);
  EXPECT_EQ(parse_number("+1e-3"), 1e-3f);
  for (const char* text : {"", "abc", "1m", "inf", "nan", "1e50", "1 "})
    EXPECT_EQ(parse_number(text), std::nullopt) << text;
}

TEST(ParseInteger, ReadsSignedWholeNumbers) {
  EXPECT_EQ(parse_integer("-12"), -12);
  EXPECT_EQ(parse_integer("+12"), 12);
  for (const char* text : {"", "+", "-", "+-1", "1.0", "9223372036854775808"}) {
    EXPECT_EQ(parse_integer(text), std::nullopt) << text;
  }
}

TEST(Durations, AcceptUnits) {
  EXPECT_EQ(parse_duration("60s"), 60.0);
  EXPECT_EQ(parse_duration("10m"), 600.0);
  EXPECT_EQ(parse_duration("1.5h"), 5400.0);
  EXPECT_EQ(parse_duration("500ms"), 0.5);
  EXPECT_EQ(parse_duration("0s"), 0.0);
  for (const char* bad : {"", "s", "60", "-1s", "1d", "1h30m", "60 s", "infs", "nanm", "1e50h"})
    EXPECT_EQ(parse_duration(bad), std::nullopt) << bad;
}

}  // namespace
}  // namespace kaustik::app
