// The page of kaustik bench --plot, and the JSON file of --json.

#include <gmock/gmock.h>

#include "apps/bench/bench_json.h"
#include "apps/bench/bench_table.h"
#include "apps/html/html.h"
#include "apps/report/bench_report.h"

namespace kaustik::app {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

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
  PhaseSpan render{10, {}};
  render.places["render/tiles/tiles.cpp:270"] = {0.5, 9, 1.5, 64};
  r.spans = {{1000, {{"render", render}}}};
  return r;
}

TEST(BenchReport, HoldsEveryNumberAndNamesAreEscaped) {
  BenchResult result = some_result();
  result.scene = result.version = result.build = "</script><img src=x onerror=alert(1)>.pbrt";
  result.machine["cpu"] = result.scene;
  const std::string page = bench_report(result);
  EXPECT_THAT(page, Not(HasSubstr("<img src=x")));
  EXPECT_THAT(page, HasSubstr("&lt;img src=x"));
  EXPECT_THAT(page, HasSubstr(script_json(bench_json(result))));
  EXPECT_THAT(page, HasSubstr(html_escaped(bench_table(result))));
}

// (10 - 2) / p + 2 seconds on p cores.
TEST(BenchTable, SaysHowFarARenderScales) {
  const std::string table = bench_table(some_result());
  EXPECT_THAT(table, ::testing::ContainsRegex("image +10.000 s +5.00 % +15.00 % +2.5 +4.0 +4.7 +4.9"));
  EXPECT_THAT(table, HasSubstr("15.00 %  image: the longest of 64 tasks of render/tiles/tiles.cpp:270"));
  EXPECT_THAT(table, HasSubstr("5.00 %  image: in one thread before render/tiles/tiles.cpp:270"));
}

TEST(BenchJson, ReadsWhatItWrites) {
  const BenchResult r = some_result();
  const std::string text = bench_json(r);
  EXPECT_EQ(bench_json(bench_from_json(text)), text);
}

}  // namespace
}  // namespace kaustik::app
