// Tests the denoiser on pictures whose light is known.

#include "render/denoise/denoise.h"

#include <gtest/gtest.h>
#include <tbb/task_arena.h>

#include <cmath>
#include <cstring>
#include <functional>
#include <numbers>
#include <vector>

#include "render/denoise/regression.h"
#include "tests/support/random.h"

namespace kaustik::render {
namespace {

constexpr int kWidth = 61, kHeight = 47;  // no multiples of a tile's sides

// A picture of direct light on white surfaces: two halves of the same light with noise of their own.
struct Noisy {
  Film film{kWidth, kHeight};
  HalfFilm halves{kWidth, kHeight};
};

// A normally distributed number.
float normal(test::Random& random) {
  const float u = 1 - random.uniform(), v = random.uniform();
  return std::sqrt(-2 * std::log(u)) * std::cos(2 * std::numbers::pi_v<float> * v);
}

// light(x, y): the radiance. deviation: of the noise of the mean of both halves.
Noisy noisy(const std::function<float(int, int)>& light, float deviation, uint64_t seed = 1) {
  test::Random random(seed);
  Noisy out;
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x) {
      HalfMeans& pixel = out.halves.at(x, y);
      pixel.share = {0.5f, 0.5f};
      for (size_t h = 0; h < 2; ++h)
        for (size_t c = 0; c < 3; ++c) {
          pixel.mean[h][half_of(Layer::kDirect) + c] =
              light(x, y) + deviation * std::numbers::sqrt2_v<float> * normal(random);
          pixel.mean[h][half_of(Layer::kDenoisingAlbedo) + c] = 1;
        }
      for (size_t h = 0; h < 2; ++h) {
        pixel.mean[h][half_of(Layer::kDenoisingNormal) + 2] = 1;
        pixel.mean[h][half_of(Layer::kDenoisingDepth)] = 1;
      }
      for (int c = 0; c < 3; ++c)
        out.film.at(x, y).direct[c] = 0.5f * (pixel.mean[0][half_of(Layer::kDirect) + size_t(c)] +
                                              pixel.mean[1][half_of(Layer::kDirect) + size_t(c)]);
    }
  return out;
}

// Mean squared error of pixels with include(x, y).
double error_of(
    const Image& image, const std::function<float(int, int)>& light,
    const std::function<bool(int, int)>& include = [](int, int) { return true; }) {
  double sum = 0;
  int count = 0;
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x) {
      if (!include(x, y)) continue;
      for (int c = 0; c < 3; ++c, ++count) {
        const double difference = double(image.at(x, y)[c]) - double(light(x, y));
        sum += difference * difference;
      }
    }
  return sum / count;
}

Image raw(const Noisy& picture) {
  Image image(kWidth, kHeight);
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x) image.at(x, y) = picture.film.at(x, y).radiance();
  return image;
}

bool same(const Image& a, const Image& b) {
  return std::memcmp(a.pixels.data(), b.pixels.data(), a.pixels.size() * sizeof(Rgb)) == 0;
}

// A plane of random numbers from -1 to 1.
Plane random_plane(test::Random* random) {
  Plane plane(kWidth, kHeight);
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x) plane.at(x, y) = random->uniform(-1, 1);
  return plane;
}

// Expects that an affine function of position and of these features is fitted exactly, whatever the weights:
// the ridge of 1e-3 pulls coefficients towards 0 by about that share. The other features do not vary.
void expect_affine_fit(const std::vector<size_t>& varying) {
  test::Random random(3);
  std::array<Plane, kFeatures> features;
  for (size_t f = 0; f < kFeatures; ++f)
    features[f] = plane_of(kWidth, kHeight, [&](int, int) { return 0.125f * float(f); });
  for (const size_t f : varying) features[f] = random_plane(&random);
  const Plane affine = plane_of(kWidth, kHeight, [&](int x, int y) {
    float value = 1 + 0.02f * float(x) - 0.01f * float(y);
    for (const size_t f : varying) value += (f % 2 == 0 ? 0.5f : -0.25f) * features[f].at(x, y);
    return value;
  });
  const Plane ones = plane_of(kWidth, kHeight, [](int, int) { return 1.0f; });
  const Plane guide = plane_of(kWidth, kHeight, [&](int x, int y) { return 0.01f * float(x + y); });
  const Plane threes = plane_of(kWidth, kHeight, [](int, int) { return 3.0f; });
  RegressionInput in{{&guide, &guide, &guide}, {&ones, &ones, &ones}, &threes, {}, {}, &ones};
  for (size_t f = 0; f < kFeatures; ++f) in.features[f] = &features[f];
  in.targets.fill(&affine);
  Regression regression(kWidth, kHeight);
  const Fitted& fitted = regression.fit(in);
  for (const Plane& plane : fitted)
    for (int y = 0; y < kHeight; ++y)
      for (int x = 0; x < kWidth; ++x) EXPECT_NEAR(plane.at(x, y), affine.at(x, y), 0.01f) << x << ' ' << y;
}

TEST(Regression, FitsAffineFunctions) {
  for (const std::vector<size_t>& varying :
       {std::vector<size_t>{}, {6}, {1, 4}, {0, 3, 4, 5}, {0, 1, 2, 3, 4, 5, 6}}) {
    SCOPED_TRACE(varying.size());
    expect_affine_fit(varying);
  }
}

// Light that few samples bring, beside the dark, into which the planes that are fitted overshoot.
TEST(Denoise, IsNowhereNegativeWhereNoSampleIs) {
  Noisy picture = noisy([](int x, int) { return std::max(0.05f * float(x - kWidth / 2), 0.0f); }, 0.2f);
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x)
      for (int c = 0; c < 3; ++c) {
        float sum = 0;
        for (size_t h = 0; h < 2; ++h) {
          float& mean = picture.halves.at(x, y).mean[h][half_of(Layer::kDirect) + size_t(c)];
          mean = x < kWidth / 2 ? 0 : std::max(mean, 0.0f);
          sum += mean;
        }
        picture.film.at(x, y).direct[c] = 0.5f * sum;
      }
  const Image image = denoise(picture.film, picture.halves);
  EXPECT_FALSE(same(image, raw(picture)));
  for (const Rgb& pixel : image.pixels) EXPECT_GE(std::min({pixel.x, pixel.y, pixel.z}), 0);
}

// Some hundred pixels are averaged, at the cost of ten coefficients each; at the borders a quarter of them.
TEST(Denoise, TakesTheNoiseOfASmoothPicture) {
  const auto light = [](int x, int y) { return 1 + 0.01f * float(x) + 0.005f * float(y); };
  const float deviation = 0.2f;
  const Noisy picture = noisy(light, deviation);
  const Image image = denoise(picture.film, picture.halves);
  EXPECT_NEAR(error_of(raw(picture), light), deviation * deviation, 0.1 * deviation * deviation);
  EXPECT_LT(error_of(image, light), deviation * deviation / 7);
  const auto at_border = [](int x, int y) { return x < 2 || y < 2 || x >= kWidth - 2 || y >= kHeight - 2; };
  EXPECT_LT(error_of(image, light, at_border), deviation * deviation / 2.5);
}

TEST(Denoise, LeavesAPictureWithoutNoiseAsItIs) {
  const auto light = [](int x, int y) { return x * x % 7 == 0 && y % 3 != 0 ? 4.0f : 1.0f; };
  const Noisy picture = noisy(light, 0);
  EXPECT_TRUE(same(denoise(picture.film, picture.halves), raw(picture)));
}

// The edge of a shadow, which no feature shows: noise falls on either side, and pixels at the edge are no
// worse than before.
TEST(Denoise, KeepsEdgesThatFeaturesDoNotShow) {
  const auto light = [](int x, int) { return x < kWidth / 2 ? 1.0f : 3.0f; };
  const auto at_edge = [](int x, int) { return std::abs(x - kWidth / 2) <= 2; };
  const Noisy picture = noisy(light, 0.2f);
  const Image image = denoise(picture.film, picture.halves);
  EXPECT_LT(error_of(image, light), error_of(raw(picture), light) / 4);
  EXPECT_LT(error_of(image, light, at_edge), error_of(raw(picture), light, at_edge));
}

// A pattern of single pixels about as strong as the noise's deviation times ten stays.
TEST(Denoise, KeepsAPatternThatNoFeatureShows) {
  const auto light = [](int x, int y) { return x % 3 == 0 && y % 4 == 0 ? 3.0f : 1.0f; };
  const Noisy picture = noisy(light, 0.1f);
  const Image image = denoise(picture.film, picture.halves);
  EXPECT_LT(error_of(image, light), 1.05 * error_of(raw(picture), light));
}

TEST(Denoise, RemovesAnOutlierOfOneSample) {
  const auto light = [](int, int) { return 1.0f; };
  Noisy picture = noisy(light, 0.1f);
  constexpr float kOutlier = 100;
  for (size_t c = 0; c < 3; ++c) {
    picture.halves.at(30, 20).mean[0][half_of(Layer::kDirect) + c] += 2 * kOutlier;
    picture.film.at(30, 20).direct[int(c)] += kOutlier;
  }
  const Image image = denoise(picture.film, picture.halves);
  EXPECT_LT(image.at(30, 20).x, 1 + kOutlier / 10);
}

TEST(Denoise, PixelsWithoutTwoHalvesStay) {
  const auto light = [](int, int) { return 1.0f; };
  Noisy picture = noisy(light, 0.2f);
  picture.halves.at(5, 7) = {};
  const Image image = denoise(picture.film, picture.halves);
  EXPECT_EQ(image.at(5, 7), picture.film.at(5, 7).radiance());
  EXPECT_NE(image.at(6, 7), picture.film.at(6, 7).radiance());
  Noisy none = noisy(light, 0.2f);
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x) none.halves.at(x, y).share = {0, 0};
  EXPECT_FALSE(any_halves(none.halves));
  EXPECT_TRUE(same(denoise(none.film, none.halves), raw(none)));
}

TEST(Denoise, AnyNumberOfThreadsGivesTheSameBits) {
  const Noisy picture = noisy([](int x, int y) { return 1 + 0.5f * float((x / 9 + y / 5) % 2); }, 0.3f);
  Image one, four;
  tbb::task_arena(1).execute([&] { one = denoise(picture.film, picture.halves); });
  tbb::task_arena(4).execute([&] { four = denoise(picture.film, picture.halves); });
  EXPECT_TRUE(same(one, four));
}

// Radiance and lengths in other units, powers of two of the first, give the same bits.
TEST(Denoise, ScalesByPowersOfTwo) {
  const Noisy picture = noisy([](int x, int) { return x < 20 ? 1.0f : 2.0f; }, 0.3f);
  const Image image = denoise(picture.film, picture.halves);
  for (const int k : {-20, 20}) {
    Noisy scaled = picture;
    for (int y = 0; y < kHeight; ++y)
      for (int x = 0; x < kWidth; ++x) {
        scaled.film.at(x, y).direct *= std::ldexp(1.0f, k);
        for (auto& half : scaled.halves.at(x, y).mean) {
          for (size_t c = 0; c < 3; ++c) half[half_of(Layer::kDirect) + c] *= std::ldexp(1.0f, k);
          half[half_of(Layer::kDenoisingDepth)] *= std::ldexp(1.0f, -k);
        }
      }
    Image result = denoise(scaled.film, scaled.halves);
    for (Rgb& pixel : result.pixels) pixel *= std::ldexp(1.0f, -k);
    EXPECT_TRUE(same(result, image)) << "2^" << k;
  }
}

}  // namespace
}  // namespace kaustik::render
