// Builds and inverts the cumulative sums of rows and columns.

#include "core/sampling/piecewise_2d.h"

namespace kaustik {
namespace {

// Writes the cumulative probabilities of the weights to cdf and returns the sum of the weights. If all are
// zero the distribution is uniform; any would do, as such a row is never chosen.
double accumulate(const std::vector<double>& weights, float* cdf) {
  double total = 0;
  for (const double w : weights) total += w;
  const double n = static_cast<double>(weights.size());
  double sum = 0;
  for (size_t i = 0; i < weights.size(); ++i) {
    sum += weights[i];
    const double share = total > 0 ? std::min(1.0, sum / total) : static_cast<double>(i + 1) / n;
    cdf[i] = static_cast<float>(std::round(share * 0x1p24) * 0x1p-24);
  }
  cdf[weights.size() - 1] = 1;
  return total;
}

}  // namespace

PiecewiseConstant2D::PiecewiseConstant2D(int width, int height,
                                         const std::function<double(int x, int y)>& weight)
    : width_(width),
      height_(height),
      rows_(static_cast<size_t>(height)),
      columns_(static_cast<size_t>(width) * static_cast<size_t>(height)) {
  std::vector<double> of_row(static_cast<size_t>(width)), of_rows(static_cast<size_t>(height));
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) of_row[static_cast<size_t>(x)] = weight(x, y);
    of_rows[static_cast<size_t>(y)] =
        accumulate(of_row, columns_.data() + static_cast<size_t>(y) * static_cast<size_t>(width));
  }
  total_ = accumulate(of_rows, rows_.data());
}

PiecewiseConstant2D::Choice PiecewiseConstant2D::choose(const float* cdf, int count, float u) {
  const auto i = std::upper_bound(cdf, cdf + count, u) - cdf;  // the last entry is 1, which is above any u
  const float low = i > 0 ? cdf[i - 1] : 0;
  const float width = cdf[i] - low;
  return {static_cast<int>(i), width, std::min((u - low) / width, kOneMinusEpsilon)};
}

PiecewiseConstant2D::Sample PiecewiseConstant2D::sample(const Point2& u) const {
  const Choice y = choose(rows_.data(), height_, u.y);
  const Choice x = choose(row(y.index), width_, u.x);
  return {x.index, y.index, {x.u_remapped, y.u_remapped}, x.probability * y.probability};
}

float PiecewiseConstant2D::probability(int x, int y) const {
  const float* columns = row(y);
  return (rows_[static_cast<size_t>(y)] - (y > 0 ? rows_[static_cast<size_t>(y - 1)] : 0)) *
         (columns[x] - (x > 0 ? columns[x - 1] : 0));
}

}  // namespace kaustik
