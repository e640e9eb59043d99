#include <gmock/gmock.h>

#include <limits>
#include <nlohmann/json.hpp>

#include "render/picture/image_io.h"
#include "tests/apps/support/program.h"

namespace kaustik::app {
namespace {

using test::Outcome;
using test::run_kaustik;
using ::testing::HasSubstr;

class CompareCommand : public test::ProgramTest {
 protected:
  // A picture with one value everywhere except in one pixel.
  std::string picture(const std::string& name, float value, float at_3_2, int width = 8) const {
    render::Image image(width, 6, Rgb(value));
    image.at(3, 2) = Rgb(at_3_2);
    render::write_image(path(name), image);
    return path(name);
  }
};

TEST_F(CompareCommand, ReportsAKnownError) {
  const std::string reference = picture("r.exr", 0.5f, 0.5f), image = picture("i.exr", 0.5f, 1.5f);
  const Outcome outcome = run_kaustik({"compare", reference, image, "--json"});
  ASSERT_EQ(outcome.code, kDone) << outcome.err;
  const nlohmann::json json = nlohmann::json::parse(outcome.out);
  // One of 48 pixels is off by 1; all values are exact in binary, and only doubles round.
  EXPECT_NEAR(json["rmse"].get<double>(), std::sqrt(1.0 / 48), 1e-12);
  EXPECT_NEAR(json["relmse"].get<double>(), 1.0 / (0.25 + 0.01) / 48, 1e-12);
  // The pixel's blocks of 2 x 2 and 4 x 4 are whole; of the 8 x 6 pixels there is one block of 8 x 8.
  for (const auto& [side, pixels] : {std::pair("1", 1.0), {"2", 4.0}, {"4", 16.0}, {"8", 48.0}}) {
    EXPECT_NEAR(json["relmse_of_blocks"][side].get<double>(), 1 / pixels / (0.25 + 0.01) / 48, 1e-12);
  }
  EXPECT_EQ(json["max_difference"]["value"], 1.0);
  EXPECT_EQ(json["max_difference"]["x"], 3);
  EXPECT_EQ(json["max_difference"]["y"], 2);
  EXPECT_EQ(json["pixels"]["compared"], 48);
}

TEST_F(CompareCommand, PrintsTheErrorOfBlocks) {
  const std::string reference = picture("r.exr", 0.5f, 0.5f), image = picture("i.exr", 0.5f, 1.5f);
  // 1 / 0.26 / 48 = 0.0801282 for single pixels; a 4th, a 16th and a 48th of it for blocks.
  EXPECT_THAT(run_kaustik({"compare", reference, image}).out,
              HasSubstr("of blocks       0.0200321 (2 x 2), 0.00500801 (4 x 4), 0.00166934 (8 x 8)\n"));
}

TEST_F(CompareCommand, EqualPicturesHaveNoError) {
  const std::string reference = picture("r.exr", 0.5f, 1.0f);
  const Outcome json = run_kaustik({"compare", reference, reference, "--json", "--max-relmse", "0"});
  EXPECT_EQ(json.code, kDone);
  EXPECT_TRUE(nlohmann::json::parse(json.out)["psnr"].is_null());
  EXPECT_EQ(run_kaustik({"compare", reference, reference}).code, kDone);
}

TEST_F(CompareCommand, ExitsWithOneAboveTheLimitOnly) {
  const std::string reference = picture("r.exr", 0.5f, 0.5f), image = picture("i.exr", 0.5f, 1.5f);
  // relMSE is 0.080..., as computed in ReportsAKnownError.
  EXPECT_EQ(run_kaustik({"compare", reference, image, "--max-relmse", "0.081"}).code, kDone);
  const Outcome above = run_kaustik({"compare", reference, image, "--max-relmse", "0.079"});
  EXPECT_EQ(above.code, kFailed);
  EXPECT_THAT(above.err, HasSubstr("above 0.079"));
}

TEST_F(CompareCommand, NonFinitePixelsExceedAnyLimit) {
  const std::string reference = picture("r.exr", 0.5f, 0.5f);
  const std::string image = picture("i.exr", 0.5f, std::numeric_limits<float>::quiet_NaN());
  EXPECT_EQ(run_kaustik({"compare", reference, image, "--max-relmse", "1000"}).code, kFailed);
}

TEST_F(CompareCommand, MaskBrightLeavesOutTheNeighbourhood) {
  const std::string reference = picture("r.exr", 0.5f, 9.0f), image = picture("i.exr", 0.5f, 1.0f);
  const Outcome outcome = run_kaustik({"compare", reference, image, "--json", "--mask-bright", "4"});
  ASSERT_EQ(outcome.code, kDone);
  const nlohmann::json json = nlohmann::json::parse(outcome.out);
  EXPECT_EQ(json["pixels"]["masked"], 25);  // the 5 x 5 pixels about (3, 2) all lie inside 8 x 6
  EXPECT_EQ(json["rmse"], 0.0);
}

TEST_F(CompareCommand, WritesAHeatmap) {
  const std::string reference = picture("r.exr", 0.5f, 0.5f), image = picture("i.exr", 0.5f, 1.5f);
  ASSERT_EQ(run_kaustik({"compare", reference, image, "--heatmap", path("h.png")}).code, kDone);
  const render::Image heat = render::read_image(path("h.png"));
  EXPECT_GT(luminance(heat.at(3, 2)), luminance(heat.at(0, 0)));
}

TEST_F(CompareCommand, BadPicturesExitWithTwo) {
  const std::string reference = picture("r.exr", 0.5f, 0.5f);
  EXPECT_EQ(run_kaustik({"compare", reference, path("missing.exr")}).code, kBadCommandLine);
  EXPECT_EQ(run_kaustik({"compare", reference, picture("wide.exr", 0.5f, 0.5f, 9)}).code, kBadCommandLine);
  EXPECT_EQ(run_kaustik({"compare", reference, reference, "--max-relmse", "-1"}).code, kBadCommandLine);
  EXPECT_EQ(run_kaustik({"compare", reference, reference, "--max-relmse", "low"}).code, kBadCommandLine);
  EXPECT_EQ(run_kaustik({"compare", reference, reference, "--heatmap", path("no/h.png")}).code,
            kBadCommandLine);
}

}  // namespace
}  // namespace kaustik::app
