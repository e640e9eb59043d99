// Tests the metrics against values worked out by hand.

#include "render/compare/compare.h"
#include "render/compare/fireflies.h"

#include <gtest/gtest.h>

#include <random>
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

// Each pixel's noise is independent with variance sigma^2, so the mean of a block of n pixels has the
// variance sigma^2 / n. Weighted by n, B blocks of N pixels together give the relMSE sigma^2 B / N / (R^2 +
// 0.01). For Gaussian noise it is a mean of squares of 3 B Gaussians, whose standard deviation is sqrt(2 / (3
// B)) of it. Five of them are exceeded once in 1.7 million. 251 x 133 has blocks that the border cuts.
TEST(CompareBlocks, WhiteNoiseFallsByThePixelsOfABlock) {
  const double sigma = 0.2;
  for (const auto& [width, height] : {std::pair(256, 192), std::pair(251, 133)}) {
    const Image reference(width, height, Rgb(1));
    Image image = reference;
    std::mt19937_64 random(1);
    std::normal_distribution<double> noise(0, sigma);
    for (Rgb& pixel : image.pixels)
      for (int c = 0; c < 3; ++c) pixel[c] = float(1 + noise(random));
    const CompareResult r = compare(reference, image);
    EXPECT_EQ(r.relmse_of_blocks[0], r.relmse);
    for (size_t i = 0; i < kBlockSides.size(); ++i) {
      const int k = kBlockSides[i];
      const double blocks = double((width + k - 1) / k) * double((height + k - 1) / k);
      const double expected = sigma * sigma * blocks / (double(width) * double(height)) / 1.01;
      EXPECT_NEAR(r.relmse_of_blocks[i], expected, 5 * std::sqrt(2 / (3 * blocks)) * expected) << k;
    }
  }
}

// Three bright pixels on a wall of 1 beside a window of 50: one that is new, one that the reference has, and
// one that is not bright enough. The window is no firefly, though ten times its median where only a part of
// it is seen, since the reference has it.
TEST(CompareFireflies, AreBrightPixelsThatTheReferenceLacks) {
  Image reference(32, 16, Rgb(1));
  for (int y = 0; y < 16; ++y) reference.at(31, y) = Rgb(50);
  reference.at(20, 8) = Rgb(30);
  Image image = reference;
  image.at(5, 3) = Rgb(10.5f);
  image.at(10, 10) = Rgb(9.5f);
  const Fireflies found = find_fireflies(reference, image);
  EXPECT_EQ(found.count, 1u);
  EXPECT_EQ(found.x, 5);
  EXPECT_EQ(found.y, 3);
  EXPECT_FLOAT_EQ(float(found.image), 10.5f);
  EXPECT_FLOAT_EQ(float(found.reference), 1);
}

// The reference is half 2 and half 0, so its mean is 1 and a hundredth of it the least median: in the dark
// half more than a tenth is a firefly, and what is not finite is none.
TEST(CompareFireflies, InTheDarkAreMeasuredAgainstThePicturesMean) {
  Image reference(32, 16, Rgb(0));
  for (int y = 0; y < 16; ++y)
    for (int x = 0; x < 16; ++x) reference.at(x, y) = Rgb(2);
  Image image = reference;
  image.at(24, 4) = Rgb(0.11f);
  image.at(24, 12) = Rgb(0.09f);
  image.at(28, 8) = Rgb(kInfinity);
  EXPECT_EQ(find_fireflies(reference, image).count, 1u);
  EXPECT_EQ(find_fireflies(reference, image, {.mask_bright = -1.0f}).count, 0u);  // masks all
}

// R + d and R - d in squares of `side` pixels.
Image checkerboard(int side, float d) {
  Image image(64, 32, Rgb(1));
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) image.at(x, y) += Rgb((x / side + y / side) % 2 == 0 ? d : -d);
  return image;
}

// No block holds parts of two squares of 16 pixels: all have the error d^2 / (R^2 + 0.01). Blocks of twice
// the side of the squares hold as much above as below the reference.
TEST(CompareBlocks, BlotchesWiderThanABlockDoNotFall) {
  const Image reference(64, 32, Rgb(1));
  const double expected = 0.0625 / 1.01;
  for (const double relmse : compare(reference, checkerboard(16, 0.25f)).relmse_of_blocks)
    EXPECT_NEAR(relmse, expected, 1e-12);
  const CompareResult fine = compare(reference, checkerboard(2, 0.25f));
  EXPECT_NEAR(fine.relmse_of_blocks[0], expected, 1e-12);
  EXPECT_NEAR(fine.relmse_of_blocks[1], expected, 1e-12);
  EXPECT_EQ(fine.relmse_of_blocks[2], 0);
  EXPECT_EQ(fine.relmse_of_blocks[3], 0);
}

// Of 3 x 3 pixels the blocks of 2 x 2 have 4, 2, 2 and 1 pixels, and those of 4 x 4 and 8 x 8 all nine. All
// values are exact in float; the sums round in double.
TEST(CompareBlocks, BordersCutBlocks) {
  const double a = 0.25, b = 0.5, c = 1;
  const Image reference(3, 3, Rgb(1));
  Image image = reference;
  image.at(0, 0) += Rgb(float(4 * a));  // the mean of four pixels is off by a
  image.at(2, 0) += Rgb(float(2 * b));
  image.at(2, 2) += Rgb(float(c));
  const CompareResult r = compare(reference, image);
  EXPECT_NEAR(r.relmse_of_blocks[1], (4 * a * a + 2 * b * b + c * c) / 9 / 1.01, 1e-12);
  const double all = (4 * a + 2 * b + c) / 9;
  EXPECT_NEAR(r.relmse_of_blocks[2], all * all / 1.01, 1e-12);
  EXPECT_NEAR(r.relmse_of_blocks[3], all * all / 1.01, 1e-12);
}

// The means hold compared pixels only: the blocks at (2, 2) and (6, 6) lose a pixel each, one to the mask of
// the corner's 3 x 3 pixels and one to NaN. 54 pixels are left. The block at (0, 0) is masked altogether.
TEST(CompareBlocks, MeansLeaveOutMaskedPixelsAndNan) {
  Image reference(8, 8, Rgb(1));
  reference.at(0, 0) = Rgb(5);
  Image image(8, 8, Rgb(1));
  image.at(2, 2) = image.at(1, 1) = Rgb(100);
  image.at(3, 3) += Rgb(0.75f);
  image.at(7, 7).y = std::nanf("");
  image.at(6, 6) += Rgb(1.5f);
  const CompareResult r = compare(reference, image, {4.0f});
  ASSERT_EQ(r.compared, 54u);
  EXPECT_NEAR(r.relmse_of_blocks[1], 3 * (0.25 * 0.25 + 0.5 * 0.5) / 54 / 1.01, 1e-12);
  const double all = (0.75 + 1.5) / 54;
  EXPECT_NEAR(r.relmse_of_blocks[3], all * all / 1.01, 1e-12);
}

// Blocks of 2 x 2 pixels over 5 x 4, so the last column's have two pixels. Their means are exact in float:
// deviations of 1/4, 0, 1, 1/2 and infinity; one block is black in both pictures.
TEST(CompareBlocks, DeviationsMatchValuesByHand) {
  Image reference(5, 4, Rgb(1));
  Image image = reference;
  image.at(0, 0) += Rgb(1);        // the mean of four pixels is off by 1/4
  image.at(4, 0) -= Rgb(3, 3, 0);  // that of two pixels and three channels by -1
  for (const auto& [x, y] : {std::pair(0, 2), {1, 2}, {0, 3}, {1, 3}}) {
    reference.at(x, y) = Rgb(0.5f);
    image.at(x, y) = Rgb(0.25f);
  }
  BlockDeviations found = compare_blocks(reference, image, 2);
  EXPECT_EQ(found.blocks, 6u);
  EXPECT_NEAR(found.mean, (0.25 + 0 + 1 + 0.5 + 0 + 0) / 6, 1e-15);
  EXPECT_EQ(found.median, 0);  // the third of 0, 0, 0, 1/4, 1/2, 1
  EXPECT_EQ(found.quantile95, 1);
  EXPECT_EQ(found.largest, 1);
  EXPECT_EQ(found.x, 4);
  EXPECT_EQ(found.y, 0);
  EXPECT_EQ(found.image, 0);
  EXPECT_EQ(found.reference, 1);

  for (const int y : {2, 3}) reference.at(4, y) = Rgb(0);
  for (const int x : {2, 3})
    for (const int y : {0, 1}) reference.at(x, y) = image.at(x, y) = Rgb(0);
  found = compare_blocks(reference, image, 2);
  EXPECT_EQ(found.blocks, 5u);  // not the one that is black in both
  EXPECT_TRUE(std::isinf(found.largest));
  EXPECT_EQ(found.y, 2);
  EXPECT_EQ(found.median, 0.5);  // the third of 0, 1/4, 1/2, 1, infinity
  EXPECT_EQ(compare_blocks(Image(2, 2), Image(2, 2), 2).blocks, 0u);
}

// The 95 % quantile of 40 deviations is the 38th: two of them are larger. Each block is one pixel.
TEST(CompareBlocks, QuantileLeavesOutTheRarest) {
  const Image reference(40, 1, Rgb(1));
  Image image = reference;
  for (int x = 0; x < 40; ++x) image.at(39 - x, 0) = Rgb(1 + float(x + 1) / 64);
  const BlockDeviations found = compare_blocks(reference, image, 1);
  EXPECT_EQ(found.quantile95, 38.0 / 64);
  EXPECT_EQ(found.median, 20.0 / 64);
  EXPECT_EQ(found.x, 0);
}

// The mask of a layer is that of the whole picture.
TEST(Compare, MaskMayComeFromAnotherPicture) {
  const Image layer(8, 8, Rgb(1));
  Image whole = layer, image = layer;
  whole.at(0, 0) = Rgb(5);
  image.at(2, 2) = Rgb(9);
  const CompareResult r = compare(layer, image, {.mask_bright = 4.0f, .mask_from = &whole});
  EXPECT_EQ(r.masked, 9u);
  EXPECT_EQ(r.relmse, 0);
  EXPECT_EQ(compare_blocks(layer, image, 4, {.mask_bright = 4.0f, .mask_from = &whole}).largest, 0);
  EXPECT_GT(compare(layer, image, {4.0f}).relmse, 0);
  const Image other(8, 7);
  EXPECT_THROW(compare(layer, image, {.mask_bright = 4.0f, .mask_from = &other}), std::invalid_argument);
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
