#include "core/camera/pixel_filter.h"

#include <gtest/gtest.h>

#include "tests/core/support/chi_square.h"
#include "tests/support/random.h"

namespace kaustik {
namespace {

using test::Random;

struct Named {
  std::string name;
  FilterAxis x, y;
};

// pbrt's defaults, and one filter of each kind with different radii in x and y.
std::vector<Named> filters() {
  const auto axis = [](FilterKind kind, float radius) {
    FilterAxis a;
    a.kind = kind;
    a.radius = radius;
    return a;
  };
  std::vector<Named> all;
  for (const auto& [name, kind, radius] : {std::tuple{"box", FilterKind::kBox, 0.5f},
                                           {"triangle", FilterKind::kTriangle, 2.0f},
                                           {"gaussian", FilterKind::kGaussian, 1.5f},
                                           {"mitchell", FilterKind::kMitchell, 2.0f},
                                           {"sinc", FilterKind::kSinc, 4.0f}}) {
    all.push_back({name, axis(kind, radius), axis(kind, radius)});
    all.push_back({std::string(name) + " uneven", axis(kind, radius), axis(kind, 2 * radius)});
  }
  return all;
}

// The integral of f or |f| over its support by the midpoint rule, whose error at kinks is about (2 / n)^2 of
// it.
double integral(const FilterAxis& f, bool modulus) {
  constexpr int kSteps = 1 << 14;
  double sum = 0;
  for (int i = 0; i < kSteps; ++i) {
    const double v = f((2 * (i + 0.5) / kSteps - 1) * double(f.radius));
    sum += (modulus ? std::abs(v) : v) * 2 * double(f.radius) / kSteps;
  }
  return sum;
}

TEST(PixelFilter, SamplesFollowItsModulus) {
  std::vector<test::SquareCase> cases;
  for (const Named& n : filters()) {
    const PixelFilter filter(n.x, n.y);
    test::SquareCase c;
    c.name = n.name;
    c.sample = [=](Random& random, Point2* p) {
      *p = 0.5f + 0.5f * filter.sample(random.uniform_2d()).offset / Point2(n.x.radius, n.y.radius);
      return true;
    };
    const double area = 4 * double(n.x.radius) * double(n.y.radius);
    const double whole = integral(n.x, true) * integral(n.y, true);
    c.density = [=](double x, double y) {
      return area * std::abs(n.x((2 * x - 1) * double(n.x.radius)) * n.y((2 * y - 1) * double(n.y.radius))) /
             whole;
    };
    c.subdivisions = 8;
    cases.push_back(std::move(c));
  }
  // The test evaluates |f| at the midpoints of cells of 1/128 of the support h. |f| bends by at most pi^2 per
  // square pixel and has kinks at its zeros, so this rule is off by about pi^2 h^2 / 24 per axis: 3e-3 for
  // sinc, where h is 1/8 of a pixel.
  test::expect_all_accepted(cases, 200000, 5e-3);
}

// Weights times density are the filter: divided by its mean weight it integrates to one, and its mean is the
// pixel's centre.
TEST(PixelFilter, WeightsIntegrateToOne) {
  constexpr int kSide = 512;
  for (const Named& n : filters()) {
    SCOPED_TRACE(n.name);
    const PixelFilter filter(n.x, n.y);
    double weight = 0;
    glm::dvec2 lean(0);
    for (int i = 0; i < kSide * kSide; ++i) {
      const FilterSample s =
          filter.sample({(float(i % kSide) + 0.5f) / kSide, (float(i / kSide) + 0.5f) / kSide});
      weight += s.weight;
      lean += double(s.weight) * glm::dvec2(s.offset);
    }
    const double expected =
        integral(n.x, false) / integral(n.x, true) * integral(n.y, false) / integral(n.y, true);
    // The table's cells are 1/32 pixel wide, and the integral of |f| over each is off by about (1/32)^2 / 12
    // of its curvature, pi^2 for sinc. The grid places sign changes to within a cell of 1/512 on each axis;
    // there are at most 14 of them.
    EXPECT_NEAR(filter.mean_weight(), expected, 2e-3);
    EXPECT_NEAR(weight / (kSide * kSide), filter.mean_weight(), 2.0 * 14 / kSide);
    EXPECT_LT(glm::length(lean) / (kSide * kSide), 14 * double(n.y.radius) / kSide);
  }
}

TEST(PixelFilter, TheDefaultIsTheMeanOverThePixel) {
  const PixelFilter filter;
  EXPECT_TRUE(filter.is_pixel_box());
  EXPECT_EQ(filter.sample({0.25f, 0.75f}).offset, Point2(-0.25f, 0.25f));
  EXPECT_FALSE(PixelFilter({FilterKind::kBox, 1}, {}).is_pixel_box());
}

// Compares with closed forms at a few points (Mitchell and Netravali 1988, equation 8; Lanczos' window).
TEST(PixelFilter, ValuesMatchThePublishedFormulas) {
  const FilterAxis mitchell{FilterKind::kMitchell, 2};
  EXPECT_NEAR(mitchell(0), (6 - 2 / 3.0) / 6, 1e-6);
  EXPECT_NEAR(mitchell(1), 1 / 18.0, 1e-6);
  EXPECT_NEAR(mitchell(2), 0, 1e-6);
  EXPECT_LT(mitchell(1.5), 0);
  const FilterAxis sinc{FilterKind::kSinc, 4};
  EXPECT_NEAR(sinc(0), 1, 1e-12);
  EXPECT_NEAR(sinc(1), 0, 1e-12);
  EXPECT_LT(sinc(1.5), 0);
  EXPECT_EQ(sinc(4.1), 0);
  const FilterAxis gaussian{FilterKind::kGaussian, 1.5f};
  EXPECT_NEAR(gaussian(1.5), 0, 1e-12);
}

}  // namespace
}  // namespace kaustik
