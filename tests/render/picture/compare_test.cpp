// Tests the metrics against values worked out by hand.

#include "render/picture/compare.h"

#include <gtest/gtest.h>

#include <stdexcept>

namespace kaustik::render {
namespace {

// Two pixels: the reference is (1,1,1) and (0,2,0), the image (1,1,1.5) and (0.1,2,0).
TEST(Compare, MatchesValuesByHand) {
  Image reference(2, 1), image(2, 1);
  reference.at(0, 0) = {1, 1, 1}, reference.at(1, 0) = {0, 2, 0};
  image.at(0, 0) = {1, 1, 1.5f}, image.at(1, 0) = {0.1f, 2, 0};
  const CompareResult r = compare(reference, image);
  EXPECT_EQ(r.compared, 2u);
  EXPECT_NEAR(r.rmse, std::sqrt((0.25 + 0.01) / 6), 1e-7);
  EXPECT_NEAR(r.relmse, (0.25 / 1.01 + 0.01 / 0.01) / 6, 1e-7);
  EXPECT_NEAR(r.psnr, 20 * std::log10(2 / std::sqrt(0.26 / 6)), 1e-5);
  EXPECT_NEAR(r.max_difference, 0.5, 1e-7);
  EXPECT_EQ(r.max_x, 0);
  EXPECT_EQ(r.max_channel, 2);
  EXPECT_NEAR(r.mean_reference, 5.0 / 6, 1e-7);
  EXPECT_NEAR(r.mean_image, 5.6 / 6, 1e-7);
}

TEST(Compare, EqualImagesHaveNoError) {
  const Image image(3, 3, Rgb(0.5f));
  const CompareResult r = compare(image, image);
  EXPECT_EQ(r.rmse, 0);
  EXPECT_EQ(r.relmse, 0);
  EXPECT_TRUE(std::isinf(r.psnr));
  EXPECT_EQ(r.max_difference, 0);
  const Image black(2, 2);  // its peak is zero, too
  EXPECT_EQ(compare(black, black).psnr, kInfinity);
}

// A bright pixel masks the 5 x 5 square about it, cut at the border: in a corner it masks 3 x 3 pixels.
TEST(Compare, MaskLeavesOutTwoPixelsAroundBrightOnes) {
  Image reference(8, 8, Rgb(1)), image(8, 8, Rgb(1));
  reference.at(3, 3) = {0, 5, 0};
  image.at(3, 3) = Rgb(0);
  image.at(1, 5) = Rgb(9);  // inside the square
  CompareResult r = compare(reference, image, {4.0f});
  EXPECT_EQ(r.masked, 25u);
  EXPECT_EQ(r.compared, 39u);
  EXPECT_EQ(r.relmse, 0);
  image.at(6, 3) = Rgb(2);  // just outside
  r = compare(reference, image, {4.0f});
  EXPECT_NEAR(r.relmse, 1 / 1.01 / 39, 1e-12);
  EXPECT_EQ(r.max_x, 6);

  Image corner(8, 8, Rgb(1));
  corner.at(0, 0) = Rgb(5);
  EXPECT_EQ(compare(corner, corner, {4.0f}).masked, 9u);
  EXPECT_EQ(compare(corner, corner, {5.0f}).masked, 0u);  // pixels at the limit are not masked
}

TEST(Compare, NanPixelsAreCountedAndLeftOut) {
  Image reference(2, 2, Rgb(1)), image(2, 2, Rgb(1));
  image.at(0, 0).y = std::nanf("");
  reference.at(1, 1).x = kInfinity;
  image.at(0, 1) = Rgb(2);
  const CompareResult r = compare(reference, image);
  EXPECT_EQ(r.nan_image, 1u);
  EXPECT_EQ(r.nan_reference, 1u);
  EXPECT_EQ(r.compared, 2u);
  EXPECT_NEAR(r.rmse, std::sqrt(0.5), 1e-12);
}

TEST(Compare, SizesMustAgree) {
  EXPECT_THROW(compare(Image(2, 2), Image(2, 3)), std::invalid_argument);
  EXPECT_THROW(compare(Image(), Image()), std::invalid_argument);
}

TEST(Heatmap, IsBlackWhereEqualWhiteWhereFarMagentaForNan) {
  Image reference(3, 1, Rgb(1)), image(3, 1, Rgb(1));
  image.at(1, 0) = Rgb(100);
  image.at(2, 0) = Rgb(std::nanf(""));
  const Image heat = heatmap(reference, image);
  EXPECT_EQ(heat.at(0, 0), Rgb(0));
  EXPECT_EQ(heat.at(1, 0), Rgb(1));
  EXPECT_EQ(heat.at(2, 0), Rgb(1, 0, 1));
}

}  // namespace
}  // namespace kaustik::render
