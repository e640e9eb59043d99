// Tests grids of densities: what is between the points, and integrals along rays against sums.

#include "core/medium/density_grid.h"

#include <gtest/gtest.h>

#include <glm/gtc/matrix_transform.hpp>
#include <random>

#include "core/medium/free_path.h"
#include "core/medium/medium.h"
#include "tests/support/density_grids.h"
#include "tests/support/statistics.h"

namespace kaustik {
namespace {

using test::grid_of;
using test::Mean;

// A cloud with holes: some of its bricks are empty, and its sides are not.
double cloud(const glm::dvec3& p) {
  const double value = std::sin(5 * p.x) + std::sin(4 * p.y + 1) + std::cos(3 * p.z);
  return std::max(value, 0.0);
}
const glm::ivec3 kPoints(21, 17, 30);
const glm::dvec3 kLo(-1, -2, 0), kHi(2, 1, 3);

// The integral as a sum over many short steps.
double sum_along(const DensityGrid& grid, const Ray& ray, double begin, double end) {
  constexpr int kSteps = 100'000;
  double sum = 0;
  for (int i = 0; i < kSteps; ++i)
    sum += double(grid.at(ray.at(float(begin + (end - begin) * (i + 0.5) / kSteps))));
  return sum * (end - begin) / kSteps;
}

// Rays of all kinds, among them some along axes and in planes of the grid, and some that miss it.
std::vector<Ray> rays() {
  std::mt19937 random(1);
  std::uniform_real_distribution<float> u(0, 1);
  const auto within = [&] {
    return Vector3(kLo) + Vector3(kHi - kLo) * Vector3(u(random), u(random), u(random));
  };
  std::vector<Ray> all = {{{-2, 0, 1}, {1, 0, 0}}, {{0.5f, -3, 1.5f}, {0, 1, 0}},
                          {{0, 0, 4}, {0, 0, -1}}, {{0.5f, -0.5f, 1.5f}, {0, 0, 1}},
                          {{-2, 5, 1}, {1, 0, 0}}, {{-1, -2, 0}, glm::normalize(Vector3(1))}};
  for (int i = 0; i < 40; ++i) {
    const Point3 o = 2.0f * within();
    all.push_back({o, glm::normalize(within() - o)});
  }
  return all;
}

TEST(DensityGrid, InterpolatesAndEndsAtItsBox) {
  const std::vector<double> values = {1, 2, 4, 8};
  const DensityGrid grid({2, 2, 1}, values, test::box_between({0, 0, 0}, {2, 2, 1}));
  EXPECT_EQ(grid.at({0.5f, 0.5f, 0.5f}), 1);
  EXPECT_EQ(grid.at({1.5f, 0.5f, 0.5f}), 2);
  EXPECT_EQ(grid.at({0.5f, 1.5f, 0.5f}), 4);
  EXPECT_EQ(grid.at({1, 0.5f, 0.5f}), 1.5f);
  EXPECT_EQ(grid.at({1, 1, 0.5f}), 3.75f);
  // Half of it is left at a side, and nothing beyond.
  EXPECT_EQ(grid.at({0, 0.5f, 0.5f}), 0.5f);
  EXPECT_EQ(grid.at({0.5f, 0.5f, 1}), 0.5f);
  EXPECT_EQ(grid.at({-0.01f, 0.5f, 0.5f}), 0);
  EXPECT_EQ(grid.at({0.5f, 0.5f, 1.01f}), 0);
  EXPECT_EQ(grid.at({NAN, 0, 0}), 0);
  EXPECT_EQ(grid.largest(), 8);
}

// The sums are off by a step's length times the density where the ray enters and leaves the box, 7e-5 m * 3
// each, and by the rounding of the places.
TEST(DensityGrid, ColumnsAreIntegrals) {
  const auto grid = grid_of(kPoints, kLo, kHi, cloud);
  int met = 0;
  for (const Ray& ray : rays()) {
    const double expected = sum_along(*grid, ray, 0.25, 7);
    EXPECT_NEAR(double(grid->column(ray, 0.25f, 7)), expected, 5e-4);
    EXPECT_NEAR(double(grid->column(ray, 0.25f, kInfinity)), sum_along(*grid, ray, 0.25, 20), 1.5e-3);
    met += expected > 0.1;
  }
  EXPECT_GT(met, 20);
}

// Along a diagonal, the density is a polynomial of third degree between two planes.
TEST(DensityGrid, ColumnsAreExactForCubes) {
  const auto grid =
      grid_of({2, 2, 2}, {-1, -1, -1}, {3, 3, 3}, [](const glm::dvec3& p) { return p.x * p.y * p.z; });
  const Ray ray{{0, 0, 0}, glm::normalize(Vector3(1))};
  // int_0^L (t / sqrt(3))^3 dt, to the last point.
  const double L = 2 * std::sqrt(3);
  EXPECT_NEAR(double(grid->column(ray, 0, float(L))), std::pow(L, 4) / (4 * std::pow(3, 1.5)), 1e-5);
}

TEST(DensityGrid, PlacesInvertColumns) {
  const auto grid = grid_of(kPoints, kLo, kHi, cloud);
  for (const Ray& ray : rays()) {
    const float whole = grid->column(ray, 0.25f, 6);
    for (const float share : {0.0f, 0.01f, 0.3f, 0.77f, 0.999f}) {
      if (!(whole > 0)) continue;
      const float place = grid->place_of(share * whole, ray, 0.25f, 6);
      ASSERT_TRUE(place >= 0.25f && place <= 6);
      EXPECT_NEAR(grid->column(ray, 0.25f, place), share * whole, 1e-5f * (1 + whole)) << share;
    }
    EXPECT_EQ(grid->place_of(2 * whole + 1, ray, 0.25f, 6), 6);
  }
}

// Between planes the table is cubic, with the densities at both as slopes, where the column density is of
// fourth degree: the error is at most h^4 / 384 times its fourth derivative.
TEST(DensityGrid, TablesHoldColumns) {
  const auto grid = grid_of(kPoints, kLo, kHi, cloud);
  for (const Ray& ray : rays()) {
    const ColumnTable table(*grid, ray, 6);
    const float whole = grid->column(ray, 0, 6);
    EXPECT_NEAR(table.at(6), whole, 1e-5f * (1 + whole));
    EXPECT_EQ(table.at(0), 0);
    float before = 0;
    for (float t = 0.01f; t < 6; t += 0.37f) {
      EXPECT_NEAR(table.at(t), grid->column(ray, 0, t), 3e-4f) << t;
      EXPECT_GE(table.at(t), before);
      before = table.at(t);
    }
  }
  EXPECT_EQ(ColumnTable(*grid, {{9, 9, 9}, {1, 0, 0}}, kInfinity).at(3), 0);
}

// A box that is turned, sheared and far away gives what its points say in its own space.
TEST(DensityGrid, FollowsItsTransform) {
  glm::dmat4 m = glm::rotate(glm::translate(glm::dmat4(1), {30, -20, 10}), 0.7, glm::dvec3(1, 2, 3));
  m[1] += 0.5 * m[0];
  m = m * test::box_between({0, 0, 0}, {2, 3, 4});
  std::vector<double> values;
  test::for_each_point({5, 6, 7}, glm::dvec3(0), glm::dvec3(1),
                       [&](const glm::dvec3& p) { values.push_back(cloud(p)); });
  const DensityGrid grid({5, 6, 7}, values, m), own({5, 6, 7}, values, glm::dmat4(1));
  for (double x = 0.05; x < 1; x += 0.17)
    for (double y = 0.05; y < 1; y += 0.17) {
      const Point3 p(m * glm::dvec4(x, y, 0.4, 1));
      EXPECT_NEAR(grid.at(p), own.at(Point3(x, y, 0.4)), 1e-4f);
    }
  const Ray ray{Point3(m * glm::dvec4(0.5, 0.5, -1, 1)), Vector3(glm::normalize(glm::dvec3(m[2])))};
  EXPECT_NEAR(grid.column(ray, 0, 100), sum_along(grid, ray, 0, 20), 1e-3);
}

TEST(DensityGrid, ScalesByPowersOfTwo) {
  const float s = 0x1p-9f;
  const auto grid = grid_of(kPoints, kLo, kHi, cloud),
             small = grid_of(kPoints, kLo * double(s), kHi * double(s),
                             [&](const glm::dvec3&p) { return cloud(p / double(s)); });
  for (const Ray& ray : rays()) {
    const Ray scaled{ray.o * s, ray.d};
    const float whole = grid->column(ray, 0.25f, 6);
    EXPECT_EQ(small->column(scaled, 0.25f * s, 6 * s), whole * s);
    EXPECT_EQ(small->place_of(0.4f * whole * s, scaled, 0.25f * s, 6 * s),
              grid->place_of(0.4f * whole, ray, 0.25f, 6) * s);
  }
}

// Against delta tracking (Woodcock et al. 1965), which shares nothing with columns but the density at a
// place: the share that gets through, and where light is scattered.
TEST(DensityGrid, FreePathsAreThoseOfDeltaTracking) {
  constexpr int kPaths = 100'000;
  const auto grid = grid_of(kPoints, kLo, kHi, cloud);
  const Medium medium{Rgb(0), Rgb(0.8f), 0, grid};
  const Ray ray{{-2, -1, 1.2f}, glm::normalize(Vector3(1, 0.3f, 0.2f))};
  std::mt19937 random(2);
  std::uniform_real_distribution<double> u(0, 1);
  Mean passed, passed_tracked, place, place_tracked;
  for (int i = 0; i < kPaths; ++i) {
    FreePath way(Rgb(1), Point2(float(u(random)), std::min(float(u(random)), kOneMinusEpsilon)));
    const auto column = way.pass(medium, column_of(medium, ray, 0, 6));
    passed.add(column ? 0 : 1);
    if (column) place.add(double(place_of(*column, medium, ray, 0, 6)));
    const double most = 0.8 * double(grid->largest());
    double t = 0;
    do t -= std::log1p(-u(random)) / most;
    while (t < 6 && u(random) * double(grid->largest()) >= double(grid->at(ray.at(float(t)))));
    passed_tracked.add(t < 6 ? 0 : 1);
    if (t < 6) place_tracked.add(t);
  }
  EXPECT_NEAR(passed.mean, passed_tracked.mean,
              5 * std::hypot(passed.standard_error(), passed_tracked.standard_error()));
  EXPECT_NEAR(place.mean, place_tracked.mean,
              5 * std::hypot(place.standard_error(), place_tracked.standard_error()));
  EXPECT_GT(passed.mean, 0.05);
  EXPECT_LT(passed.mean, 0.95);
}

// Neither boxes that are too small for floats are placed, nor do columns beyond them leave the ray.
TEST(DensityGrid, RefusesWhatFloatsCannotHold) {
  EXPECT_TRUE(DensityGrid::can_place({100, 1, 1}, test::box_between({0, 0, 0}, {1e-30, 1, 1})));
  EXPECT_FALSE(DensityGrid::can_place({100, 1, 1}, test::box_between({0, 0, 0}, {2e-37, 1, 1})));
  const auto grid = grid_of({3, 3, 3}, glm::dvec3(-4), glm::dvec3(4), [](const glm::dvec3&) { return 3e38; });
  const Ray ray{{-9, 0, 0}, {1, 0, 0}};
  EXPECT_EQ(grid->column(ray, 0, 20), kInfinity);
  const float place = grid->place_of(kInfinity, ray, 0, 20);
  EXPECT_TRUE(place >= 5 && place <= 20);
  const Ray nowhere{{NAN, 0, 0}, {NAN, 1, 0}};
  EXPECT_FALSE(grid->column(nowhere, 0, 20) < 0);
}

// Extremes neither hang nor leave finite numbers.
TEST(DensityGrid, StandsExtremes) {
  for (const double size : {1e-15, 1.0, 1e15}) {
    const auto grid =
        grid_of({3, 1, 2}, glm::dvec3(-size), glm::dvec3(size), [](const glm::dvec3&) { return 1e10; });
    for (const Vector3& d : {Vector3(1, 0, 0), Vector3(0, -1, 0), glm::normalize(Vector3(1, 1e-30f, 1e-7f))})
      for (const float from : {0.0f, 1e-20f, 1e10f, 1e20f}) {
        const Ray ray{d * -from, d};
        const float column = grid->column(ray, 0, kInfinity);
        EXPECT_TRUE(column >= 0 && column < kInfinity) << size << " " << from;
        const float place = grid->place_of(0.5f * column, ray, 0, kInfinity);
        EXPECT_TRUE(place >= 0) << size << " " << from;
      }
  }
}

}  // namespace
}  // namespace kaustik
