#include "apps/bench/scaling_figures.h"

#include <fmt/format.h>

#include <algorithm>

#include "apps/bench/bench_table.h"
#include "apps/settings/values.h"

namespace kaustik::app {

namespace {

using Points = std::vector<const BenchPoint*>;

constexpr double kWorthDrawing = 0.01;  // least share of the total time for a phase to be drawn

constexpr std::pair<Phase, std::string_view> kCurves[] = {{Phase::kTotal, "total"},
                                                          {Phase::kPhotonTrace, "photon trace"},
                                                          {Phase::kPhotonBuild, "photon map build"},
                                                          {Phase::kRender, "image"},
                                                          {Phase::kBvh, "BVH build"}};

bool worth_drawing(Phase phase, const Points& points) {
  return std::any_of(points.begin(), points.end(), [phase](const BenchPoint* p) {
    return (*p)[phase].median >= kWorthDrawing * (*p)[Phase::kTotal].median;
  });
}

std::vector<uint64_t> photon_counts(const BenchResult& result) {
  std::vector<uint64_t> counts;
  for (const BenchPoint& p : result.points)
    if (std::find(counts.begin(), counts.end(), p.photons) == counts.end()) counts.push_back(p.photons);
  return counts;
}

Points points_with(const BenchResult& result, uint64_t photons) {
  Points points;
  for (const BenchPoint& p : result.points)
    if (p.photons == photons) points.push_back(&p);
  return points;
}

// Sorts samples by x: runs may come in any order, but curves run from left to right.
void sort_samples(Chart& chart) {
  for (Curve& curve : chart.curves)
    std::sort(curve.samples.begin(), curve.samples.end(),
              [](const Sample& a, const Sample& b) { return a.x < b.x; });
}

// Shortens a long path to its end, which says most. Cuts between UTF-8 characters.
std::string shortened(const std::string& path) {
  constexpr size_t kLongest = 100;
  if (path.size() <= kLongest) return path;
  size_t begin = path.size() - kLongest;
  while (begin < path.size() && (path[begin] & 0xc0) == 0x80) ++begin;
  return "..." + path.substr(begin);
}

Chart new_chart(const BenchResult& result, std::string title) {
  Chart chart;
  chart.title = std::move(title);
  chart.subtitles = {
      shortened(result.scene), fmt::format("{}; kaustik {}", machine_line(result), result.version),
      fmt::format("median and range of {} run{}", result.repeat, result.repeat == 1 ? "" : "s")};
  return chart;
}

void set_thread_axis(const BenchResult& result, Chart& chart) {
  chart.x.label = "threads";
  for (const BenchPoint& p : result.points) chart.x.ticks.push_back(p.threads);
  std::sort(chart.x.ticks.begin(), chart.x.ticks.end());
  chart.x.ticks.erase(std::unique(chart.x.ticks.begin(), chart.x.ticks.end()), chart.x.ticks.end());
}

std::pair<int, int> thread_range(const Points& points) {
  const auto fewer = [](const BenchPoint* a, const BenchPoint* b) { return a->threads < b->threads; };
  const auto [least, most] = std::minmax_element(points.begin(), points.end(), fewer);
  return {(*least)->threads, (*most)->threads};
}

// All powers of two that can lie on the axis; if there are few of them, also 1.5 times each.
std::vector<double> doubling_ticks(const Points& points) {
  const auto [least, most] = thread_range(points);
  std::vector<double> ticks;
  for (double t = 1.0 / 65536; t <= 65536; t *= 2) {
    ticks.push_back(t);
    if (most < 8 * least) ticks.push_back(1.5 * t);
  }
  return ticks;
}

Figure speed_up_figure(const BenchResult& result, uint64_t photons) {
  const Points points = points_with(result, photons);
  const int base = baseline_of(result, *points.front()).threads;
  Chart chart = new_chart(result, fmt::format("Speed-up, {} photons", count_text(photons)));
  set_thread_axis(result, chart);
  chart.y = {fmt::format("speed-up over {} thread{}", base, base == 1 ? "" : "s"), doubling_ticks(points)};
  for (const auto& [phase, name] : kCurves) {
    if (!worth_drawing(phase, points)) continue;
    Curve curve{std::string(name), {}};
    for (const BenchPoint* p : points)
      if (const std::optional<Spread> gain = speed_up(result, *p, phase))
        curve.samples.push_back({double(p->threads), gain->median, gain->min, gain->max});
    chart.curves.push_back(std::move(curve));
  }
  const auto [least, most] = thread_range(points);
  chart.guides = {{double(least), double(least) / base, double(most), double(most) / base}};
  chart.guide_name = "ideal";
  sort_samples(chart);
  return {fmt::format("speed-up-{}.svg", count_text(photons)), std::move(chart)};
}

Figure photon_rate_figure(const BenchResult& result) {
  Chart chart = new_chart(result, "Photons traced per second");
  set_thread_axis(result, chart);
  chart.y.label = "photons per second";
  chart.guide_name = "ideal";
  for (const uint64_t photons : photon_counts(result)) {
    const Points points = points_with(result, photons);
    Curve curve{fmt::format("{} photons", count_text(photons)), {}};
    for (const BenchPoint* p : points) {
      const Spread& rate = (*p)[Rate::kPhotons];
      curve.samples.push_back({double(p->threads), rate.median, rate.min, rate.max});
    }
    const auto [least, most] = thread_range(points);
    const double per_thread = (*points.front())[Rate::kPhotons].median / points.front()->threads;
    chart.guides.push_back({double(least), least * per_thread, double(most), most * per_thread});
    chart.curves.push_back(std::move(curve));
  }
  sort_samples(chart);
  return {"photons-per-second.svg", std::move(chart)};
}

Figure photon_count_figure(const BenchResult& result) {
  int threads = 1;
  for (const BenchPoint& p : result.points) threads = std::max(threads, p.threads);
  Points points;
  for (const BenchPoint& p : result.points)
    if (p.threads == threads) points.push_back(&p);
  Chart chart =
      new_chart(result, fmt::format("Time over photons, {} thread{}", threads, threads == 1 ? "" : "s"));
  chart.x.label = "photons emitted";
  for (const uint64_t photons : photon_counts(result)) chart.x.ticks.push_back(double(photons));
  chart.y.label = "seconds";
  for (const auto& [phase, name] : kCurves) {
    if (!worth_drawing(phase, points)) continue;
    Curve curve{std::string(name), {}};
    for (const BenchPoint* p : points)
      curve.samples.push_back({double(p->photons), (*p)[phase].median, (*p)[phase].min, (*p)[phase].max});
    chart.curves.push_back(std::move(curve));
  }
  sort_samples(chart);
  for (const Curve& curve : chart.curves) {
    if (curve.name != "photon trace" || curve.samples.empty()) continue;
    const Sample &first = curve.samples.front(), &last = curve.samples.back();
    chart.guides = {{first.x, first.y, last.x, first.y * last.x / first.x}};
    chart.guide_name = "proportional";
  }
  return {"seconds-over-photons.svg", std::move(chart)};
}

}  // namespace

std::vector<Figure> scaling_figures(const BenchResult& result) {
  std::vector<Figure> figures;
  for (const uint64_t photons : photon_counts(result)) figures.push_back(speed_up_figure(result, photons));
  const bool any_photons = std::any_of(result.points.begin(), result.points.end(),
                                       [](const BenchPoint& p) { return p[Rate::kPhotons].median > 0; });
  if (any_photons) figures.push_back(photon_rate_figure(result));
  if (photon_counts(result).size() > 1) figures.push_back(photon_count_figure(result));
  return figures;
}

}  // namespace kaustik::app
