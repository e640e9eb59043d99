// Tests which layers of other renderers' files are found, and the noise that is estimated from a picture.

#include "render/denoise/noisy_picture.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/random.h"

namespace kaustik::render {
namespace {

constexpr int kSide = 64;

ExrChannels file_of(const std::vector<std::string>& names) {
  ExrChannels file{0, 0, kSide, kSide, kSide, kSide, names, {}};
  for (size_t c = 0; c < names.size(); ++c) file.values.emplace_back(size_t(kSide * kSide), float(c + 1));
  return file;
}

float feature(const NoisyPicture& picture, Layer layer, size_t channel) {
  return picture.halves.at(3, 4).mean[1][half_of(layer) + channel];
}

TEST(NoisyPicture, FindsTheLayersOfBlender) {
  const NoisyPicture picture = noisy_picture(
      file_of({"View.Combined.R", "View.Combined.G", "View.Combined.B", "View.Noisy Image.R",
               "View.Noisy Image.G", "View.Noisy Image.B", "View.Denoising Albedo.R",
               "View.Denoising Albedo.G", "View.Denoising Albedo.B", "View.Denoising Normal.X",
               "View.Denoising Normal.Y", "View.Denoising Normal.Z", "View.Denoising Depth.Z"}));
  EXPECT_FALSE(picture.measured);
  EXPECT_TRUE(picture.missing.empty());
  EXPECT_EQ(picture.film.at(3, 4).radiance(), Rgb(4, 5, 6));
  EXPECT_EQ(feature(picture, Layer::kDenoisingAlbedo, 0), 7);
  EXPECT_EQ(feature(picture, Layer::kDenoisingNormal, 2), 12);
  EXPECT_EQ(feature(picture, Layer::kDenoisingDepth, 0), 13);
}

TEST(NoisyPicture, FindsTheLayersOfPbrtAndMitsuba) {
  const NoisyPicture pbrt =
      noisy_picture(file_of({"R", "G", "B", "Albedo.R", "Albedo.G", "Albedo.B", "P.X", "P.Y", "P.Z", "N.X",
                             "N.Y", "N.Z", "Ns.X", "Ns.Y", "Ns.Z"}));
  EXPECT_TRUE(pbrt.missing.empty());
  EXPECT_EQ(feature(pbrt, Layer::kDenoisingNormal, 0), 13);  // Ns rather than N
  EXPECT_EQ(feature(pbrt, Layer::kDenoisingDepth, 0), 9);
  const NoisyPicture mitsuba = noisy_picture(
      file_of({"R", "G", "B", "A", "albedo.R", "albedo.G", "albedo.B", "nn.X", "nn.Y", "nn.Z"}));
  EXPECT_EQ(mitsuba.missing, std::vector<std::string>{"depth"});
  EXPECT_EQ(feature(mitsuba, Layer::kDenoisingAlbedo, 2), 7);
}

TEST(NoisyPicture, RefusesFilesWithoutColours) {
  EXPECT_THROW(noisy_picture(file_of({"R", "B", "depth.Z"})), std::runtime_error);
}

// White noise of known deviation about an affine function. Half the difference of the halves is its estimated
// deviation; medians over 49 values that overlap have a relative standard error of some 30 %, their mean over
// 4,096 pixels, of which some 84 are independent, of 3 %.
TEST(NoisyPicture, EstimatesTheDeviationOfWhiteNoise) {
  test::Random random(5);
  ExrChannels file = file_of({"R", "G", "B"});
  const float deviation = 0.25f;
  for (auto& values : file.values)
    for (size_t i = 0; i < values.size(); ++i) {
      float sum = 0;  // of twelve uniform numbers: nearly normal, of deviation 1
      for (int k = 0; k < 12; ++k) sum += random.uniform();
      values[i] = 10 + 0.05f * float(i % kSide) + deviation * (sum - 6);
    }
  const NoisyPicture picture = noisy_picture(file);
  double sum = 0;
  for (int y = 0; y < kSide; ++y)
    for (int x = 0; x < kSide; ++x) {
      const auto& mean = picture.halves.at(x, y).mean;
      sum += std::abs(double(mean[0][half_of(Layer::kDenoisingEmitted)] -
                             mean[1][half_of(Layer::kDenoisingEmitted)])) /
             2;
    }
  EXPECT_NEAR(sum / (kSide * kSide), deviation, 4 * 0.03 * deviation);
}

TEST(NoisyPicture, LeavesOutPixelsThatAreNotFinite) {
  ExrChannels file = file_of({"R", "G", "B"});
  file.values[1][4 * kSide + 3] = std::nanf("");
  const NoisyPicture picture = noisy_picture(file);
  EXPECT_EQ(picture.halves.at(3, 4).share[0], 0);
  EXPECT_EQ(picture.halves.at(3, 20).share[0], 0.5f);
}

}  // namespace
}  // namespace kaustik::render
