#include "render/maps/disc_correction.h"

#include <algorithm>
#include <cmath>

namespace kaustik::render {

namespace {

// Limits of the factor. A disc with hardly any photons gives an arbitrary ratio.
constexpr double kLeastFactor = 0.25, kMostFactor = 4;

// A difference counts only if its square exceeds kDoubt times its variance. Ratios from few bright paths are
// skewed: with 1, the picture of a room lit through a gap became brighter by 6 %.
constexpr double kDoubt = 4;
constexpr uint32_t kFewestPoints = 8;  // whose spread is worth something
// The variance of a cell's estimates is that of its own points, or, if that is more, a weighted mean of it,
// whose weight is the cell's number of points, and of that of an average cell, whose weight this is. A cell
// of few points that met no bright path by chance has too small a variance of its own. The average cell's is
// too large for a bright cell of many points, since it counts dim points as much as bright ones.
constexpr double kAverageWeight = 1024;

// Mean of the squares of path - ratio disc in units of the disc's square, for each colour. Dim points count
// as bright ones do: there, few bright paths bring much of the light.
glm::dvec3 mean_relative_variance(const std::vector<TwoEstimates>& found, const PointSums& all) {
  const glm::dvec3 least = 0.1 * all.disc / double(all.count), ratio = all.ratio();
  glm::dvec3 sum(0);
  for (const TwoEstimates& e : found) {
    const glm::dvec3 relative = (e.path - ratio * e.disc) / glm::max(e.disc, least);
    sum += relative * relative;
  }
  return sum / double(found.size());
}

// Variance of a cell's ratio. relative_variance: of one point's estimate in units of the square of its disc,
// over all points.
glm::dvec3 variance_of_ratio(const PointSums& cell, const glm::dvec3& relative_variance) {
  const double count = cell.count;
  const glm::dvec3 own = cell.residual() * count / (count - 1),
                   average = relative_variance * cell.disc_squared;
  const glm::dvec3 mean = (count * own + kAverageWeight * average) / (count + kAverageWeight);
  return glm::max(own, mean) / (cell.disc * cell.disc);
}

// The ratios of a cell, each drawn towards `prior` by its noise.
glm::dvec3 shrunk_ratio(const PointSums& cell, const glm::dvec3& prior, const glm::dvec3& relative_variance) {
  if (cell.count < kFewestPoints) return prior;
  const glm::dvec3 variance = variance_of_ratio(cell, relative_variance);
  const glm::dvec3 difference = cell.ratio() - prior, squared = difference * difference;
  glm::dvec3 shrunk = prior;
  for (int k = 0; k < 3; ++k) {
    if (!(cell.disc[k] > 0 && squared[k] > kDoubt * variance[k])) continue;
    const double ratio = prior[k] + difference[k] * (1 - kDoubt * variance[k] / squared[k]);
    shrunk[k] = std::clamp(ratio, kLeastFactor, kMostFactor);
  }
  return shrunk;
}

}  // namespace

DiscCorrection::DiscCorrection(const std::vector<VisiblePoint>& points,
                               const std::vector<TwoEstimates>& found) {
  PointSums all;
  for (const TwoEstimates& e : found) all.add(e);
  if (all.disc == glm::dvec3(0)) return;
  const glm::dvec3 relative_variance = mean_relative_variance(found, all);
  const glm::dvec3 everywhere = shrunk_ratio(all, glm::dvec3(1), relative_variance);
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

// Sets the factors of a level, then scales those within each coarser cell so that together they give the
// light of its factor (up to the clamp), which rests on more points. Without that, noise would brighten the
// picture: a noisy difference passes the test more often if it is positive.
void DiscCorrection::refine(size_t level, const glm::dvec3& everywhere, const glm::dvec3& relative_variance,
                            std::unordered_map<uint64_t, Cell>* cells) {
  const auto factor_of_parent = [&](const Cell& cell) {
    return level > 0 ? glm::dvec3(factors_[level - 1].at(cell.parent)) : everywhere;
  };
  struct Light {
    glm::dvec3 wanted{0}, given{0};
  };
  std::unordered_map<uint64_t, Light> of_parent;
  for (auto& [key, cell] : *cells) {
    const glm::dvec3 prior = factor_of_parent(cell);
    cell.factor = shrunk_ratio(cell.sums, prior, relative_variance);
    Light& light = of_parent[cell.parent];
    light.wanted += prior * cell.sums.disc, light.given += cell.factor * cell.sums.disc;
  }
  for (const auto& [key, cell] : *cells) {
    const Light& light = of_parent[cell.parent];
    glm::dvec3 factor = cell.factor;
    for (int k = 0; k < 3; ++k)
      if (light.given[k] > 0) factor[k] *= light.wanted[k] / light.given[k];
    factors_[level].emplace(key, Rgb(glm::clamp(factor, kLeastFactor, kMostFactor)));
  }
}

Rgb DiscCorrection::at(const Point3& p, const Normal3& n) const {
  for (size_t level = kResolution.size(); level-- > 0;) {
    auto found = factors_[level].find(grids_[level].blurred_key(p, n));
    if (found == factors_[level].end()) found = factors_[level].find(grids_[level].key(p, n));
    if (found != factors_[level].end()) return found->second;
  }
  return Rgb(1);
}

}  // namespace kaustik::render
