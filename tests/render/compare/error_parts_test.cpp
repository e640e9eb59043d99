// Tests bias and variance against closed forms on synthetic images.

#include "render/compare/error_parts.h"

#include <gtest/gtest.h>

#include <limits>
#include <random>
#include <stdexcept>

#include "render/picture/shrink.h"

namespace kaustik::render {
namespace {

ErrorParts parts_of(const Image& reference, const std::vector<Image>& images,
                    const CompareOptions& options = {}) {
  ErrorPartsSum sum(reference, options);
  for (const Image& image : images) sum.add(image);
  return sum.parts();
}

// For two images at R + b - d and R + b + d, s^2 = 2 d^2 and (m - R)^2 - s^2 / 2 = b^2 - d^2. All numbers are
// exact in float and double; the sums round a few times in double.
TEST(ErrorParts, TwoImagesMatchValuesByHand) {
  const Image reference(4, 3, Rgb(0.5f));
  const double b = 0.25, d = 0.125, scale = 0.25 + 0.01;
  const ErrorParts parts =
      parts_of(reference, {Image(4, 3, Rgb(float(0.5 + b - d))), Image(4, 3, Rgb(float(0.5 + b + d)))});
  EXPECT_EQ(parts.images, 2u);
  EXPECT_EQ(parts.compared, 12u);
  EXPECT_NEAR(parts.variance.value(), 2 * d * d / scale, 1e-14);
  EXPECT_NEAR(parts.bias2.value(), (b * b - d * d) / scale, 1e-14);
  EXPECT_NEAR(parts.relmse, (b * b + d * d) / scale, 1e-14);
}

Image noisy(const Image& mean, double bias, double sigma, unsigned seed) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> noise(bias, sigma);
  Image image = mean;
  for (Rgb& pixel : image.pixels)
    for (int c = 0; c < 3; ++c) pixel[c] = float(pixel[c] + noise(random));
  return image;
}

// The n images have the bias b and Gaussian noise of sigma in C channels. The mean of s^2 over channels has
// the standard deviation sigma^2 sqrt(2 / (n - 1) / C); that of (m - R)^2 - s^2 / n, whose two terms are
// independent, is sqrt((2 sigma^4 / n^2 + 4 b^2 sigma^2 / n + 2 sigma^4 / (n^2 (n - 1))) / C). Five of them
// are exceeded once in 1.7 million; the seeds are fixed.
TEST(ErrorParts, EstimatesAreUnbiased) {
  const Image reference(64, 64, Rgb(1));
  const double sigma = 0.2, C = 3 * 64 * 64, n = 5, scale = 1.01;
  for (const double b : {0.0, 0.03, 0.3}) {
    std::vector<Image> images;
    for (unsigned seed = 1; seed <= 5; ++seed) images.push_back(noisy(reference, b, sigma, seed));
    const ErrorParts parts = parts_of(reference, images);
    const double s2 = sigma * sigma;
    EXPECT_NEAR(parts.variance.value(), s2 / scale, 5 * s2 * std::sqrt(2 / (n - 1) / C) / scale) << b;
    const double spread =
        std::sqrt((2 * s2 * s2 / (n * n) + 4 * b * b * s2 / n + 2 * s2 * s2 / (n * n * (n - 1))) / C);
    EXPECT_NEAR(parts.bias2.value(), b * b / scale, 5 * spread / scale) << b;
  }
}

// For any images relmse is the mean of compare's, and the parts add up to it. The sums of 768 doubles round
// by 1e-12.
TEST(ErrorParts, AddUpToTheMeanOfRelMse) {
  const Image reference = noisy(Image(16, 16, Rgb(0.3f)), 0, 0.1, 1);
  std::vector<Image> images;
  double mean = 0;
  for (unsigned seed = 2; seed < 6; ++seed) {
    images.push_back(noisy(reference, 0.02, 0.3, seed));
    mean += compare(reference, images.back()).relmse / 4;
  }
  const ErrorParts parts = parts_of(reference, images);
  EXPECT_NEAR(parts.relmse, mean, 1e-12 * mean);
  EXPECT_NEAR(parts.bias2.value() + parts.variance.value(), mean, 1e-12 * mean);
}

TEST(ErrorParts, OneImageHasNoVariance) {
  const Image reference(2, 2, Rgb(1));
  const ErrorParts parts = parts_of(reference, {Image(2, 2, Rgb(1.5f))});
  EXPECT_NEAR(parts.relmse, 0.25 / 1.01, 1e-15);
  EXPECT_EQ(parts.variance, std::nullopt);
  EXPECT_EQ(parts.bias2, std::nullopt);
}

// A pixel that is not finite in one image counts in none; nor does a masked pixel.
TEST(ErrorParts, ExcludesThePixelsThatCompareExcludes) {
  Image reference(8, 8, Rgb(1));
  reference.at(7, 7) = Rgb(100);  // masks 3 x 3 pixels
  std::vector<Image> images(3, reference);
  images[1].at(0, 0).y = std::numeric_limits<float>::quiet_NaN();
  images[2].at(0, 0) = Rgb(5);
  images[2].at(6, 6) = Rgb(5);
  const ErrorParts parts = parts_of(reference, images, {.mask_bright = 4.0f});
  EXPECT_EQ(parts.masked, 9u);
  EXPECT_EQ(parts.not_finite, 1u);
  EXPECT_EQ(parts.compared, 64u - 10u);
  EXPECT_EQ(parts.relmse, 0);
  EXPECT_EQ(parts.variance, 0);
}

TEST(ErrorParts, RefusesAnotherSize) {
  const Image reference(4, 4);
  ErrorPartsSum sum(reference, {});
  EXPECT_THROW(sum.add(Image(4, 5)), std::invalid_argument);
}

// Three passes have the radiance 1, 2 and 3 in every channel: mean 2, variance of the mean 1 / 3.
TEST(RelativeNoise, EqualsTheVarianceOfTheMeanOverPasses) {
  FilmSums film(2, 2);
  FilmTotals totals(window_of<PixelTotals>(film), {-40, -40, -40});
  for (const double radiance : {1.0, 2.0, 3.0}) {
    for (int y = 0; y < 2; ++y)
      for (int x = 0; x < 2; ++x) film.at(x, y) = {.direct = glm::dvec3(radiance), .count = 1};
    totals.add(film);
    if (radiance == 1) {
      EXPECT_EQ(relative_noise(totals), std::nullopt);  // one pass has no variance
    }
  }
  // The units of 2^-40 are exact here; double rounds the rest.
  EXPECT_NEAR(relative_noise(totals).value(), 1.0 / 3 / (4 + 0.01), 1e-12);
}

TEST(Shrunk, PixelsAreMeansOverTheirArea) {
  Image image(6, 3);
  for (int y = 0; y < 3; ++y)
    for (int x = 0; x < 6; ++x) image.at(x, y) = Rgb(float(x), float(y), 1);
  const Image half = shrunk(image, 2);  // each pixel is the mean of 3 x 3
  ASSERT_EQ(half.width, 2);
  ASSERT_EQ(half.height, 1);
  EXPECT_EQ(half.at(0, 0), Rgb(1, 1, 1));
  EXPECT_EQ(half.at(1, 0), Rgb(4, 1, 1));
  // Each pixel covers 1.5 pixels: the first is (0 + 1 / 2) / 1.5 = 1 / 3. Float rounds once.
  EXPECT_NEAR(shrunk(image, 4).at(0, 0).x, 1.0 / 3, 1e-7);
  EXPECT_EQ(shrunk(image, 6).pixels, image.pixels);
}

}  // namespace
}  // namespace kaustik::render
