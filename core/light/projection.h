#pragma once
// Projectors: point lights that emit through an image.

#include <memory>

#include "core/light/image/light_image.h"
#include "core/light/interface/light_bounds.h"
#include "core/sampling/piecewise_2d.h"

namespace kaustik {

// The image of a projector, on the plane z = 1 with |x| <= half.x and |y| <= half.y; row 0 is at +y, column 0
// at -x. Samples directions in proportion to luminance. Immutable; thread-safe.
class ProjectedImage {
 public:
  struct Sample {
    Vector3 w;  // unit
    Rgb value;
    float pdf;  // per solid angle
  };

  // fov: full angle of the shorter side, in degrees.
  ProjectedImage(std::shared_ptr<const LightImage> image, double fov);

  // The image's value in direction w, which need not be unit; black outside the image.
  Rgb value(const Vector3& w) const;
  Sample sample(const Point2& u) const;
  Rgb integral() const { return integral_; }    // integral of the value over solid angle
  Rgb brightest() const { return brightest_; }  // maximum per channel
  // the smallest cosine between +z and a direction within the image
  float least_cosine() const;

 private:
  std::shared_ptr<const LightImage> image_;
  Point2 half_{1};
  // cells per pixel and axis, so that sampling follows the solid angle even in images of few pixels
  int per_pixel_ = 1;
  PiecewiseConstant2D cells_;
  Rgb integral_{0}, brightest_{0};
};

// A projector: its image gives the radiant intensity (W/sr) in each direction.
struct ProjectionLight {
  static constexpr std::string_view kName = "projection";

  Point3 position{0};
  glm::mat3 to_world{1};  // orthogonal; z is the axis
  std::shared_ptr<const ProjectedImage> image;
  float scale = 1;

  static constexpr bool is_delta() { return true; }
  // Radiant intensity in direction w (unit, away from the light).
  Rgb intensity(const Vector3& w) const { return scale * image->value(w * to_world); }
  std::optional<LightSample> sample_Li(const Point3& ref, const Point2& u) const;
  std::optional<EmissionSample> sample_Le(const Point2& u_pos, const Point2& u_dir, EmissionMode mode) const;
  Rgb power() const { return scale * image->integral(); }
  std::optional<LightBounds> bounds() const;
  double brightness(double scene_size) const {
    return point_light_brightness(scale * image->brightest(), scene_size);
  }
};

}  // namespace kaustik
