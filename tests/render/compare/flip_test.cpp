// Tests FLIP against the paper's formulas, written out anew in two dimensions and double precision, and
// against values worked out by hand.

#include "render/compare/flip.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <random>
#include <stdexcept>

namespace kaustik::render {
namespace {

using Vec = std::array<double, 3>;
constexpr double kPi2 = std::numbers::pi * std::numbers::pi;

// The rounded matrix of IEC 61966-2-1; its rows sum to the white.
constexpr double kToXyz[3][3] = {
    {0.4124, 0.3576, 0.1805}, {0.2126, 0.7152, 0.0722}, {0.0193, 0.1192, 0.9505}};

Vec relative_xyz(const Vec& rgb) {
  Vec out{};
  for (size_t i = 0; i < 3; ++i) {
    double white = 0;
    for (size_t j = 0; j < 3; ++j) out[i] += kToXyz[i][j] * rgb[j], white += kToXyz[i][j];
    out[i] /= white;
  }
  return out;
}

Vec opponent(const Vec& rgb) {
  const auto [x, y, z] = relative_xyz(rgb);
  return {116 * y - 16, 500 * (x - y), 200 * (y - z)};
}

// Solves the linear equations by Cramer's rule.
Vec rgb_from_opponent(const Vec& c) {
  const double y = (c[0] + 16) / 116;
  Vec xyz = {y + c[1] / 500, y, y - c[2] / 200};
  glm::dmat3 m;
  for (size_t i = 0; i < 3; ++i)
    for (size_t j = 0; j < 3; ++j) m[int(j)][int(i)] = kToXyz[i][j];
  for (size_t i = 0; i < 3; ++i) xyz[i] *= kToXyz[i][0] + kToXyz[i][1] + kToXyz[i][2];
  const double all = glm::determinant(m);
  Vec rgb{};
  for (int k = 0; k < 3; ++k) {
    glm::dmat3 replaced = m;
    replaced[k] = {xyz[0], xyz[1], xyz[2]};
    rgb[size_t(k)] = std::clamp(glm::determinant(replaced) / all, 0.0, 1.0);
  }
  return rgb;
}

Vec perceived(const Vec& rgb) {
  Vec f = relative_xyz(rgb);
  for (double& t : f) t = t > 216.0 / 24389 ? std::cbrt(t) : (24389.0 / 27 * t + 16) / 116;
  const double L = 116 * f[1] - 16;
  return {L, L / 100 * 500 * (f[0] - f[1]), L / 100 * 200 * (f[1] - f[2])};
}

double colour_error(const Vec& a, const Vec& b) {
  const auto distance = [](const Vec& u, const Vec& v) {
    return std::pow(std::abs(u[0] - v[0]) + std::hypot(u[1] - v[1], u[2] - v[2]), 0.7);
  };
  const double largest = distance(perceived({0, 1, 0}), perceived({0, 0, 1}));
  const double d = distance(a, b), knee = 0.4 * largest;
  return d < knee ? 0.95 / knee * d : 0.95 + (d - knee) / (largest - knee) * 0.05;
}

using Kernel = std::function<double(double x, double y)>;

// Weights the pixels around (x, y); the positive weights are divided by their sum, the negative ones by
// theirs.
double filtered(const Image& image, int x, int y, int reach, const Kernel& kernel,
                const std::function<double(const Vec&)>& value) {
  double positive = 0, negative = 0, sum_positive = 0, sum_negative = 0;
  for (int v = -reach; v <= reach; ++v)
    for (int u = -reach; u <= reach; ++u) {
      const Rgb& p = image.at(std::clamp(x + u, 0, image.width - 1), std::clamp(y + v, 0, image.height - 1));
      const double w = kernel(u, v), f = w * value({double(p.x), double(p.y), double(p.z)});
      (w > 0 ? sum_positive : sum_negative) += std::abs(w);
      (w > 0 ? positive : negative) += f;
    }
  return positive / sum_positive + (sum_negative > 0 ? negative / sum_negative : 0);
}

Vec seen(const Image& image, int x, int y, double ppd) {
  constexpr double kA[3][4] = {{1, 0.0047, 0, 1e-5}, {1, 0.0053, 0, 1e-5}, {34.1, 0.04, 13.5, 0.025}};
  const int reach = int(std::ceil(3 * std::sqrt(0.04 / (2 * kPi2)) * ppd));
  Vec out{};
  for (size_t c = 0; c < 3; ++c) {
    const auto [a1, b1, a2, b2] = kA[c];
    const Kernel kernel = [&, a1 = a1, b1 = b1, a2 = a2, b2 = b2](double u, double v) {
      const double z = (u * u + v * v) / (ppd * ppd);
      return a1 * std::sqrt(std::numbers::pi / b1) * std::exp(-kPi2 * z / b1) +
             a2 * std::sqrt(std::numbers::pi / b2) * std::exp(-kPi2 * z / b2);
    };
    out[c] = filtered(image, x, y, reach, kernel, [&](const Vec& rgb) { return opponent(rgb)[c]; });
  }
  return perceived(rgb_from_opponent(out));
}

double feature(const Image& image, int x, int y, double ppd, bool point) {
  const double sigma = 0.5 * 0.082 * ppd;
  const auto along = [&](bool vertical) {
    return filtered(
        image, x, y, int(std::ceil(3 * sigma)),
        [&](double u, double v) {
          const double t = vertical ? v : u, g = std::exp(-(u * u + v * v) / (2 * sigma * sigma));
          return (point ? t * t / (sigma * sigma) - 1 : -t) * g;
        },
        [](const Vec& rgb) { return (opponent(rgb)[0] + 16) / 116; });
  };
  return std::hypot(along(false), along(true));
}

double expected(const Image& reference, const Image& image, int x, int y, double ppd) {
  const double colour = colour_error(seen(reference, x, y, ppd), seen(image, x, y, ppd));
  double difference = 0;
  for (const bool point : {false, true})
    difference = std::max(difference,
                          std::abs(feature(reference, x, y, ppd, point) - feature(image, x, y, ppd, point)));
  return std::pow(colour, 1 - std::sqrt(difference / std::sqrt(2.0)));
}

Image random_picture(unsigned seed, int width, int height) {
  std::mt19937 random(seed);
  Image image(width, height);
  for (Rgb& p : image.pixels)
    for (int c = 0; c < 3; ++c) p[c] = float(random() % 1024) / 1023;
  return image;
}

// A disc of another colour on a gradient; in the second picture it is moved and the gradient is tinted.
Image smooth_picture(float center, float tint) {
  Image image(40, 30);
  for (int y = 0; y < 30; ++y)
    for (int x = 0; x < 40; ++x) {
      const bool inside = std::hypot(float(x) - center, float(y) - 14) < 7;
      image.at(x, y) = inside ? Rgb(0.7f, 0.2f, 0.1f) : Rgb(0.02f * float(x), 0.4f, tint);
    }
  return image;
}

// Float sums of 21 x 21 weights, roots of small differences of features, and the rounded matrix.
constexpr double kTolerance = 2e-3;

TEST(Flip, MatchesThePapersFormulas) {
  const std::pair<Image, Image> pairs[] = {{smooth_picture(18, 0.3f), smooth_picture(20, 0.35f)},
                                           {random_picture(1, 17, 12), random_picture(2, 17, 12)}};
  for (const auto& [reference, image] : pairs)
    for (const double ppd : {67.0206, 20.0}) {
      const Flip flip = flip_of_display(reference, image, {ppd});
      double mean = 0;
      for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x) {
          const double error = expected(reference, image, x, y, ppd);
          EXPECT_NEAR(flip.error[size_t(y * image.width + x)], error, kTolerance)
              << x << " " << y << " " << ppd;
          mean += error / double(image.pixels.size());
        }
      EXPECT_NEAR(flip.mean, mean, kTolerance / 4);
    }
}

TEST(Flip, EqualPicturesDoNotDiffer) {
  const Image image = random_picture(3, 9, 9);
  EXPECT_EQ(flip_of_display(image, image).mean, 0);
  EXPECT_EQ(flip_of_radiance(image, image).mean, 0);
}

// Even pictures have no features, and filters leave them as they are. The colours of green and blue are the
// most different ones. For greys of luminance 0.2 and 0.3, L* is 51.837 and 61.654; 0.95 / 0.4 / 41.27 times
// their difference to the power of 0.7, where 41.27 is the largest distance to that power.
TEST(Flip, EvenPicturesByHand) {
  const Image green(8, 8, {0, 1, 0}), blue(8, 8, {0, 0, 1}), dark(8, 8, Rgb(0.2f)), light(8, 8, Rgb(0.3f));
  EXPECT_NEAR(flip_of_display(green, blue).mean, 1, 1e-4);
  EXPECT_NEAR(flip_of_display(dark, light).mean, 0.95 / 0.4 / 41.27 * std::pow(9.817, 0.7), 1e-3);
}

// What only one picture shows at an edge counts more than an even difference of the same size.
TEST(Flip, EdgesAmplify) {
  const Image even(32, 32, Rgb(0.5f));
  Image half = even;
  for (int y = 0; y < 32; ++y)
    for (int x = 16; x < 32; ++x) half.at(x, y) = Rgb(0.55f);
  const Flip flip = flip_of_display(even, half);
  EXPECT_GT(flip.error[16 * 32 + 16], 1.2 * double(flip.error[16 * 32 + 31]));
  EXPECT_LT(flip.error[16 * 32], 1e-3f);
}

// The reference's luminance is 8 at most and 1 in the median: three stops apart, so three exposures.
TEST(Flip, RadianceIsComparedAtTheExposuresThatShowIt) {
  Image reference(5, 1, Rgb(1)), image = reference;
  reference.at(0, 0) = image.at(0, 0) = Rgb(8);
  image.at(4, 0) = Rgb(1.5f);
  const Flip flip = flip_of_radiance(reference, image);
  ASSERT_TRUE(flip.exposures);
  EXPECT_EQ(flip.exposures->count, 3);
  EXPECT_NEAR(flip.exposures->stop - flip.exposures->start, 3, 1e-6);
  // At the last exposure the median is shown as 0.85.
  const double x = std::exp2(flip.exposures->stop);
  EXPECT_NEAR(0.6 * x * (2.51 * 0.6 * x + 0.03) / (0.6 * x * (2.43 * 0.6 * x + 0.59) + 0.14), 0.85, 1e-6);
  double largest = 0;
  for (int i = 0; i < 3; ++i) {
    Image shown[2] = {reference, image};
    for (Image& picture : shown)
      for (Rgb& p : picture.pixels) {
        const double e = 0.6 * double(p.x) * std::exp2(flip.exposures->start + 1.5 * i);
        p = Rgb(float(e * (2.51 * e + 0.03) / (e * (2.43 * e + 0.59) + 0.14)));
      }
    largest = std::max(largest, double(flip_of_display(shown[0], shown[1]).error[4]));
  }
  EXPECT_NEAR(flip.error[4], largest, 1e-5);
}

TEST(Flip, ExtremeRadianceIsFinite) {
  Image black(6, 4), bright(6, 4, Rgb(1e30f)), point = black;
  point.at(2, 2) = Rgb(1e-20f);
  for (const Image* reference : {&black, &bright, &point})
    for (const Image* image : {&black, &bright, &point}) {
      const Flip flip = flip_of_radiance(*reference, *image);
      EXPECT_LE(flip.exposures->count, 32);
      for (const float e : flip.error) EXPECT_TRUE(e >= 0 && e <= 1) << e;
    }
  EXPECT_GT(flip_of_radiance(black, bright).mean, 0.9);
}

TEST(Flip, PixelsThatDoNotCompareAreLeftOut) {
  Image reference(4, 4, Rgb(0.5f)), image = reference;
  image.at(1, 1) = Rgb(NAN);
  EXPECT_EQ(flip_of_display(reference, image).mean, 0);
  EXPECT_THROW(flip_of_display(reference, Image(3, 4)), std::invalid_argument);
}

}  // namespace
}  // namespace kaustik::render
