// Tests the files of a sweep's cells: what is read is what was written, and wrong numbers are refused.

#include "apps/sweep/sweep_files.h"

#include <gmock/gmock.h>

namespace kaustik::app {
namespace {

using ::testing::HasSubstr;

Json example() {
  SweepCell cell;
  cell.error.images = 2, cell.error.compared = 100, cell.error.masked = 3;
  cell.radii.caustic = 0.25f;
  cell.point.photons = 1000;
  return cell_json(cell);
}

// The error of reading the cell with another value at the place; empty if there is none.
std::string complaint(const std::string& place, const Json& value) {
  Json cell = example();
  cell[Json::json_pointer(place)] = value;
  try {
    cell_from_json(cell);
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return {};
}

TEST(SweepFiles, KeepsNumbers) {
  const SweepCell back = cell_from_json(example());
  EXPECT_EQ(back.error.images, 2u);
  EXPECT_EQ(back.error.compared, 100u);
  EXPECT_EQ(back.error.masked, 3u);
  EXPECT_EQ(back.radii.caustic, 0.25f);
}

// The JSON library would turn -1 into 2^64 - 1, and what 1e30 becomes is undefined.
TEST(SweepFiles, NumbersThatAreNoCountsAreRefusedByName) {
  for (const Json& value : {Json(-1), Json(1e30), Json(0.5), Json("2")}) {
    for (const std::string key : {"compared", "masked", "not_finite"})
      EXPECT_THAT(complaint("/error/pixels/" + key, value),
                  HasSubstr("\"" + key + "\": expected a whole number"))
          << value;
    EXPECT_THAT(complaint("/seeds", value), HasSubstr("\"seeds\": expected a whole number")) << value;
  }
}

TEST(SweepFiles, RadiiThatAreNoneAreRefusedByName) {
  for (const Json& value : {Json(-1), Json(1e300), Json("2")})
    EXPECT_THAT(complaint("/r0/caustic", value), HasSubstr("\"caustic\": expected a radius")) << value;
}

}  // namespace
}  // namespace kaustik::app
