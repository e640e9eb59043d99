// The summed-area table, and its inversion within a window.

#include "core/sampling/windowed_2d.h"

namespace kaustik {
namespace {

// Position in [from, to] at which `integral`, a function that rises linearly between the edges of n cells,
// reaches `level`.
template <class F>
double inverse(const F& integral, double level, double from, double to, int n) {
  // Bisect over the cell edges in (from, to), then interpolate linearly within the cell.
  int low = static_cast<int>(from * n), high = static_cast<int>(std::ceil(to * n));
  const auto edge = [&](int i) { return std::clamp(static_cast<double>(i) / n, from, to); };
  while (high - low > 1) {
    const int middle = low + (high - low) / 2;
    (integral(edge(middle)) <= level ? low : high) = middle;
  }
  const double x0 = edge(low), x1 = edge(high), f0 = integral(x0), f1 = integral(x1);
  return f1 > f0 ? std::clamp(x0 + (x1 - x0) * (level - f0) / (f1 - f0), x0, x1) : x0;
}

}  // namespace

WindowedPiecewiseConstant2D::WindowedPiecewiseConstant2D(int width, int height,
                                                         const std::function<double(int x, int y)>& weight)
    : width_(width), height_(height), sums_(static_cast<size_t>(width) * static_cast<size_t>(height)) {
  const double cell = 1.0 / width / height;
  for (int y = 0; y < height; ++y) {
    double row = 0;
    for (int x = 0; x < width; ++x) {
      const size_t i = static_cast<size_t>(y) * static_cast<size_t>(width) + static_cast<size_t>(x);
      row += weight(x, y) * cell;
      sums_[i] = row + (y > 0 ? sums_[i - static_cast<size_t>(width)] : 0);
    }
  }
}

double WindowedPiecewiseConstant2D::below(double x, double y) const {
  // The integral is bilinear between the corners of the cells.
  const double at_x = x * width_, at_y = y * height_;
  const int i = std::clamp(static_cast<int>(at_x), 0, width_ - 1);
  const int j = std::clamp(static_cast<int>(at_y), 0, height_ - 1);
  const auto sum = [&](int a, int b) {
    return a == 0 || b == 0
               ? 0
               : sums_[static_cast<size_t>(b - 1) * static_cast<size_t>(width_) + static_cast<size_t>(a - 1)];
  };
  const double dx = at_x - i, dy = at_y - j;
  return (1 - dy) * ((1 - dx) * sum(i, j) + dx * sum(i + 1, j)) +
         dy * ((1 - dx) * sum(i, j + 1) + dx * sum(i + 1, j + 1));
}

double WindowedPiecewiseConstant2D::within(double x0, double x1, double y0, double y1) const {
  return std::max(0.0, below(x1, y1) - below(x0, y1) - (below(x1, y0) - below(x0, y0)));
}

double WindowedPiecewiseConstant2D::weight_at(const Point2& p) const {
  const int x = std::clamp(static_cast<int>(p.x * static_cast<float>(width_)), 0, width_ - 1);
  const int y = std::clamp(static_cast<int>(p.y * static_cast<float>(height_)), 0, height_ - 1);
  return within(double(x) / width_, double(x + 1) / width_, double(y) / height_, double(y + 1) / height_) *
         width_ * height_;
}

std::optional<WindowedPiecewiseConstant2D::Sample> WindowedPiecewiseConstant2D::sample(
    const Window& window, const Point2& u) const {
  const double x0 = double(window.min.x), x1 = double(window.max.x);
  const double y0 = double(window.min.y), y1 = double(window.max.y);
  const double total = within(x0, x1, y0, y1);
  if (!(total > 0)) return std::nullopt;
  const double x =
      inverse([&](double at) { return within(x0, at, y0, y1); }, double(u.x) * total, x0, x1, width_);
  // The part inside the window of the column of cells that contains x.
  const double column = std::min(std::floor(x * width_), double(width_ - 1));
  const double left = std::max(x0, column / width_), right = std::min(x1, (column + 1) / width_);
  const double of_column = within(left, right, y0, y1);
  if (!(of_column > 0)) return std::nullopt;
  const double y = inverse([&](double at) { return within(left, right, y0, at); }, double(u.y) * of_column,
                           y0, y1, height_);
  const Point2 p = glm::clamp(Point2(glm::dvec2(x, y)), window.min, window.max);
  const float density = static_cast<float>(weight_at(p) / total);
  return density > 0 ? std::optional(Sample{p, density}) : std::nullopt;
}

float WindowedPiecewiseConstant2D::pdf(const Window& window, const Point2& p) const {
  if (!window.contains(p)) return 0;
  const double total =
      within(double(window.min.x), double(window.max.x), double(window.min.y), double(window.max.y));
  return total > 0 ? static_cast<float>(weight_at(p) / total) : 0;
}

}  // namespace kaustik
