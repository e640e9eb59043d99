// Tests sums whose bits do not depend on order or split.

#include "render/film/exact_sum.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <random>
#include <vector>

#include "render/film/film_totals.h"

namespace kaustik::render {
namespace {

// Random terms with magnitudes over 40 binary orders and both signs.
std::vector<double> random_terms(size_t count, std::mt19937_64& random) {
  std::uniform_real_distribution<double> mantissa(-1, 1);
  std::uniform_int_distribution<int> exponent(-20, 20);
  std::vector<double> terms(count);
  for (double& t : terms) t = std::ldexp(mantissa(random), exponent(random));
  return terms;
}

TEST(ExactSum, AnyOrderAndAnySplitGiveTheSameBits) {
  std::mt19937_64 random(1);
  const double per_unit = 0x1p60;
  for (int round = 0; round < 100; ++round) {
    std::vector<double> terms = random_terms(1 + random() % 200, random);
    ExactSum forward;
    for (const double t : terms) EXPECT_TRUE(forward.add(t, per_unit));
    std::shuffle(terms.begin(), terms.end(), random);
    std::vector<ExactSum> parts(1 + random() % 7);
    for (const double t : terms) parts[random() % parts.size()].add(t, per_unit);
    std::shuffle(parts.begin(), parts.end(), random);
    ExactSum merged;
    for (const ExactSum& part : parts) merged += part;
    EXPECT_EQ(merged, forward);
  }
}

// Each term is rounded by at most half a unit, and the sum to a double.
TEST(ExactSum, EqualsTheSumUpToRounding) {
  std::mt19937_64 random(2);
  const std::vector<double> terms = random_terms(1000, random);
  ExactSum sum;
  long double expected = 0;
  for (const double t : terms) {
    sum.add(t, 0x1p60);
    expected += static_cast<long double>(t);
  }
  const double bound = 1000 * 0x1p-61 + std::abs(double(expected)) * 0x1p-53 + 1000 * 0x1p20 * 0x1p-64;
  EXPECT_NEAR(sum.value(0x1p-60), double(expected), bound);
  ExactSum whole;
  whole.add(3, 1);
  whole.add(-5, 1);
  EXPECT_EQ(whole.value(1), -2.0);
  ExactSum ties;  // are rounded to even
  ties.add(0.5, 1);
  ties.add(1.5, 1);
  EXPECT_EQ(ties.value(1), 2.0);
}

TEST(ExactSum, ClampsAndReportsIt) {
  ExactSum sum;
  EXPECT_TRUE(sum.add(0x1p95, 1));
  EXPECT_FALSE(sum.add(0x1p96, 1));
  EXPECT_EQ(sum.value(1), 0x1p96);
  EXPECT_FALSE(sum.add(-std::numeric_limits<double>::infinity(), 1));
  EXPECT_FALSE(sum.add(std::numeric_limits<double>::quiet_NaN(), 1));
  EXPECT_EQ(sum.value(1), 0x1p95);
}

FilmSums random_film(std::mt19937_64& random) {
  FilmSums film(3, 2, 1, 1, 8, 8);
  for (int y = 0; y < 2; ++y)
    for (int x = 0; x < 3; ++x) {
      const std::vector<double> v = random_terms(kSumChannels, random);
      PixelSum& p = film.at(x, y);
      for (const LayerRow& row : kLayerTable)
        for (size_t c = 0; row.summed() && c < row.channels.size(); ++c)
          row.in(p)[c] = v[sum_of(row.layer) + c];
      p.count = random() % 4;
    }
  return film;
}

bool same(const FilmTotals& a, const FilmTotals& b) {
  for (int y = 0; y < 2; ++y)
    for (int x = 0; x < 3; ++x)
      if (!(a.pixels().at(x, y) == b.pixels().at(x, y))) return false;
  return true;
}

TEST(FilmTotals, AnyOrderAndAnySplitGiveTheSameBits) {
  std::mt19937_64 random(3);
  const ExactUnits units{-70, -40, -70};
  for (int round = 0; round < 50; ++round) {
    std::vector<FilmSums> passes;
    for (int i = 0; i < 12; ++i) passes.push_back(random_film(random));
    FilmTotals forward(window_of<PixelTotals>(passes[0]), units);
    for (const FilmSums& pass : passes) EXPECT_EQ(forward.add(pass), 0u);
    std::shuffle(passes.begin(), passes.end(), random);
    std::vector<FilmTotals> parts(3, FilmTotals(window_of<PixelTotals>(passes[0]), units));
    for (const FilmSums& pass : passes) parts[random() % 3].add(pass);
    FilmTotals merged(window_of<PixelTotals>(passes[0]), units);
    for (const size_t i : {2, 0, 1}) merged.add(parts[i]);
    EXPECT_TRUE(same(forward, merged));
  }
}

// Means are over samples, squares over passes: a pass without a valid sample counts in neither.
TEST(FilmTotals, StoreMeansAndSquares) {
  FilmSums pass(1, 1);
  FilmTotals totals(window_of<PixelTotals>(pass), {-60, -60, -60});
  pass.at(0, 0).direct = {2, 4, 6};
  pass.at(0, 0).emitted = {0, 0, 2};
  pass.at(0, 0).count = 2;
  totals.add(pass);
  pass.clear();
  totals.add(pass);
  pass.at(0, 0).direct = {4, 4, 4};
  pass.at(0, 0).depth = 9;
  pass.at(0, 0).bias = {-3, 0, 0.5};
  pass.at(0, 0).count = 1;
  totals.add(pass);
  const PixelTotals& p = totals.pixels().at(0, 0);
  EXPECT_EQ(p.weight, 3);
  EXPECT_EQ(p.passes, 2u);
  EXPECT_EQ(totals.mean().at(0, 0).direct, Rgb(2, 8.0f / 3, 10.0f / 3));
  EXPECT_EQ(totals.mean().at(0, 0).depth, 3.0f);
  const double squares[3] = {1 + 16, 4 + 16, 16 + 16};
  for (size_t c = 0; c < 3; ++c) EXPECT_EQ(p.squares[c].value(0x1p-60), squares[c]);
  const double bias_squares[3] = {9, 0, 0.25};
  for (size_t c = 0; c < 3; ++c) EXPECT_EQ(p.bias_squares[c].value(0x1p-60), bias_squares[c]);
  EXPECT_EQ(p.sums[sum_of(Layer::kBias)].value(0x1p-60), -3);
}

TEST(FilmTotals, RefuseOtherWindowsAndUnits) {
  using Window = PixelWindow<PixelTotals>;
  FilmTotals a(Window(2, 2), {}), b(Window(2, 3), {}), c(Window(2, 2), {1, 0, 0});
  EXPECT_THROW(a.add(b), std::invalid_argument);
  EXPECT_THROW(a.add(c), std::invalid_argument);
  EXPECT_THROW(a.add(FilmSums(2, 2, 1, 0, 4, 4)), std::invalid_argument);
}

}  // namespace
}  // namespace kaustik::render
