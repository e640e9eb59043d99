#pragma once
// Images over all directions, for environment maps and goniometric lights.

#include <memory>
#include <vector>

#include "core/light/image/light_image.h"
#include "core/sampling/piecewise_2d.h"

namespace kaustik {

// A colour for every direction, constant within each pixel of an image, with sampling of directions in
// proportion to luminance. The sampling is exact: a pixel is chosen by luminance times solid angle, and the
// direction is uniform within the pixel. Immutable; thread-safe.
//
// For shadow rays the light is divided into an even part, of at most the mean luminance, and the excess over
// it (after Karlik et al. 2019, "MIS Compensation").
class DirectionMap {
 public:
  enum class Layout {
    kEqualArea,  // octahedral, square (core/sampling/equal_area.h), as in pbrt-v4
    kLatLong     // row 0 around +z, column 0 from +x towards +y, as in pbrt-v3
  };
  enum class Excess { kLeftOut, kSampled };
  struct Sample {
    Vector3 w;  // unit
    Rgb value;
    float pdf;  // per solid angle
  };

  DirectionMap(std::shared_ptr<const LightImage> image, Layout layout, Excess excess = Excess::kLeftOut);

  // The colour in direction w (unit, in the map's space).
  Rgb value(const Vector3& w) const;
  // u in [0, 1)^2. For a map that is black everywhere, the direction is arbitrary and the value 0.
  Sample sample(const Point2& u) const;
  float pdf(const Vector3& w) const;

  // Share of the even part in the total luminance; 1 if the excess is left out.
  float even_share() const { return even_share_; }
  // Samples in proportion to the excess. Call it only if even_share() < 1.
  Vector3 sample_excess(const Point2& u) const;
  float excess_pdf(const Vector3& w) const;

  Rgb mean() const { return mean_; }            // over all directions
  Rgb brightest() const { return brightest_; }  // maximum per channel
  int rows() const { return image_->height; }
  // Irradiance of a surface facing +z: the integral of luminance times cosine over z > 0, if the values are
  // radiance.
  double irradiance() const;

 private:
  struct Pixel {
    int x, y;
  };
  Pixel pixel_of(const Vector3& w) const;
  Vector3 direction(const Pixel& pixel, const Point2& in_pixel) const;
  double solid_angle(int y) const;  // of a pixel in this row
  void make_excess();

  std::shared_ptr<const LightImage> image_;
  Layout layout_;
  PiecewiseConstant2D pixels_;
  PiecewiseConstant2D excess_;
  float even_share_ = 1;
  Rgb mean_{0}, brightest_{0};
};

}  // namespace kaustik
