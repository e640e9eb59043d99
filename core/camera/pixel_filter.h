#pragma once
// Pixel filters: how a pixel weights the image around its centre. Samples are drawn in proportion to the
// filter's absolute value (Ernst et al. 2006, "Filter Importance Sampling"; Pharr et al. 2023, section
// 8.8.2), so each pixel has its own samples and all have the same absolute weight: +1, or -1 where the filter
// is negative.

#include <string_view>
#include <vector>

#include "core/math/vec.h"

namespace kaustik {

enum class FilterKind { kBox, kTriangle, kGaussian, kMitchell, kSinc };

// One axis of a separable filter, with pbrt's parameters. Distances are in pixels. Not normalised.
struct FilterAxis {
  FilterKind kind = FilterKind::kBox;
  float radius = 0.5f;
  float sigma = 0.5f;                   // gaussian: standard deviation
  float B = 1.0f / 3.0f, C = 1.0f / 3;  // mitchell (Mitchell and Netravali 1988)
  float tau = 3;                        // sinc: width of the Lanczos window

  double operator()(double x) const;  // zero beyond the radius
};

// Offset of a sample from the centre of the pixel, in pixels, and its weight: 1 or -1.
struct FilterSample {
  Point2 offset{0};
  int weight = 1;
};

class PixelFilter {
 public:
  PixelFilter() = default;  // a box of one pixel: the mean over the pixel's square
  PixelFilter(const FilterAxis& x, const FilterAxis& y);

  // u in [0, 1)^2. The density of offsets is |f| over its integral: exact for box and triangle, otherwise of
  // f held constant over each 1/32 of a pixel.
  FilterSample sample(const Point2& u) const;
  // Whether the filter is the mean over the pixel's own square, so that the offset is u - 1/2.
  bool is_pixel_box() const { return plain_; }
  bool is_negative() const { return mean_weight() < 1; }  // at some offsets
  // The integral of f over that of |f|, which is the mean weight of samples: 1 unless f is negative
  // somewhere. Filters for which it is not positive cannot be used.
  double mean_weight() const { return x_.mean_weight * y_.mean_weight; }

 private:
  struct Axis {
    FilterAxis axis;
    // Cumulative distribution of |f| at the ends of cells of equal width; empty where inverted in closed
    // form.
    std::vector<float> cdf;
    std::vector<int8_t> sign;
    double mean_weight = 1;

    explicit Axis(const FilterAxis& a = {});
    float sample(float u, int* weight) const;
  };
  Axis x_, y_;
  bool plain_ = true;
};

}  // namespace kaustik
