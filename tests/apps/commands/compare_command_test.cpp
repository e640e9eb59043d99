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
using ::testing::Not;

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

// Even pictures have no edges: of the grey 0.2 and 0.3, FLIP is as tests/render/compare/flip_test.cpp works
// out.
TEST_F(CompareCommand, FlipOfDisplayValuesAndOfRadiance) {
  const auto flip_of = [&](const std::string& reference, const std::string& image) {
    const Outcome outcome = run_kaustik({"compare", reference, image, "--flip", "--json"});
    EXPECT_EQ(outcome.code, kDone) << outcome.err;
    return nlohmann::json::parse(outcome.out)["flip"];
  };
  const nlohmann::json display = flip_of(picture("r.png", 0.2f, 0.2f), picture("i.png", 0.3f, 0.3f));
  EXPECT_NEAR(display["mean"].get<double>(), 0.95 / 0.4 / 41.27 * std::pow(9.817, 0.7), 5e-3);  // 8 bits
  EXPECT_TRUE(display["exposures"].is_null());
  const std::string reference = picture("r.exr", 0.5f, 8.0f), image = picture("i.exr", 0.5f, 1.5f);
  const nlohmann::json radiance = flip_of(reference, image);
  EXPECT_GT(radiance["mean"].get<double>(), 0);
  EXPECT_EQ(radiance["exposures"]["count"], 4);  // 8 is four stops above 0.5
  EXPECT_EQ(flip_of(reference, reference)["mean"], 0);
  EXPECT_THAT(run_kaustik({"compare", reference, image}).out, Not(HasSubstr("FLIP")));
  // The fewer pixels a degree has, the more the eye blurs a single bright pixel.
  const auto text_at = [&](const char* pixels) {
    return run_kaustik({"compare", reference, image, "--flip", "--pixels-per-degree", pixels}).out;
  };
  EXPECT_NE(text_at("10"), text_at("100"));
  for (const char* pixels : {"0", "1001", "many"})
    EXPECT_EQ(run_kaustik({"compare", reference, image, "--pixels-per-degree", pixels}).code,
              kBadCommandLine);
}

TEST_F(CompareCommand, WarnsOfPicturesThatShowRadianceDifferently) {
  const auto shown = [&](const std::string& name, float stops, render::Tonemap tonemap) {
    render::write_image(path(name), render::Image(8, 6, Rgb(0.25f)), {stops, tonemap});
    return path(name);
  };
  using enum render::Tonemap;
  const std::string radiance = picture("r.exr", 0.25f, 0.25f), plain = shown("plain.png", 0, kSrgb),
                    filmic = shown("filmic.png", 0.5f, kFilmic), lighter = shown("lighter.png", 1, kFilmic),
                    unknown = shown("unknown.jpg", 0, kSrgb);  // JPEG files do not keep the exposure
  const auto warning = [](const std::string& reference, const std::string& image) {
    return run_kaustik({"compare", reference, image}).err;
  };
  const std::string mixed = "one of the pictures is in an integer format";
  EXPECT_THAT(warning(radiance, filmic), HasSubstr(mixed));
  EXPECT_THAT(warning(filmic, radiance), HasSubstr("(--exposure 0.5 --tonemap filmic)"));
  EXPECT_THAT(warning(radiance, unknown), HasSubstr(mixed));
  EXPECT_EQ(warning(radiance, plain), "");
  EXPECT_THAT(warning(filmic, lighter), HasSubstr("the reference by --exposure 0.5 --tonemap filmic, the "
                                                  "other one by --exposure 1 --tonemap filmic"));
  EXPECT_EQ(warning(filmic, filmic), "");
  EXPECT_EQ(warning(filmic, unknown), "");
  EXPECT_EQ(warning(radiance, picture("other.exr", 0.5f, 0.5f)), "");
}

TEST_F(CompareCommand, WritesAMapOfFlip) {
  const std::string reference = picture("r.exr", 0.5f, 0.5f), image = picture("i.exr", 0.5f, 1.5f);
  const Outcome outcome = run_kaustik({"compare", reference, image, "--flip-map", path("f.png")});
  ASSERT_EQ(outcome.code, kDone) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("\nFLIP "));
  const render::Image map = render::read_image(path("f.png"));
  EXPECT_GT(luminance(map.at(3, 2)), luminance(map.at(7, 5)));
}

// A film with light in two classes; direct light is `direct` everywhere.
std::string film_with_layers(const std::string& path, float direct, const std::vector<std::string>& layers) {
  render::Film film(8, 6);
  for (int y = 0; y < 6; ++y)
    for (int x = 0; x < 8; ++x) {
      film.at(x, y).emitted = Rgb(x == 0 && y == 0 ? 9.0f : 0.0f);
      film.at(x, y).direct = Rgb(direct);
      film.at(x, y).depth = 2;
    }
  render::write_film(path, film, {render::layers_from_names(layers), {}, {}});
  return path;
}

TEST_F(CompareCommand, ComparesOneLayer) {
  const std::string reference = film_with_layers(path("r.exr"), 0.5f, {"emitted", "direct", "depth"});
  const std::string image = film_with_layers(path("i.exr"), 0.75f, {"emitted", "direct", "depth"});
  const auto json_of = [&](const std::string& layer) {
    const Outcome outcome = run_kaustik({"compare", reference, image, "--layer", layer, "--json"});
    EXPECT_EQ(outcome.code, kDone) << outcome.err;
    return nlohmann::json::parse(outcome.out);
  };
  // All numbers are exact in float and double.
  EXPECT_EQ(json_of("direct")["layer"], "direct");
  EXPECT_EQ(json_of("direct")["rmse"], 0.25);
  EXPECT_EQ(json_of("direct")["mean_ratio"], 1.5);
  EXPECT_EQ(json_of("emitted")["rmse"], 0);
  EXPECT_EQ(json_of("emitted")["mean_ratio"], 1);
  EXPECT_EQ(json_of("depth")["mean"], 2);  // a layer of one channel
  EXPECT_THAT(run_kaustik({"compare", reference, image, "--layer", "direct"}).out,
              HasSubstr("mean            0.75, reference 0.5, ratio 1.5\n"));
  // The bright pixel of the whole picture masks 3 x 3 pixels of a layer without bright pixels.
  const Outcome masked =
      run_kaustik({"compare", reference, image, "--layer", "direct", "--json", "--mask-bright", "4"});
  EXPECT_EQ(nlohmann::json::parse(masked.out)["pixels"]["masked"], 9);
}

// A film of 8 x 6 pixels, or the part of it from (x0, y0) on, whose radiance tells the pixel, with `more`
// added in the pixel (4, 3).
std::string numbered_film(const std::string& path, int x0, int y0, int width, int height, float more = 0) {
  render::Film film(width, height, x0, y0, 8, 6);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      film.at(x, y).direct = Rgb(float(x0 + x + 8 * (y0 + y)) + (x0 + x == 4 && y0 + y == 3 ? more : 0));
  render::write_film(path, film, {render::layers_from_names({"direct"}), {}, {}});
  return path;
}

TEST_F(CompareCommand, ComparesACropWithItsPartOfTheFullPicture) {
  const std::string full = numbered_film(path("full.exr"), 0, 0, 8, 6);
  const std::string crop = numbered_film(path("crop.exr"), 2, 1, 4, 3, 1);
  for (const auto& [reference, image] : {std::pair(full, crop), {crop, full}, {crop, crop}}) {
    const Outcome outcome = run_kaustik({"compare", reference, image, "--json", "--layer", "direct"});
    ASSERT_EQ(outcome.code, kDone) << outcome.err;
    const nlohmann::json json = nlohmann::json::parse(outcome.out);
    const bool same = reference == image;
    EXPECT_EQ(json["pixels"]["compared"], 12);
    EXPECT_EQ(json["max_difference"]["value"], same ? 0.0 : 1.0);
    EXPECT_EQ(json["max_difference"]["x"], same ? 2 : 4);  // of the full picture
    EXPECT_EQ(json["max_difference"]["y"], same ? 1 : 3);
    EXPECT_EQ(json["part"], (nlohmann::json{{"x", 2}, {"y", 1}, {"width", 4}, {"height", 3}}));
  }
  EXPECT_THAT(run_kaustik({"compare", full, crop}).out,
              HasSubstr("part            x 2 to 5, y 1 to 3 of the full picture\n"));
  EXPECT_THAT(run_kaustik({"compare", full, full}).out, Not(HasSubstr("part")));
}

TEST_F(CompareCommand, MasksACropByItsPartOfTheFullPicture) {
  const std::string full = numbered_film(path("full.exr"), 0, 0, 8, 6);
  const std::string crop = numbered_film(path("crop.exr"), 2, 1, 4, 3, 1);
  for (const std::vector<std::string>& layer : {std::vector<std::string>{}, {"--layer", "direct"}}) {
    std::vector<std::string> words = {"compare", full, crop, "--json", "--mask-bright", "28"};
    words.insert(words.end(), layer.begin(), layer.end());
    const nlohmann::json json = nlohmann::json::parse(run_kaustik(words).out);
    EXPECT_EQ(json["pixels"]["masked"], 9);  // 29, the crop's last pixel, masks 3 x 3 of its pixels
    EXPECT_EQ(json["rmse"], 0);
  }
}

TEST_F(CompareCommand, RefusesPicturesThatDoNotFit) {
  const std::string crop = numbered_film(path("crop.exr"), 2, 1, 4, 3);
  const auto message = [&](const std::string& reference, const std::string& image) {
    const Outcome outcome = run_kaustik({"compare", reference, image});
    EXPECT_EQ(outcome.code, kBadCommandLine);
    return outcome.err;
  };
  EXPECT_THAT(message(picture("narrow.exr", 1, 1, 7), crop),
              HasSubstr("sizes differ: reference 7 x 6, image 4 x 3 (a part of 8 x 6)"));
  EXPECT_THAT(message(crop, numbered_film(path("other.exr"), 3, 1, 4, 3)),
              HasSubstr("neither lies within the other one: the reference has x 2 to 5, y 1 to 3; the image "
                        "has x 3 to 6, y 1 to 3"));
}

TEST_F(CompareCommand, NamesTheLayersThatThereAre) {
  const std::string reference = film_with_layers(path("r.exr"), 0.5f, {"emitted", "direct", "depth"});
  const std::string image = film_with_layers(path("i.exr"), 0.5f, {"emitted"});
  const Outcome unknown = run_kaustik({"compare", reference, image, "--layer", "emission"});
  EXPECT_EQ(unknown.code, kBadCommandLine);
  EXPECT_THAT(unknown.err, HasSubstr("r.exr: it has no layer `emission`; there are: depth, direct, emitted"));
  const Outcome lacking = run_kaustik({"compare", reference, image, "--layer", "direct"});
  EXPECT_EQ(lacking.code, kBadCommandLine);
  EXPECT_THAT(lacking.err, HasSubstr("i.exr: it has no layer `direct`; there are: emitted"));
  const std::string plain = picture("plain.exr", 0.5f, 0.5f);
  EXPECT_THAT(run_kaustik({"compare", plain, plain, "--layer", "direct"}).err,
              HasSubstr("it has no layer `direct`, nor any other"));
}

TEST_F(CompareCommand, BlocksReportDeviations) {
  const std::string reference = picture("r.exr", 0.5f, 0.5f), image = picture("i.exr", 0.5f, 1.5f);
  const Outcome outcome = run_kaustik({"compare", reference, image, "--json", "--blocks", "4"});
  ASSERT_EQ(outcome.code, kDone) << outcome.err;
  // One pixel of the first block's 16 is off by 1: its mean is 0.5625, an eighth above 0.5.
  const nlohmann::json blocks = nlohmann::json::parse(outcome.out)["block_deviations"];
  EXPECT_EQ(blocks["side"], 4);
  EXPECT_EQ(blocks["count"], 4);
  EXPECT_EQ(blocks["mean"], 0.125 / 4);
  EXPECT_EQ(blocks["median"], 0);
  EXPECT_EQ(blocks["quantile_95"], 0.125);
  EXPECT_EQ(blocks["largest"]["value"], 0.125);
  EXPECT_EQ(blocks["largest"]["x"], 0);
  EXPECT_EQ(blocks["largest"]["mean"], 0.5625);
  EXPECT_THAT(
      run_kaustik({"compare", reference, image, "--blocks", "4"}).out,
      HasSubstr("4 x 4           |I / R - 1| of 4 blocks: mean 3.12 %, median 0 %, 95 % quantile 12.5 %"));
  EXPECT_THAT(run_kaustik({"compare", reference, image}).out, Not(HasSubstr("|I / R - 1|")));
  EXPECT_EQ(run_kaustik({"compare", reference, image, "--blocks", "0"}).code, kBadCommandLine);
  EXPECT_EQ(run_kaustik({"compare", reference, image, "--blocks", "x"}).code, kBadCommandLine);
}

// JSON has no infinity.
TEST_F(CompareCommand, LightWhereTheReferenceIsBlackIsNull) {
  const std::string reference = picture("r.exr", 0, 0), image = picture("i.exr", 0, 1);
  const Outcome outcome = run_kaustik({"compare", reference, image, "--json", "--blocks", "4"});
  const nlohmann::json json = nlohmann::json::parse(outcome.out);
  EXPECT_TRUE(json["mean_ratio"].is_null());
  EXPECT_TRUE(json["block_deviations"]["largest"]["value"].is_null());
  EXPECT_EQ(json["block_deviations"]["count"], 1);
  EXPECT_THAT(run_kaustik({"compare", reference, reference, "--blocks", "4"}).out,
              HasSubstr("4 x 4           black in both pictures"));
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
