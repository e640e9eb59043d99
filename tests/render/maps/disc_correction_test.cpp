// Tests the correction of discs on a square of points whose two estimates are known.

#include "render/maps/disc_correction.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace kaustik::render {
namespace {

constexpr int kSide = 96;  // points along each side of the unit square

std::vector<VisiblePoint> points_of_square(float scale = 1) {
  std::vector<VisiblePoint> points;
  for (int i = 0; i < kSide * kSide; ++i) {
    VisiblePoint point;
    point.query.p = scale * Point3((float(i % kSide) + 0.5f) / kSide, 0, (float(i / kSide) + 0.5f) / kSide);
    point.query.n = {0, 1, 0};
    points.push_back(point);
  }
  return points;
}

// ratio(p): what paths find, of a disc that finds 1; noise: standard deviation of one point's paths.
template <class Fn>
std::vector<TwoEstimates> estimates(const Fn& ratio, double noise) {
  std::mt19937_64 random(3);
  std::normal_distribution<double> deviation(0, noise);
  std::vector<TwoEstimates> found;
  for (const VisiblePoint& point : points_of_square())
    found.push_back({glm::dvec3(1), glm::dvec3(ratio(point.query.p) + deviation(random))});
  return found;
}

const Normal3 kUp(0, 1, 0);

double mean_factor(const DiscCorrection& correction, float x0, float x1) {
  double sum = 0;
  int count = 0;
  for (const VisiblePoint& point : points_of_square())
    if (point.query.p.x >= x0 && point.query.p.x < x1)
      sum += double(correction.at(point.query.p, kUp).x), ++count;
  return sum / count;
}

// What differs by less than twice its standard error is taken for noise. Of normal deviations 1 in 22 exceeds
// that, by 0.4 standard errors on average, of which the estimator keeps a third; the finest cells of 8 points
// and more have standard errors below 1/sqrt(8).
TEST(DiscCorrection, NoiseAloneChangesLittle) {
  const DiscCorrection correction(points_of_square(), estimates([](const Point3&) { return 1.0; }, 1));
  double changed = 0;
  for (const VisiblePoint& point : points_of_square())
    changed += std::abs(double(correction.at(point.query.p, kUp).x) - 1) / (kSide * kSide);
  EXPECT_LT(changed, 4 * (1 / 22.0) * 0.4 / std::sqrt(8.0));  // four grids
  EXPECT_NEAR(mean_factor(correction, 0, 1), 1, 4.0 / kSide);
}

// One half of the square is too dark, the other too bright. The standard error of a quarter's mean, of 24 x
// 96 points, is 0.02; a grid's factors keep 1 - 4 variance / difference^2 of each difference.
TEST(DiscCorrection, FindsWhatDiffersByPlace) {
  const auto ratio = [](const Point3& p) { return p.x < 0.5f ? 1.5 : 0.7; };
  const DiscCorrection correction(points_of_square(), estimates(ratio, 1));
  const double error = 1 / std::sqrt(24.0 * 96), kept = 4 * error * error / 0.3;
  EXPECT_NEAR(mean_factor(correction, 0, 0.25f), 1.5, 4 * error + kept);
  EXPECT_NEAR(mean_factor(correction, 0.75f, 1), 0.7, 4 * error + kept);
}

// Without noise the light of the whole is that of the paths, however it is distributed.
TEST(DiscCorrection, KeepsTheLightOfThePaths) {
  const auto ratio = [](const Point3& p) { return 1.2 + 0.3 * std::sin(40 * double(p.x)) * double(p.z); };
  const auto found = estimates(ratio, 0);
  double wanted = 0;
  for (const TwoEstimates& e : found) wanted += e.path.x / double(found.size());
  const DiscCorrection correction(points_of_square(), found);
  // The borders of cells are blurred, which mixes neighbours; the least cell is 1/72 wide.
  EXPECT_NEAR(mean_factor(correction, 0, 1), wanted, 0.3 / 72 + 4 * 0.3 * 0.3 / 0.2 / (kSide * kSide));
}

// What all points together tell is not lost in the relative noise of dim ones. Every second disc is a
// twentieth of the others, with paths as noisy. The variance of the ratio is 0.0004 by its own 9,216 points
// and 0.036 by the average cell, which counts as 1,024: 0.0039. Four times that over the difference, 0.4, is
// lost.
TEST(DiscCorrection, DimPointsDoNotHideWhatIsWrongEverywhere) {
  auto found = estimates([](const Point3&) { return 0.0; }, 1);
  PointSums all;
  for (size_t i = 0; i < found.size(); ++i) {
    found[i].disc = glm::dvec3(i % 2 == 0 ? 1 : 0.05);
    found[i].path += 1.4 * found[i].disc;
    all.add(found[i]);
  }
  const std::vector<VisiblePoint> points = points_of_square();
  const DiscCorrection correction(points, found);
  double corrected = 0;
  for (size_t i = 0; i < found.size(); ++i)
    corrected += found[i].disc.x * double(correction.at(points[i].query.p, kUp).x);
  EXPECT_NEAR(corrected / all.disc.x, all.ratio().x, 0.05);
}

// A bright path in a cell of few points makes the spread of the cell as large as the difference, however
// small the spread of all other cells is: the ratio is not believed, and no square shows.
TEST(DiscCorrection, OneBrightPathMakesNoSquare) {
  auto found = estimates([](const Point3&) { return 1.0; }, 0.1);
  const size_t bright = kSide * (kSide / 2) + kSide / 3;
  const std::vector<VisiblePoint> points = points_of_square();
  for (const double path : {4.0, 20.0, 100.0}) {
    found[bright].path = glm::dvec3(path);
    const DiscCorrection correction(points, found);
    for (const VisiblePoint& point : points)
      ASSERT_NEAR(correction.at(point.query.p, kUp).x, 1, 4 * 0.1) << path;  // as far as noise may change it
  }
}

// A disc that takes red light from elsewhere gets that colour's factor alone.
TEST(DiscCorrection, CorrectsEachColourByItself) {
  std::vector<TwoEstimates> found(points_of_square().size());
  for (TwoEstimates& e : found) e = {glm::dvec3(2, 1, 1), glm::dvec3(1, 1, 1.5)};
  const Rgb factor = DiscCorrection(points_of_square(), found).at({0.3f, 0, 0.6f}, kUp);
  EXPECT_NEAR(factor.x, 0.5f, 1e-6f);
  EXPECT_EQ(factor.y, 1);
  EXPECT_NEAR(factor.z, 1.5f, 1e-6f);
}

TEST(DiscCorrection, IsOneWhereNothingIsKnown) {
  const DiscCorrection none({}, {});
  EXPECT_EQ(none.at({0, 0, 0}, kUp), Rgb(1));
  const std::vector<TwoEstimates> dark(points_of_square().size());
  EXPECT_EQ(DiscCorrection(points_of_square(), dark).at({0.5f, 0, 0.5f}, kUp), Rgb(1));
}

TEST(DiscCorrection, ScalesByPowersOfTwo) {
  const auto found = estimates([](const Point3& p) { return p.z < 0.3f ? 2.0 : 0.5; }, 0.3);
  const DiscCorrection one(points_of_square(), found);
  for (const int k : {-20, 15}) {
    const float scale = std::ldexp(1.0f, k);
    const DiscCorrection scaled(points_of_square(scale), found);
    for (int i = 0; i < 50; ++i) {
      const Point3 p(0.019f * float(i), 0, 0.97f - 0.017f * float(i));
      EXPECT_EQ(scaled.at(scale * p, kUp), one.at(p, kUp));
    }
  }
}

}  // namespace
}  // namespace kaustik::render
