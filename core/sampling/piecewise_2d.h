#pragma once
#include <cstdint>
#include <functional>
#include <vector>

#include "core/math/vec.h"

namespace kaustik {

// Sampling of the cells of a grid in proportion to non-negative weights, by inversion: the row, then the
// column (Pharr et al. 2023, section A.5.3). Cumulative sums are rounded to multiples of 2^-24, of which the
// random numbers are multiples too: so the probability that a cell states is exactly the one by which it is
// chosen. A cell of a share below 2^-24 of its row, or a row of such a share, may never be chosen.
class PiecewiseConstant2D {
 public:
  PiecewiseConstant2D() = default;
  // weight(x, y), called once a cell, row by row. Some must be above zero; all must be finite. 4 bytes a
  // cell.
  PiecewiseConstant2D(int width, int height, const std::function<double(int x, int y)>& weight);

  struct Sample {
    int x, y;
    Point2 in_cell;     // the random numbers, uniform again in [0, 1)
    float probability;  // of the cell
  };
  // u in [0, 1)^2; u.x chooses the column, u.y the row.
  Sample sample(const Point2& u) const;
  float probability(int x, int y) const;
  double total() const { return total_; }  // of the weights
  int width() const { return width_; }
  int height() const { return height_; }

 private:
  struct Choice {
    int index;
    float probability, u_remapped;
  };
  static Choice choose(const float* cdf, int count, float u);
  const float* row(int y) const { return columns_.data() + static_cast<size_t>(y) * width_; }

  int width_ = 0, height_ = 0;
  std::vector<float> rows_, columns_;  // cumulative probabilities, of each row in its place
  double total_ = 0;
};

}  // namespace kaustik
