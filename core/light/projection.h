#pragma once
#include <memory>

#include "core/light/image/light_image.h"
#include "core/light/light_types.h"
#include "core/sampling/piecewise_2d.h"

namespace kaustik {

// The image of a projector, before it: on the plane z = 1, |x| <= half.x, |y| <= half.y, row 0 at +y, column
// 0 at -x. Directions in proportion to luminance. Immutable; thread-safe.
class ProjectedImage {
 public:
  struct Sample {
    Vector3 w;  // unit
    Rgb value;
    float pdf;  // per solid angle
  };

  // fov: full angle of the shorter side, degrees.
  ProjectedImage(std::shared_ptr<const LightImage> image, double fov);

  // w need not be unit; black beside the image.
  Rgb value(const Vector3& w) const;
  Sample sample(const Point2& u) const;
  Rgb integral() const { return integral_; }    // of value over solid angle
  Rgb brightest() const { return brightest_; }  // per channel
  float least_cosine() const;                   // of a direction within the image to +z

 private:
  std::shared_ptr<const LightImage> image_;
  Point2 half_{1};
  int per_pixel_ = 1;  // cells along a pixel, so that an image of few pixels follows the solid angle too
  PiecewiseConstant2D cells_;
  Rgb integral_{0}, brightest_{0};
};

// A projector: the intensity (W/sr) in a direction is that of its image.
struct ProjectionLight {
  static constexpr bool kDelta = true;
  static constexpr std::string_view kName = "projection";

  Point3 position{0};
  glm::mat3 to_world{1};  // orthogonal: z is the axis
  std::shared_ptr<const ProjectedImage> image;
  float scale = 1;

  // w unit, from the light.
  Rgb intensity(const Vector3& w) const { return scale * image->value(w * to_world); }
  std::optional<LightSample> sample_Li(const Point3& ref, const Point2& u) const;
  std::optional<EmissionSample> sample_Le(const Point2& u_pos, const Point2& u_dir, EmissionMode mode) const;
  Rgb power() const { return scale * image->integral(); }
};

}  // namespace kaustik
