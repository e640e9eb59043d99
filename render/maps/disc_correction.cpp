#include "render/maps/disc_correction.h"

#include <algorithm>
#include <cmath>

namespace kaustik::render {

namespace {

// Limits of the factor: a disc that hardly meets a photon says nothing.
constexpr double kLeastFactor = 0.25, kMostFactor = 4;

// How many times its variance the square of a difference must be to count. Few bright paths make ratios skew:
// with 1 the picture of a room lit through a gap became brighter by 6 %.
constexpr double kDoubt = 4;
constexpr uint32_t kFewestPoints = 8;  // whose spread is worth something

// Mean of the squares of path - ratio disc in units of the disc's square. Dim points count as bright ones do:
// there, few bright paths bring much of the light.
double mean_relative_variance(const std::vector<TwoEstimates>& found, const PointSums& all) {
  const double least = 0.1 * all.disc / all.count, ratio = all.ratio();
  double sum = 0;
  for (const TwoEstimates& e : found) {
    const double relative = (e.path - ratio * e.disc) / std::max(e.disc, least);
    sum += relative * relative;
  }
  return sum / double(found.size());
}

// The ratio of a cell, drawn towards `prior` by its noise. relative_variance: of one point's estimate in
// units of the square of its disc, over all points; a cell that met no bright path by chance has too little
// of its own.
double shrunk_ratio(const PointSums& cell, double prior, double relative_variance) {
  if (!(cell.disc > 0) || cell.count < kFewestPoints) return prior;
  const double own = cell.residual() * cell.count / (cell.count - 1.0);
  const double variance = std::max(own, relative_variance * cell.disc_squared) / (cell.disc * cell.disc);
  const double difference = cell.ratio() - prior, squared = difference * difference;
  if (!(squared > kDoubt * variance)) return prior;
  return std::clamp(prior + difference * (1 - kDoubt * variance / squared), kLeastFactor, kMostFactor);
}

}  // namespace

DiscCorrection::DiscCorrection(const std::vector<VisiblePoint>& points,
                               const std::vector<TwoEstimates>& found) {
  PointSums all;
  for (const TwoEstimates& e : found) all.add(e);
  if (!(all.disc > 0)) return;
  const double relative_variance = mean_relative_variance(found, all);
  const double everywhere = shrunk_ratio(all, 1, relative_variance);
  for (size_t level = 0; level < kResolution.size(); ++level) {
    grids_[level] = {points, kResolution[level]};
    const auto key = [&](size_t of_level, size_t point) {
      return grids_[of_level].key(points[point].query.p, points[point].query.n);
    };
    std::unordered_map<uint64_t, Cell> cells;
    for (size_t i = 0; i < points.size(); ++i) {
      Cell& cell = cells[key(level, i)];
      cell.sums.add(found[i]);
      cell.parent = level > 0 ? key(level - 1, i) : 0;
    }
    refine(level, everywhere, relative_variance, &cells);
  }
}

// Sets the factors of a level. Those of the cells within a coarser one give the light that its factor gives,
// for that is known best: noise that passes for a difference is positive more often than negative.
void DiscCorrection::refine(size_t level, double everywhere, double relative_variance,
                            std::unordered_map<uint64_t, Cell>* cells) {
  const auto factor_of_parent = [&](const Cell& cell) {
    return level > 0 ? double(factors_[level - 1].at(cell.parent)) : everywhere;
  };
  struct Light {
    double wanted = 0, given = 0;
  };
  std::unordered_map<uint64_t, Light> of_parent;
  for (auto& [key, cell] : *cells) {
    const double prior = factor_of_parent(cell);
    cell.factor = shrunk_ratio(cell.sums, prior, relative_variance);
    Light& light = of_parent[cell.parent];
    light.wanted += prior * cell.sums.disc, light.given += cell.factor * cell.sums.disc;
  }
  for (const auto& [key, cell] : *cells) {
    const Light& light = of_parent[cell.parent];
    const double scale = light.given > 0 ? light.wanted / light.given : 1;
    factors_[level].emplace(key, float(std::clamp(scale * cell.factor, kLeastFactor, kMostFactor)));
  }
}

float DiscCorrection::at(const Point3& p, const Normal3& n) const {
  for (size_t level = kResolution.size(); level-- > 0;) {
    auto found = factors_[level].find(grids_[level].blurred_key(p, n));
    if (found == factors_[level].end()) found = factors_[level].find(grids_[level].key(p, n));
    if (found != factors_[level].end()) return found->second;
  }
  return 1;
}

}  // namespace kaustik::render
