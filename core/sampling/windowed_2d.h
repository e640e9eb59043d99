#pragma once
// Distributions over the unit square that can be sampled within a window.

#include <functional>
#include <optional>
#include <vector>

#include "core/math/vec.h"

namespace kaustik {

// A rectangle of the unit square.
struct Window {
  Point2 min{0}, max{1};
  bool contains(const Point2& p) const {
    return p.x >= min.x && p.x <= max.x && p.y >= min.y && p.y <= max.y;
  }
};

// A density on the unit square that is constant over the cells of a grid, and can be sampled within any
// window by means of a summed-area table (Bitterli et al. 2015, "Portal-Masked Environment Map Sampling";
// Pharr et al. 2023, section A.5.6).
class WindowedPiecewiseConstant2D {
 public:
  WindowedPiecewiseConstant2D() = default;
  // Calls weight(x, y), which must be finite and >= 0, once per cell, row by row. Takes 8 bytes per cell.
  WindowedPiecewiseConstant2D(int width, int height, const std::function<double(int x, int y)>& weight);

  struct Sample {
    Point2 p;
    float pdf;  // per unit area of the square
  };
  // u in [0, 1)^2. Returns nothing where the window holds no weight.
  std::optional<Sample> sample(const Window& window, const Point2& u) const;
  // Density of p; zero outside the window.
  float pdf(const Window& window, const Point2& p) const;

 private:
  double below(double x, double y) const;  // integral over [0, x] x [0, y]
  double within(double x0, double x1, double y0, double y1) const;
  double weight_at(const Point2& p) const;

  int width_ = 0, height_ = 0;
  std::vector<double> sums_;  // of all cells up to and including this one in x and in y
};

}  // namespace kaustik
