#pragma once
// How a pixel weighs what lies around its middle. Samples are drawn in proportion to the filter's modulus
// (Ernst et al. 2006, "Filter Importance Sampling"; Pharr et al. 2023, section 8.8.2), so that each pixel has
// samples of its own and all of them count alike: +1, or -1 where the filter is negative.

#include <string_view>
#include <vector>

#include "core/math/vec.h"

namespace kaustik {

enum class FilterKind { kBox, kTriangle, kGaussian, kMitchell, kSinc };

// One axis of a filter that is the product of two; pbrt's parameters. Distances in pixels. Not normalised.
struct FilterAxis {
  FilterKind kind = FilterKind::kBox;
  float radius = 0.5f;
  float sigma = 0.5f;                   // gaussian: standard deviation
  float B = 1.0f / 3.0f, C = 1.0f / 3;  // mitchell (Mitchell and Netravali 1988)
  float tau = 3;                        // sinc: width of Lanczos' window

  double operator()(double x) const;  // zero beyond the radius
};

// Where a sample lies, in pixels from the pixel's middle, and its weight: 1 or -1.
struct FilterSample {
  Point2 offset{0};
  int weight = 1;
};

class PixelFilter {
 public:
  PixelFilter() = default;  // box of one pixel: the mean over the pixel's own square
  PixelFilter(const FilterAxis& x, const FilterAxis& y);

  // u in [0, 1)^2. The density of offsets is |f| over its integral: exactly for box and triangle, else of f
  // held constant over each 1/32 of a pixel.
  FilterSample sample(const Point2& u) const;
  // The mean over the pixel's own square: the offset is u - 1/2.
  bool is_pixel_box() const { return plain_; }
  bool is_negative() const { return mean_weight() < 1; }  // in places
  // The integral of f over that of |f|, the mean weight of samples: 1 unless f is negative in places; not
  // positive for filters that are of no use.
  double mean_weight() const { return x_.mean_weight * y_.mean_weight; }

 private:
  struct Axis {
    FilterAxis axis;
    std::vector<float>
        cdf;  // of |f|, at the ends of cells of equal width; empty where inverted in closed form
    std::vector<int8_t> sign;
    double mean_weight = 1;

    explicit Axis(const FilterAxis& a = {});
    float sample(float u, int* weight) const;
  };
  Axis x_, y_;
  bool plain_ = true;
};

}  // namespace kaustik
