// Tests that numbers which are not finite or too large are refused with their location.
#include <gmock/gmock.h>

#include "tests/apps/import/import_support.h"

namespace kaustik::pbrt {
namespace {

class ImportNumbers : public ImportTest {};

TEST_F(ImportNumbers, NanAndInfinityAreRefused) {
  for (const std::string bad : {"nan", "inf", "NaN", "Infinity"}) {
    EXPECT_THAT(first_lines("Shape \"sphere\" \"float radius\" " + bad),
                testing::HasSubstr("2:31: error: expected a number for `radius`, not `" + bad + "`"));
    EXPECT_THAT(first_lines("LightSource \"point\" \"rgb I\" [1 " + bad + " 1]"),
                testing::HasSubstr("2:32: error: expected a value or `]`, not `" + bad + "`"));
    EXPECT_THAT(first_lines("Translate " + bad + " 0 0"),
                testing::HasSubstr("2:11: error: `Translate` takes 3 numbers: expected number 1"));
    EXPECT_FALSE(loaded_);
  }
}

// Meshes alone may hold points that are not finite.
TEST_F(ImportNumbers, LightsAreAtFinitePlaces) {
  for (const std::string bad : {"nan", "-nan", "NaN", "Infinity", "-inf"}) {
    EXPECT_THAT(first_lines("LightSource \"point\" \"point3 from\" [0 " + bad + " 3]"),
                testing::MatchesRegex("2:38: error: [^\n]*`" + bad + "`[^\n]*\n"));
    EXPECT_FALSE(loaded_);
  }
}

TEST_F(ImportNumbers, NumbersBeyondTheRangeOfFloatsAreRefused) {
  for (const std::string bad : {"1e39", "-1e39", "1e300", "1e999", "-inf"}) {
    const std::string message = ": error: `" + bad + "` is beyond the range of floats\n";
    EXPECT_EQ(first_lines("Shape \"sphere\" \"float radius\" " + bad), "2:31" + message);
    EXPECT_EQ(first_lines("Material \"dielectric\" \"float eta\" " + bad), "2:35" + message);
    EXPECT_EQ(first_lines("Translate " + bad + " 0 0 Shape \"sphere\""), "2:11" + message);
  }
}

TEST_F(ImportNumbers, PowerBeyondTheRangeOfFloatsIsRefused) {
  EXPECT_EQ(first_lines("AreaLightSource \"diffuse\" \"rgb L\" [1e38 1e38 1e38] Shape \"sphere\" "
                        "\"float radius\" 1000"),
            "2:1: error: the power of this light is beyond the range of floats\n");
  EXPECT_EQ(first_lines("LightSource \"point\" \"rgb I\" [1e38 1 1]"),
            "2:1: error: the power of this light is beyond the range of floats\n");
}

}  // namespace
}  // namespace kaustik::pbrt
