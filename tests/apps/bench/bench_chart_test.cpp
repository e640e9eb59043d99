// The axes and the SVG of kaustik bench --plot.

#include <gmock/gmock.h>

#include "apps/bench/bench_json.h"
#include "apps/bench/log_axis.h"
#include "apps/bench/scaling_figures.h"

namespace kaustik::app {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

size_t occurrences(const std::string& text, const std::string& part) {
  size_t n = 0;
  for (size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++n;
  return n;
}

TEST(LogAxis, RatiosAreDistances) {
  const LogAxis axis(1, 64, 100, 500, {});
  // 1, 8, 64: equal steps. Positions come from a few logarithms of doubles, pixels are of order 100: 1e-9 is
  // far above their rounding and far below what can be drawn.
  EXPECT_NEAR(axis.pixel(8) - axis.pixel(1), axis.pixel(64) - axis.pixel(8), 1e-9);
  EXPECT_GT(axis.pixel(1), 100);
  EXPECT_LT(axis.pixel(64), 500);
}

// Wherever the range lies, and however narrow or wide it is: some ticks, not too many, all of them inside.
TEST(LogAxis, TicksAreAFewRoundNumbersInside) {
  for (double least = 1e-9; least < 1e12; least *= 3.7) {
    for (const double factor : {1.0, 1.1, 2.0, 5.0, 60.0, 1e4, 1e11}) {
      const LogAxis axis(least, least * factor, 0, 1, {});
      EXPECT_GE(axis.ticks().size(), 2u) << least << " " << factor;
      EXPECT_LE(axis.ticks().size(), 8u) << least << " " << factor;
      for (const double tick : axis.ticks()) {
        EXPECT_GE(axis.pixel(tick), 0);
        EXPECT_LE(axis.pixel(tick), 1);
        EXPECT_LE(tick_text(tick).size(), 7u) << tick;  // at most "1.2e-05", "0.00015"
      }
    }
  }
}

TEST(LogAxis, TicksReadAsPeopleWriteThem) {
  EXPECT_EQ(tick_text(1500000), "1.5M");
  EXPECT_EQ(tick_text(2e9), "2G");
  EXPECT_EQ(tick_text(0.05), "0.05");
  EXPECT_EQ(tick_text(1), "1");
}

BenchPoint point(uint64_t photons, int threads, double seconds) {
  BenchPoint p;
  p.photons = photons;
  p.threads = threads;
  p.seconds.fill({seconds, seconds, 1.5 * seconds});
  p.seconds[static_cast<size_t>(Phase::kBvh)] = {};
  p.per_second.fill({1 / seconds, 0.6 / seconds, 1 / seconds});
  return p;
}

BenchResult some_result() {
  BenchResult r;
  r.scene = "a<b>&c.pbrt";
  r.points = {point(1000, 1, 4), point(1000, 2, 2), point(2000, 1, 8), point(2000, 2, 4)};
  return r;
}

TEST(ScalingFigures, EveryCurveIsDrawnAndNamed) {
  const std::vector<Figure> figures = scaling_figures(some_result());
  ASSERT_EQ(figures.size(), 4u);
  for (const Figure& figure : figures) {
    const std::string svg = draw_svg(figure.chart);
    EXPECT_EQ(occurrences(svg, "<polyline "), figure.chart.curves.size()) << figure.file_name;
    for (const Curve& curve : figure.chart.curves) EXPECT_THAT(svg, HasSubstr(">" + curve.name + "<"));
    EXPECT_THAT(svg, HasSubstr(">" + figure.chart.x.label + "<"));
    EXPECT_THAT(svg, HasSubstr(">" + figure.chart.y.label + "<"));
    EXPECT_THAT(svg, HasSubstr("class=\"guide\""));
    EXPECT_THAT(svg, HasSubstr("a&lt;b&gt;&amp;c.pbrt"));
    EXPECT_THAT(svg, Not(HasSubstr("nan")));
    EXPECT_THAT(svg, Not(HasSubstr("inf")));
  }
}

// Times that halve with twice the threads lie on the ideal line.
TEST(ScalingFigures, TheIdealLineIsLinearInThreads) {
  const Chart chart = scaling_figures(some_result()).front().chart;
  ASSERT_EQ(chart.guides.size(), 1u);
  for (const Curve& curve : chart.curves) {
    ASSERT_EQ(curve.samples.size(), 2u) << curve.name;
    EXPECT_EQ(curve.samples.back().x, chart.guides[0].x1);
    EXPECT_EQ(curve.samples.back().y, chart.guides[0].y1);
  }
  EXPECT_EQ(chart.guides[0].y1, 2);
}

TEST(ScalingFigures, PhasesThatTakeNoTimeAreLeftOut) {
  for (const Figure& figure : scaling_figures(some_result()))
    for (const Curve& curve : figure.chart.curves) EXPECT_NE(curve.name, "BVH build");
}

// One point, no photons, values that no axis can show: still a picture, in bounded time.
TEST(ScalingFigures, DegenerateResultsAreDrawn) {
  BenchResult one;
  one.points = {point(1000, 1, 4)};
  one.points[0].per_second.fill({});
  EXPECT_EQ(scaling_figures(one).size(), 1u);
  BenchResult extreme;
  extreme.points = {point(1, 1, 1e308), point(1, 65535, 5e-324), point(uint64_t(-1), 3, 1e-300)};
  BenchResult nothing;
  nothing.points = {BenchPoint{}};
  for (const BenchResult& r : {one, extreme, nothing}) {
    for (const Figure& figure : scaling_figures(r)) {
      const std::string svg = draw_svg(figure.chart);
      EXPECT_THAT(svg, Not(HasSubstr("nan"))) << figure.file_name;
      EXPECT_THAT(svg, Not(HasSubstr("inf"))) << figure.file_name;
    }
  }
}

TEST(BenchJson, ReadsWhatItWrites) {
  const BenchResult r = some_result();
  const std::string text = bench_json(r);
  EXPECT_EQ(bench_json(bench_from_json(text)), text);
}

}  // namespace
}  // namespace kaustik::app
