// Automatic exposure: what it shows as middle grey, and which pixels have no say.

#include "render/picture/exposure.h"

#include <gtest/gtest.h>

#include <cmath>

#include "render/picture/image_io.h"
#include "tests/render/support/image_statistics.h"

namespace kaustik::render {
namespace {

using test::output_file;

constexpr Tonemap kAll[] = {Tonemap::kSrgb, Tonemap::kReinhard, Tonemap::kFilmic};
// Half of the hundredth of a stop to which exposures are rounded, and the floats' own.
constexpr double kRounding = 0.005 + 1e-5;

// What a display shows of grey radiance.
double shown(double radiance, float exposure, Tonemap tonemap) {
  return render::tonemap(Rgb(float(radiance)), {exposure, tonemap}).x;
}

TEST(AutomaticExposure, ShowsAUniformPictureAsMiddleGrey) {
  for (const Tonemap tonemap : kAll)
    for (const float radiance : {1e-9f, 0.01f, 0.18f, 3.0f, 1e7f}) {
      const float exposure = automatic_exposure(Image(8, 4, Rgb(radiance)), {}, tonemap);
      // On logarithmic axes, no operator is steeper than 1.4 at middle grey (filmic: 1.31).
      EXPECT_NEAR(std::log2(shown(radiance, exposure, tonemap) / 0.18), 0, 1.4 * kRounding) << radiance;
      EXPECT_NEAR(exposure * 100, std::round(exposure * 100), 1e-3) << "rounded to hundredths of a stop";
    }
}

// As many blocks of radiance 0.25 as of 4: their log-average is 1, so the exposure is that of 0.18 / 1.
TEST(AutomaticExposure, MetersTheMeanOfLogarithms) {
  Image picture(100, 8, Rgb(0.25f));
  for (int y = 4; y < 8; ++y)
    for (int x = 0; x < 100; ++x) picture.at(x, y) = Rgb(4);
  EXPECT_NEAR(automatic_exposure(picture, {}, Tonemap::kSrgb), std::log2(0.18), kRounding);
}

// Noise within a block leaves its mean, of which the logarithm is taken: here 1, by one pixel of each block.
TEST(AutomaticExposure, NoiseDoesNotBrightenThePicture) {
  Image picture(30, 22);
  for (int y = 0; y < 22; ++y)
    for (int x = 0; x < 30; ++x)
      if (y % 4 == 1 && x % 4 == 0)
        picture.at(x, y) = Rgb(float(std::min(4, 22 - y + 1) * std::min(4, 30 - x)));
  EXPECT_NEAR(automatic_exposure(picture, {}, Tonemap::kSrgb), std::log2(0.18), kRounding);
}

TEST(AutomaticExposure, FollowsTheRadiance) {
  Image picture(50, 40);
  for (int y = 0; y < 40; ++y)
    for (int x = 0; x < 50; ++x) picture.at(x, y) = Rgb(0.02f + 0.01f * float(x), 0.5f, 0.1f * float(y + 1));
  Image brighter = picture;
  for (Rgb& pixel : brighter.pixels) pixel *= 1024;
  for (const Tonemap tonemap : kAll)
    EXPECT_NEAR(automatic_exposure(picture, {}, tonemap) - automatic_exposure(brighter, {}, tonemap), 10,
                2 * kRounding);
}

// Of the 510 blocks that are not black, two are highlights; the brightest percent are five.
TEST(AutomaticExposure, IgnoresBackgroundsAndHighlights) {
  Image picture(120, 100, Rgb(1));
  const float plain = automatic_exposure(picture, {}, Tonemap::kFilmic);
  for (int y = 8; y < 68; ++y)  // a black background, light leaks of 1e-6 among it
    for (int x = 0; x < 120; ++x) picture.at(x, y) = Rgb(y < 40 ? 0 : 1e-6f);
  for (int y = 92; y < 100; ++y)
    for (int x = 0; x < 4; ++x) picture.at(x, y) = Rgb(1e6f);
  picture.at(50, 0) = Rgb(std::nanf(""));
  picture.at(51, 0) = Rgb(INFINITY);
  EXPECT_EQ(automatic_exposure(picture, {}, Tonemap::kFilmic), plain);
}

// The brightest percent of 400 blocks are four.
TEST(AutomaticExposure, IgnoresNoMoreThanTheBrightestPercent) {
  Image picture(80, 80, Rgb(1));
  const float plain = automatic_exposure(picture, {}, Tonemap::kSrgb);
  for (int block = 0; block < 4; ++block) picture.at(4 * block, 0) = Rgb(64);
  EXPECT_EQ(automatic_exposure(picture, {}, Tonemap::kSrgb), plain);
  picture.at(16, 0) = Rgb(64);
  EXPECT_LT(automatic_exposure(picture, {}, Tonemap::kSrgb), plain);
}

TEST(AutomaticExposure, ExtremesStayInTheRangeOfTheOption) {
  EXPECT_EQ(automatic_exposure(Image(3, 2), {}, Tonemap::kFilmic), 0);
  EXPECT_EQ(automatic_exposure(Image(), {}, Tonemap::kFilmic), 0);
  EXPECT_EQ(automatic_exposure(Image(3, 2, Rgb(-1)), {}, Tonemap::kFilmic), 0);
  EXPECT_EQ(automatic_exposure(Image(3, 2, Rgb(1e-38f)), {}, Tonemap::kSrgb), 64);
  EXPECT_EQ(automatic_exposure(Image(3, 2, Rgb(1e38f)), {}, Tonemap::kSrgb), -64);
}

// A film of reflected radiance 1, the first of its five rows of blocks a light of radiance 1000.
class AutomaticExposureOfFilm : public ::testing::Test {
 protected:
  AutomaticExposureOfFilm() : film_(20, 20) {
    for (int y = 0; y < 20; ++y)
      for (int x = 0; x < 20; ++x) film_.at(x, y).direct = Rgb(1);
    for (int y = 0; y < 4; ++y)
      for (int x = 0; x < 20; ++x) film_.at(x, y).emitted = Rgb(1000);
  }
  float exposure() const { return automatic_exposure(image_of(film_), lights_seen(film_), Tonemap::kSrgb); }
  float exposure_of_all() const { return automatic_exposure(image_of(film_), {}, Tonemap::kSrgb); }
  Film film_;
};

TEST_F(AutomaticExposureOfFilm, LeavesOutLightsThatAreSeen) {
  EXPECT_NEAR(exposure(), std::log2(0.18), kRounding);
  EXPECT_LT(exposure_of_all(), std::log2(0.18) - 0.5);
}

// A light that covers a part of a block does not brighten the rest of it.
TEST_F(AutomaticExposureOfFilm, LeavesOutLightsByPixels) {
  for (int x = 0; x < 20; ++x) film_.at(x, 7).emitted = Rgb(1000);
  EXPECT_NEAR(exposure(), std::log2(0.18), kRounding);
}

// What glass and mirrors show of a light belongs to them.
TEST_F(AutomaticExposureOfFilm, MetersLightsInMirrors) {
  for (int y = 0; y < 4; ++y)
    for (int x = 0; x < 20; ++x) film_.at(x, y).denoising_emitted = film_.at(x, y).emitted;
  EXPECT_EQ(exposure(), exposure_of_all());
}

TEST_F(AutomaticExposureOfFilm, MetersAllOfAPictureThatShowsNothingButLights) {
  for (int y = 0; y < 20; ++y)
    for (int x = 0; x < 20; ++x) film_.at(x, y) = {}, film_.at(x, y).emitted = Rgb(2);
  EXPECT_NEAR(exposure(), std::log2(0.09), kRounding);
}

// A file with the layers is metered as its film is; one without them is metered as a whole.
TEST_F(AutomaticExposureOfFilm, ReadsLightsFromTheLayersOfAFile) {
  const std::string path = output_file("lights.exr");
  write_film(path, film_, {{Layer::kEmitted, Layer::kDenoisingEmitted}, {}, {}});
  EXPECT_EQ(automatic_exposure(image_of(film_), lights_seen(read_exr_file(path, 400)), Tonemap::kSrgb),
            exposure());
  write_film(path, film_, {{Layer::kEmitted}, {}, {}});
  EXPECT_TRUE(lights_seen(read_exr_file(path, 400)).pixels.empty());
}

}  // namespace
}  // namespace kaustik::render
