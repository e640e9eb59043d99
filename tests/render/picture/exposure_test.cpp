// Automatic exposure: what it shows as middle grey, and which pixels have no say.

#include "render/picture/exposure.h"

#include <gtest/gtest.h>

#include <cmath>

namespace kaustik::render {
namespace {

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
      const float exposure = automatic_exposure(Image(8, 4, Rgb(radiance)), tonemap);
      // On logarithmic axes, no operator is steeper than 1.4 at middle grey (filmic: 1.31).
      EXPECT_NEAR(std::log2(shown(radiance, exposure, tonemap) / 0.18), 0, 1.4 * kRounding) << radiance;
      EXPECT_NEAR(exposure * 100, std::round(exposure * 100), 1e-3) << "rounded to hundredths of a stop";
    }
}

// As many pixels of radiance 0.25 as of 4: their log-average is 1, so the exposure is that of 0.18 / 1.
TEST(AutomaticExposure, MetersTheMeanOfLogarithms) {
  Image picture(100, 2, Rgb(0.25f));
  for (int x = 0; x < 100; ++x) picture.at(x, 1) = Rgb(4);
  EXPECT_NEAR(automatic_exposure(picture, Tonemap::kSrgb), std::log2(0.18), kRounding);
}

TEST(AutomaticExposure, FollowsTheRadiance) {
  Image picture(50, 40);
  for (int y = 0; y < 40; ++y)
    for (int x = 0; x < 50; ++x) picture.at(x, y) = Rgb(0.02f + 0.01f * float(x), 0.5f, 0.1f * float(y + 1));
  Image brighter = picture;
  for (Rgb& pixel : brighter.pixels) pixel *= 1024;
  for (const Tonemap tonemap : kAll)
    EXPECT_NEAR(automatic_exposure(picture, tonemap) - automatic_exposure(brighter, tonemap), 10,
                2 * kRounding);
}

TEST(AutomaticExposure, IgnoresBackgroundsAndHighlights) {
  Image picture(100, 100, Rgb(1));
  const float plain = automatic_exposure(picture, Tonemap::kFilmic);
  for (int y = 10; y < 70; ++y)  // a black background, light leaks of 1e-6 among it
    for (int x = 0; x < 100; ++x) picture.at(x, y) = Rgb(y < 40 ? 0 : 1e-6f);
  for (int x = 0; x < 40; ++x) picture.at(x, 99) = Rgb(1e6f);  // highlights: fewer than 1 % of the pixels
  picture.at(50, 0) = Rgb(std::nanf(""));
  picture.at(51, 0) = Rgb(INFINITY);
  picture.at(52, 0) = Rgb(-1);
  EXPECT_EQ(automatic_exposure(picture, Tonemap::kFilmic), plain);
}

TEST(AutomaticExposure, ExtremesStayInTheRangeOfTheOption) {
  EXPECT_EQ(automatic_exposure(Image(3, 2), Tonemap::kFilmic), 0);
  EXPECT_EQ(automatic_exposure(Image(), Tonemap::kFilmic), 0);
  EXPECT_EQ(automatic_exposure(Image(3, 2, Rgb(-1)), Tonemap::kFilmic), 0);
  EXPECT_EQ(automatic_exposure(Image(3, 2, Rgb(1e-38f)), Tonemap::kSrgb), 64);
  EXPECT_EQ(automatic_exposure(Image(3, 2, Rgb(1e38f)), Tonemap::kSrgb), -64);
}

// A film of reflected radiance 1, a tenth of it a light of radiance 1000.
class AutomaticExposureOfFilm : public ::testing::Test {
 protected:
  AutomaticExposureOfFilm() : film_(10, 10) {
    for (int y = 0; y < 10; ++y)
      for (int x = 0; x < 10; ++x) film_.at(x, y).direct = Rgb(1);
    for (int x = 0; x < 10; ++x) film_.at(x, 0).emitted = Rgb(1000);
  }
  Image picture() const {
    Image image(10, 10);
    for (int y = 0; y < 10; ++y)
      for (int x = 0; x < 10; ++x) image.at(x, y) = film_.at(x, y).radiance();
    return image;
  }
  Film film_;
};

TEST_F(AutomaticExposureOfFilm, LeavesOutLightsThatAreSeen) {
  EXPECT_NEAR(automatic_exposure(picture(), film_, Tonemap::kSrgb), std::log2(0.18), kRounding);
  EXPECT_LT(automatic_exposure(picture(), Tonemap::kSrgb), std::log2(0.18) - 0.5);
}

// What glass and mirrors show of a light belongs to them.
TEST_F(AutomaticExposureOfFilm, MetersLightsInMirrors) {
  for (int x = 0; x < 10; ++x) film_.at(x, 0).denoising_emitted = film_.at(x, 0).emitted;
  EXPECT_EQ(automatic_exposure(picture(), film_, Tonemap::kSrgb),
            automatic_exposure(picture(), Tonemap::kSrgb));
}

TEST_F(AutomaticExposureOfFilm, MetersAllOfAPictureThatShowsNothingButLights) {
  for (int y = 0; y < 10; ++y)
    for (int x = 0; x < 10; ++x) film_.at(x, y) = {}, film_.at(x, y).emitted = Rgb(2);
  EXPECT_NEAR(automatic_exposure(picture(), film_, Tonemap::kSrgb), std::log2(0.09), kRounding);
}

}  // namespace
}  // namespace kaustik::render
