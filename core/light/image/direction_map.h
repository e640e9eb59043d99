#pragma once
#include <memory>
#include <vector>

#include "core/light/image/light_image.h"
#include "core/sampling/piecewise_2d.h"

namespace kaustik {

// A colour for every direction, constant over the pixels of an image, and directions in proportion to its
// luminance. Exactly so: pixels are chosen by luminance times solid angle, and directions are uniform within
// a pixel. Immutable; thread-safe.
//
// For shadow rays the light is divided in two: what is even, the mean luminance at most, and the excess over
// it (after Karlik et al. 2019, "MIS Compensation").
class DirectionMap {
 public:
  enum class Layout {
    kEqualArea,  // octahedral, square (core/math/equal_area.h): pbrt-v4's
    kLatLong     // row 0 about +z, column 0 from +x towards +y: pbrt-v3's
  };
  enum class Excess { kLeftOut, kSampled };
  struct Sample {
    Vector3 w;  // unit
    Rgb value;
    float pdf;  // per solid angle
  };

  DirectionMap(std::shared_ptr<const LightImage> image, Layout layout, Excess excess = Excess::kLeftOut);

  // w unit, in the map's space.
  Rgb value(const Vector3& w) const;
  // u in [0, 1)^2. A map that is black everywhere gives some direction of value 0.
  Sample sample(const Point2& u) const;
  float pdf(const Vector3& w) const;

  // What is even, of all luminance; 1 where the excess is left out.
  float even_share() const { return even_share_; }
  // In proportion to the excess. Only where even_share() is below 1.
  Vector3 sample_excess(const Point2& u) const;
  float excess_pdf(const Vector3& w) const;

  Rgb mean() const { return mean_; }            // over all directions
  Rgb brightest() const { return brightest_; }  // per channel
  int rows() const { return image_->height; }
  // Of a surface that faces +z: the integral of luminance times cosine over z > 0, if values are radiance.
  double irradiance() const;

 private:
  struct Pixel {
    int x, y;
  };
  Pixel pixel_of(const Vector3& w) const;
  Vector3 direction(const Pixel& pixel, const Point2& in_pixel) const;
  double solid_angle(int y) const;  // of a pixel of this row
  void make_excess();

  std::shared_ptr<const LightImage> image_;
  Layout layout_;
  PiecewiseConstant2D pixels_;
  PiecewiseConstant2D excess_;
  float even_share_ = 1;
  Rgb mean_{0}, brightest_{0};
};

}  // namespace kaustik
