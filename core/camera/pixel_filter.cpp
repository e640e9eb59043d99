// The functions of the pixel filters, and their sampling.

#include "core/camera/pixel_filter.h"

#include <algorithm>
#include <cmath>

namespace kaustik {
namespace {

constexpr double kCellsPerPixel = 32;

double normal_density(double x, double sigma) {
  return std::exp(-x * x / (2 * sigma * sigma)) / std::sqrt(2 * std::numbers::pi * sigma * sigma);
}

// The Mitchell filter (Mitchell and Netravali 1988, equation 8), for x >= 0.
double mitchell(double x, double B, double C) {
  if (x <= 1) return ((12 - 9 * B - 6 * C) * x * x * x + (-18 + 12 * B + 6 * C) * x * x + (6 - 2 * B)) / 6;
  if (x > 2) return 0;
  return ((-B - 6 * C) * x * x * x + (6 * B + 30 * C) * x * x + (-12 * B - 48 * C) * x + (8 * B + 24 * C)) /
         6;
}

double sinc(double x) {
  const double a = std::numbers::pi * x;
  return std::abs(a) < 1e-8 ? 1 : std::sin(a) / a;
}

// Inverse of the cumulative distribution of the tent on [-1, 1].
float sample_tent(float u) {
  return u < 0.5f ? std::sqrt(2 * u) - 1 : 1 - std::sqrt(2 * (1 - u));
}

}  // namespace

double FilterAxis::operator()(double x) const {
  const double a = std::abs(x), r = radius;
  if (a > r) return 0;
  switch (kind) {
    case FilterKind::kBox:
      return 1;
    case FilterKind::kTriangle:
      return r - a;
    case FilterKind::kGaussian:
      return std::max(0.0, normal_density(a, sigma) - normal_density(r, sigma));
    case FilterKind::kMitchell:
      return mitchell(2 * a / r, B, C);
    case FilterKind::kSinc:
      return sinc(a) * sinc(a / tau);
  }
  return 0;
}

PixelFilter::Axis::Axis(const FilterAxis& a) : axis(a) {
  if (a.kind == FilterKind::kBox || a.kind == FilterKind::kTriangle) return;
  const auto cells = static_cast<size_t>(std::clamp(std::ceil(2 * a.radius * kCellsPerPixel), 64.0, 65536.0));
  std::vector<double> sums(cells + 1, 0.0);
  sign.resize(cells);
  double integral = 0;
  for (size_t i = 0; i < cells; ++i) {
    const double f = a((2 * (static_cast<double>(i) + 0.5) / static_cast<double>(cells) - 1) * a.radius);
    sums[i + 1] = sums[i] + std::abs(f);
    sign[i] = f < 0 ? -1 : 1;
    integral += f;
  }
  mean_weight = sums[cells] > 0 && std::isfinite(sums[cells]) ? integral / sums[cells] : 0;
  cdf.resize(cells + 1);
  for (size_t i = 0; i <= cells; ++i) cdf[i] = static_cast<float>(sums[i] / sums[cells]);
}

float PixelFilter::Axis::sample(float u, int* weight) const {
  if (axis.kind == FilterKind::kBox) return axis.radius * (2 * u - 1);
  if (axis.kind == FilterKind::kTriangle) return axis.radius * sample_tent(u);
  // Finds the cell with cdf[i] <= u < cdf[i + 1], so cells of weight zero are never chosen.
  const auto above = std::upper_bound(cdf.begin() + 1, cdf.end() - 1, u);
  const size_t i = static_cast<size_t>(above - cdf.begin()) - 1;
  if (sign[i] < 0) *weight = -*weight;
  const float within = (u - cdf[i]) / (cdf[i + 1] - cdf[i]);
  return axis.radius *
         (2 * (static_cast<float>(i) + std::clamp(within, 0.0f, 1.0f)) / float(sign.size()) - 1);
}

PixelFilter::PixelFilter(const FilterAxis& x, const FilterAxis& y) : x_(x), y_(y) {
  const auto is_plain = [](const FilterAxis& a) { return a.kind == FilterKind::kBox && a.radius == 0.5f; };
  plain_ = is_plain(x) && is_plain(y);
}

FilterSample PixelFilter::sample(const Point2& u) const {
  FilterSample s;
  s.offset.x = x_.sample(u.x, &s.weight);
  s.offset.y = y_.sample(u.y, &s.weight);
  return s;
}

}  // namespace kaustik
