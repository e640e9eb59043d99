#pragma once
// Distributions over the cells of a grid.

#include <cstdint>
#include <functional>
#include <vector>

#include "core/math/vec.h"

namespace kaustik {

// Samples the cells of a grid in proportion to non-negative weights, by inversion: first the row, then the
// column (Pharr et al. 2023, section A.5.3). Cumulative sums are rounded to multiples of 2^-24, as the random
// numbers are, so the stated probability of a cell is exactly that of choosing it. A row with less than 2^-24
// of the total, or a cell with less than 2^-24 of its row, may never be chosen.
class PiecewiseConstant2D {
 public:
  PiecewiseConstant2D() = default;
  // Calls weight(x, y) once per cell, row by row. All weights must be finite, and at least one above zero.
  // Takes 4 bytes per cell.
  PiecewiseConstant2D(int width, int height, const std::function<double(int x, int y)>& weight);

  struct Sample {
    int x, y;
    Point2 in_cell;     // what is left of the random numbers, again uniform in [0, 1)
    float probability;  // of the cell
  };
  // u in [0, 1)^2; u.x chooses the column, u.y the row.
  Sample sample(const Point2& u) const;
  float probability(int x, int y) const;
  double total() const { return total_; }  // sum of the weights
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
  // cumulative probabilities: of the rows, and of the columns within each row
  std::vector<float> rows_, columns_;
  double total_ = 0;
};

}  // namespace kaustik
