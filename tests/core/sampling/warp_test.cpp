#include "core/sampling/warp.h"

#include <gtest/gtest.h>

#include "tests/core/support/chi_square.h"
#include "tests/support/random.h"
#include "tests/support/statistics.h"

namespace kaustik {
namespace {

using test::Random;
using test::SquareCase;

float turns_of(const Point2& p) {
  const float turns = std::atan2(p.y, p.x) / (2 * kPi);
  return turns < 0 ? turns + 1 : turns;
}

SquareCase direction_case(const std::string& name, double z_min, std::function<Vector3(const Point2&)> warp,
                          std::function<double(double z)> pdf) {
  SquareCase c;
  c.name = name;
  c.sample = [=](Random& random, Point2* p) {
    *p = test::direction_to_square(warp(random.uniform_2d()), z_min);
    return true;
  };
  c.density = [=](double x, double) {
    return pdf(z_min + x * (1 - z_min)) * test::square_solid_angle(z_min);
  };
  return c;
}

TEST(Warp, EveryWarpFollowsItsDensity) {
  const auto one = [](double, double) { return 1.0; };
  std::vector<SquareCase> cases;
  cases.push_back({"concentric disk",
                   [](Random& random, Point2* p) {
                     const Point2 d = sample_uniform_disk_concentric(random.uniform_2d());
                     *p = {glm::dot(d, d), turns_of(d)};  // equal areas
                     return true;
                   },
                   one});
  cases.push_back({"triangle",
                   [](Random& random, Point2* p) {
                     const Point2 b = sample_uniform_triangle(random.uniform_2d());
                     *p = {(1 - b.y) * (1 - b.y), b.x / (1 - b.y)};  // equal areas
                     return true;
                   },
                   one});
  cases.push_back(direction_case("cosine hemisphere", -1, sample_cosine_hemisphere, [](double z) {
    return static_cast<double>(cosine_hemisphere_pdf(static_cast<float>(z)));
  }));
  cases.push_back(direction_case("uniform sphere", -1, sample_uniform_sphere,
                                 [](double) { return static_cast<double>(kUniformSpherePdf); }));
  cases.push_back(direction_case(
      "cone of 60 degrees", 0.5, [](const Point2& u) { return sample_uniform_cone(u, 0.5f); },
      [](double) { return static_cast<double>(uniform_cone_pdf(0.5f)); }));
  // Masses are sums of float densities: relative rounding 1e-6.
  test::expect_all_accepted(cases, 200000, 1e-5);
}

TEST(Warp, CosineAndSineOfTurns) {
  // The terms left out of the series are below 2^-28; the argument's rounding and a few float operations
  // leave 4 ulp of one.
  for (int i = 0; i <= 4096; ++i) {
    const float turns = static_cast<float>(i) / 4096;
    const Point2 cs = cos_sin_turns(turns);
    EXPECT_NEAR(cs.x, std::cos(2 * std::numbers::pi * turns), 4 * 0x1p-24);
    EXPECT_NEAR(cs.y, std::sin(2 * std::numbers::pi * turns), 4 * 0x1p-24);
  }
}

TEST(Warp, DirectionsAreUnit) {
  Random random(3);
  for (int i = 0; i < 100000; ++i) {
    const Point2 u = random.uniform_2d();
    // The squared length is off by a few roundings of numbers near one.
    EXPECT_NEAR(length_squared(sample_cosine_hemisphere(u)), 1, 16 * 0x1p-24);
    EXPECT_NEAR(length_squared(sample_uniform_sphere(u)), 1, 16 * 0x1p-24);
    EXPECT_NEAR(length_squared(sample_uniform_cone(u, 1e-3f)), 1, 16 * 0x1p-24);
  }
}

// A cone as thin as the sun seen from another star: the code keeps 1 - cos although cos rounds to one.
TEST(Warp, ThinConeKeepsItsWidth) {
  constexpr float kOneMinusCos = 1e-14f;
  test::Mean sin2;
  Random random(4);
  for (int i = 0; i < 100000; ++i) {
    const Vector3 w = sample_uniform_cone(random.uniform_2d(), kOneMinusCos);
    sin2.add(w.x * static_cast<double>(w.x) + w.y * static_cast<double>(w.y));
  }
  // sin^2 = 2 h - h^2 with h uniform in (0, one_minus_cos), whose mean is one_minus_cos.
  EXPECT_NEAR(sin2.mean / kOneMinusCos, 1, 5 * sin2.standard_error() / kOneMinusCos);
}

}  // namespace
}  // namespace kaustik
