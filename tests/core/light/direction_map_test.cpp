// Tests maps of all directions and their parts: the equal-area square, the sampling of cells, projectors.

#include <gtest/gtest.h>

#include "core/light/goniometric.h"
#include "core/light/image/direction_map.h"
#include "core/light/point.h"
#include "core/light/projection.h"
#include "core/light/sky/infinite.h"
#include "core/sampling/equal_area.h"
#include "tests/core/support/chi_square.h"
#include "tests/support/random.h"
#include "tests/support/statistics.h"

namespace kaustik {
namespace {

using test::Random;

std::shared_ptr<const LightImage> image_of(int width, int height,
                                           const std::function<Rgb(int x, int y)>& colour) {
  LightImage image{width, height, {}};
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) image.pixels.push_back(colour(x, y));
  return std::make_shared<const LightImage>(std::move(image));
}

Rgb coloured(int x, int y) {
  return {1.0f + static_cast<float>(x), 0.5f * static_cast<float>(y * y), x == y ? 9.0f : 0.25f};
}

DirectionMap map_of(DirectionMap::Layout layout, const std::function<Rgb(int, int)>& colour,
                    DirectionMap::Excess excess = DirectionMap::Excess::kLeftOut) {
  const int height = 6;
  return {image_of(layout == DirectionMap::Layout::kEqualArea ? height : 2 * height, height, colour), layout,
          excess};
}

TEST(EqualArea, RoundTrips) {
  Random random(1);
  for (int i = 0; i < 100000; ++i) {
    const Point2 p = random.uniform_2d();
    const Vector3 w = equal_area_square_to_sphere(p);
    ASSERT_NEAR(glm::length(w), 1, 1e-6);
    const Point2 back = equal_area_sphere_to_square(w);
    // Next to the poles, rounding w to float moves the azimuth by 1e-7 / r at the distance r from the pole.
    ASSERT_NEAR(glm::distance(back, p), 0, 2e-6) << p.x << " " << p.y;
  }
  for (const Vector3 axis : {Vector3(1, 0, 0), Vector3(0, 1, 0), Vector3(0, 0, 1)})
    for (const float sign : {1.0f, -1.0f}) {
      const Vector3 w = equal_area_square_to_sphere(equal_area_sphere_to_square(sign * axis));
      EXPECT_NEAR(glm::distance(w, sign * axis), 0, 1e-6);
    }
  // pbrt-v4's layout has +z in the middle, -z in the corners and +x to the right.
  EXPECT_NEAR(glm::distance(equal_area_sphere_to_square({0, 0, 1}), Point2(0.5f)), 0, 1e-6);
  EXPECT_NEAR(glm::distance(equal_area_sphere_to_square({1, 0, 0}), Point2(1, 0.5f)), 0, 1e-6);
  EXPECT_NEAR(glm::distance(equal_area_sphere_to_square({0, 1, 0}), Point2(0.5f, 1)), 0, 1e-6);
  EXPECT_NEAR(equal_area_square_to_sphere({0, 0}).z, -1, 1e-6);
}

// Uniform points of the square give uniform directions: chi-square test on (z, azimuth).
TEST(EqualArea, KeepsAreas) {
  test::SquareCase c{"equal-area square",
                     [](Random& random, Point2* p) {
                       *p = test::direction_to_square(equal_area_square_to_sphere(random.uniform_2d()), -1);
                       return true;
                     },
                     [](double, double) { return 1.0; }};
  test::expect_all_accepted({c}, 100000, 1e-9);
}

TEST(PiecewiseConstant2D, StatedProbabilitiesMatchTheChoices) {
  const auto weight = [](int x, int y) { return x == 2 ? 0.0 : 1e-3 + x * y; };
  const PiecewiseConstant2D d(5, 4, weight);
  double sum = 0, total = 0;
  for (int y = 0; y < 4; ++y)
    for (int x = 0; x < 5; ++x) total += weight(x, y);
  EXPECT_DOUBLE_EQ(d.total(), total);
  for (int y = 0; y < 4; ++y)
    for (int x = 0; x < 5; ++x) {
      sum += double(d.probability(x, y));
      // The shares of the row and of the column are rounded to 2^-24 at either end.
      EXPECT_NEAR(d.probability(x, y), weight(x, y) / total, 4 * 0x1p-24);
    }
  EXPECT_NEAR(sum, 1, 1e-6);
  // u runs over all multiples of 2^-12, so the share of a cell is exact up to the steps that cell borders
  // cut.
  std::array<int, 20> counts{};
  constexpr int kSteps = 1 << 10;
  for (int j = 0; j < kSteps; ++j)
    for (int i = 0; i < kSteps; ++i) {
      const auto s = d.sample({(float(i) + 0.5f) / kSteps, (float(j) + 0.5f) / kSteps});
      ASSERT_EQ(s.probability, d.probability(s.x, s.y));
      ASSERT_TRUE(s.in_cell.x >= 0 && s.in_cell.x < 1 && s.in_cell.y >= 0 && s.in_cell.y < 1);
      ++counts[size_t(5 * s.y + s.x)];
    }
  for (int y = 0; y < 4; ++y)
    for (int x = 0; x < 5; ++x)
      EXPECT_NEAR(counts[size_t(5 * y + x)] / double(kSteps * kSteps), double(d.probability(x, y)),
                  2.0 / kSteps);
}

TEST(PiecewiseConstant2D, CellsWithoutWeightAreNeverChosen) {
  const PiecewiseConstant2D d(64, 64, [](int x, int y) { return x == 5 && y == 9 ? 1.0 : 0.0; });
  for (const float u : {0.0f, 0.3f, kOneMinusEpsilon}) {
    const auto s = d.sample({u, u});
    EXPECT_EQ(s.x, 5);
    EXPECT_EQ(s.y, 9);
    EXPECT_EQ(s.probability, 1);
    EXPECT_EQ(s.in_cell, Point2(u));
  }
}

TEST(DirectionMap, SamplesReportTheMapsValuesAndDensities) {
  for (const auto layout : {DirectionMap::Layout::kEqualArea, DirectionMap::Layout::kLatLong}) {
    const DirectionMap map = map_of(layout, coloured);
    Random random(3);
    glm::dvec3 integral(0);
    int edges = 0;
    constexpr int kSamples = 20000;
    for (int i = 0; i < kSamples; ++i) {
      const DirectionMap::Sample s = map.sample(random.uniform_2d());
      integral += glm::dvec3(s.value) / double(s.pdf) / double(kSamples);
      edges +=
          map.value(s.w) != s.value || map.pdf(s.w) != s.pdf;  // rounding moved w across the edge of a pixel
    }
    EXPECT_LT(edges, 3);
    // Luminance over density is constant, so this estimate has no noise.
    EXPECT_NEAR(luminance(Rgb(integral)), 4 * std::numbers::pi * luminance(map.mean()),
                1e-4 * luminance(Rgb(integral)));
  }
}

// The even light and the excess over it add up to the light where it exceeds its mean, and bound it
// elsewhere.
TEST(DirectionMap, EvenLightAndExcessAddUpToTheLight) {
  for (const auto layout : {DirectionMap::Layout::kEqualArea, DirectionMap::Layout::kLatLong}) {
    const DirectionMap map = map_of(layout, coloured, DirectionMap::Excess::kSampled);
    const auto mean = luminance(map.mean());
    Random random(6);
    test::Mean even, excess;
    for (int i = 0; i < 200000; ++i) {
      const Vector3 w = random.direction();
      const float Y = luminance(map.value(w)), per_pdf = 4 * kPi * mean * (1 - map.even_share());
      even.add(double(std::min(Y, mean) / mean));
      excess.add(double(4 * kPi * map.excess_pdf(w)));
      ASSERT_NEAR(map.excess_pdf(w) * per_pdf, std::max(Y - mean, 0.0f), 1e-4f * (Y + mean));
      const Vector3 found = map.sample_excess(random.uniform_2d());
      ASSERT_GT(luminance(map.value(found)), mean);
    }
    EXPECT_NEAR(map.even_share(), even.mean, 4.5 * even.standard_error());
    EXPECT_NEAR(excess.mean, 1, 4.5 * excess.standard_error());
  }
}

// Compares with means over uniform directions.
TEST(DirectionMap, MeanAndIrradianceAreTheIntegrals) {
  for (const auto layout : {DirectionMap::Layout::kEqualArea, DirectionMap::Layout::kLatLong}) {
    const DirectionMap map = map_of(layout, coloured);
    Random random(4);
    test::Mean mean, irradiance, density;
    for (int i = 0; i < 200000; ++i) {
      const Vector3 w = random.direction();
      const double Y = double(luminance(map.value(w)));
      mean.add(Y);
      irradiance.add(w.z > 0 ? 4 * std::numbers::pi * Y * double(w.z) : 0);
      density.add(4 * std::numbers::pi * double(map.pdf(w)));
    }
    EXPECT_NEAR(luminance(map.mean()), mean.mean, 4.5 * mean.standard_error());
    EXPECT_NEAR(map.irradiance(), irradiance.mean, 4.5 * irradiance.standard_error());
    EXPECT_NEAR(density.mean, 1, 4.5 * density.standard_error());
  }
}

TEST(DirectionMap, LatitudeAndLongitudeFollowPbrtV3) {
  const auto at = [](int x, int y) { return Rgb(float(x), float(y), 0); };
  const DirectionMap map = map_of(DirectionMap::Layout::kLatLong, at);
  EXPECT_EQ(map.value({0, 0, 1}).y, 0);
  EXPECT_EQ(map.value({0, 0, -1}).y, 5);
  EXPECT_EQ(map.value(glm::normalize(Vector3(1, 0.01f, 0.01f))), Rgb(0, 2, 0));
  EXPECT_EQ(map.value(glm::normalize(Vector3(0.01f, 1, -0.01f))),
            Rgb(2, 3, 0));  // a quarter of the 12 columns further
  EXPECT_EQ(map.value(glm::normalize(Vector3(1, -0.01f, 0.01f))), Rgb(11, 2, 0));
}

// A map of one colour gives the same light as a constant infinite light, in every layout and size.
TEST(DirectionMap, ConstantMapEqualsTheConstantLight) {
  const InfiniteLight constant{{1, 2, 3}, {1, 0, 0}, 2};
  for (const auto layout : {DirectionMap::Layout::kEqualArea, DirectionMap::Layout::kLatLong}) {
    const auto map = std::make_shared<const DirectionMap>(map_of(
        layout, [](int, int) { return Rgb(1, 2, 3); }, DirectionMap::Excess::kSampled));
    EXPECT_EQ(map->even_share(), 1);
    const ImageInfiniteLight light{map, glm::mat3(1), 1, {1, 0, 0}, 2};
    // Parts of 1/66 of the map's height lie on either side of the horizon, where cosines up to 1/33 count as
    // their mean, 1/66.
    const double E = std::numbers::pi * luminance({1, 2, 3});
    EXPECT_NEAR(map->irradiance(), E, 2e-3 * E);
    EXPECT_NEAR(glm::distance(light.power(), constant.power()), 0, 1e-5f * constant.power().z);
    Random random(5);
    for (int i = 0; i < 1000; ++i) {
      const Vector3 w = random.direction();
      EXPECT_EQ(light.Le({{0, 0, 0}, w}), Rgb(1, 2, 3));
      const LightReceiver x{{0, 0, 0}, random.direction(), i % 2 == 0};
      EXPECT_EQ(light.pdf_Li(x, w), constant.pdf_Li(x, w));
      const auto photon = light.sample_Le(random.uniform_2d(), random.uniform_2d(), EmissionMode::kCosine);
      EXPECT_NEAR(glm::distance(photon->flux, constant.power()), 0, 1e-5f * constant.power().z);
    }
    const PointLight point{{1, 2, 3}, {3, 2, 1}};
    const GoniometricLight goniometric{{1, 2, 3}, glm::mat3(1), map, {3, 2, 1}};
    const auto a = point.sample_Li({0, 5, 1}, {}), b = goniometric.sample_Li({0, 5, 1}, {});
    EXPECT_EQ(a->Li, b->Li);
    EXPECT_NEAR(glm::distance(point.power(), goniometric.power()), 0, 1e-4);
  }
}

TEST(DirectionMap, BlackMapsEmitNothing) {
  const auto map = std::make_shared<const DirectionMap>(
      map_of(DirectionMap::Layout::kEqualArea, [](int, int) { return Rgb(0); }));
  const ImageInfiniteLight sky{map, glm::mat3(1), 1, {0, 0, 0}, 1};
  EXPECT_EQ(sky.power(), Rgb(0));
  EXPECT_EQ(sky.sample_Li({{0, 0, 0}}, {0.5f, 0.5f})->Li, Rgb(0));
  EXPECT_FALSE(sky.sample_Le({0.5f, 0.5f}, {0.5f, 0.5f}, EmissionMode::kCosine));
}

// The power is proportional to the solid angle of the pyramid, 4 asin(sin(a/2) sin(b/2)) for apex angles a
// and b (van Oosterom and Strackee 1983).
TEST(ProjectedImage, PowerIsTheSolidAngleOfThePyramid) {
  const double fov = 50, tangent = std::tan(glm::radians(fov) / 2);
  for (const auto& [width, height] : {std::pair(1, 1), std::pair(3, 1), std::pair(200, 300)}) {
    const ProjectedImage image(image_of(width, height, [](int, int) { return Rgb(2); }), fov);
    const int shorter = std::min(width, height);
    const double a = std::atan(tangent * width / shorter), b = std::atan(tangent * height / shorter);
    EXPECT_NEAR(image.integral().x, 2 * 4 * std::asin(std::sin(a) * std::sin(b)), 1e-5);
    EXPECT_NEAR(image.least_cosine(), 1 / std::sqrt(1 + std::pow(std::tan(a), 2) + std::pow(std::tan(b), 2)),
                1e-6);
  }
}

// The image's upper left is at +y, -x. The edge of a lit rectangle lies where the angle says.
TEST(ProjectedImage, ShowsTheImageUpright) {
  const auto quarters = [](int x, int y) { return Rgb(float(2 * y + x + 1)); };
  const ProjectedImage image(image_of(2, 2, quarters), 90);
  EXPECT_EQ(image.value({-0.5f, 0.5f, 1}).x, 1);
  EXPECT_EQ(image.value({0.5f, 0.5f, 1}).x, 2);
  EXPECT_EQ(image.value({-0.5f, -0.5f, 1}).x, 3);
  EXPECT_EQ(image.value({0.99f, -0.99f, 1}).x, 4);
  EXPECT_EQ(image.value({1.01f, 0, 1}).x, 0);
  EXPECT_EQ(image.value({0, 0, -1}).x, 0);
  Random random(6);
  for (int i = 0; i < 1000; ++i) {
    const ProjectedImage::Sample s = image.sample(random.uniform_2d());
    EXPECT_EQ(image.value(s.w), s.value);
    // Within one of 64 cells a side cos^3 changes by at most 3 * 1.4 / 64, and luminance / pdf with it.
    EXPECT_NEAR(s.value.x / s.pdf, image.integral().x, 0.07 * double(image.integral().x));
  }
}

}  // namespace
}  // namespace kaustik
