#include "apps/bench/bench_result.h"

#include <algorithm>

namespace kaustik::app {

Spread spread_of(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const size_t n = values.size();
  return {(values[(n - 1) / 2] + values[n / 2]) / 2, values.front(), values.back()};
}

const BenchPoint& baseline_of(const BenchResult& result, const BenchPoint& point) {
  const auto same = [&](const BenchPoint& p) {
    return p.photons_per_thread == point.photons_per_thread &&
           (point.photons_per_thread > 0 || p.photons == point.photons);
  };
  const auto found = std::find_if(result.points.begin(), result.points.end(), same);
  return found != result.points.end() ? *found : point;
}

std::optional<Spread> speed_up(const BenchResult& result, const BenchPoint& point, Phase phase) {
  const BenchPoint& first = baseline_of(result, point);
  const double base = first[phase].median * (double(point.photons) / double(first.photons));
  const Spread& here = point[phase];
  if (!(base > 0) || !(here.min > 0)) return std::nullopt;
  return Spread{base / here.median, base / here.max, base / here.min};
}

std::optional<double> fitted_serial_share(const BenchResult& result, const BenchPoint& first, Phase phase) {
  // With x = 1 / n - 1, relative to the first point: t / t1 - 1 = (1 - s) x.
  double products = 0, squares = 0;
  for (const BenchPoint& point : result.points) {
    if (&baseline_of(result, point) != &first || !(point[phase].median > 0) || !(first[phase].median > 0))
      continue;
    const double x = double(first.threads) / point.threads - 1;
    products += x * (point[phase].median / first[phase].median - 1);
    squares += x * x;
  }
  if (!(squares > 0)) return std::nullopt;
  return std::clamp(1 - products / squares, 0.0, 1.0);
}

bool is_disturbed(const BenchResult& result) {
  return std::any_of(result.points.begin(), result.points.end(), [](const BenchPoint& point) {
    return point.waiting && point.waiting->median > kMostWaiting;
  });
}

std::optional<double> efficiency(const BenchResult& result, const BenchPoint& point, Phase phase) {
  const std::optional<Spread> gain = speed_up(result, point, phase);
  if (!gain) return std::nullopt;
  return gain->median * baseline_of(result, point).threads / point.threads;
}

}  // namespace kaustik::app
