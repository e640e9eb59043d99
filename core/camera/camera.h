#pragma once
// Cameras, with pbrt's conventions: camera space looks along +z with +y up and +x right. Raster space counts
// pixels, with row 0 at the top.

#include <variant>

#include "core/camera/pixel_filter.h"
#include "core/math/ray.h"
#include "core/math/transform.h"

namespace kaustik {

// A thin lens in the plane z = 0 of camera space; points at z = focal_distance are sharp. Both lengths are in
// camera space, in metres. Radius 0 means a pinhole.
struct ThinLens {
  float radius = 0;
  float focal_distance = 1e6f;
};

// fov_degrees is the full angle from -1 to 1 of the screen window, which is that of the shorter image axis by
// default.
struct PerspectiveProjection {
  float fov_degrees = 90;
  ThinLens lens;
};

// Parallel rays from the plane z = 0, in which the screen window is measured in metres.
struct OrthographicProjection {
  ThinLens lens;
};

// All directions, with +y up: by latitude (rows) and longitude (columns), or by the equal-area map (Clarberg
// 2008).
enum class SphericalMapping { kEquirectangular, kEqualArea };
struct SphericalProjection {
  SphericalMapping mapping = SphericalMapping::kEqualArea;
};

using Projection = std::variant<PerspectiveProjection, OrthographicProjection, SphericalProjection>;

struct Camera {
  Transform to_world;
  int width = 1280, height = 720;
  // Screen window (x_min, x_max, y_min, y_max): at z = 1 before scaling by the fov, or in metres
  // (orthographic). By default the shorter side runs from -1 to 1 and the longer one from -aspect to aspect.
  // Spherical cameras do not use it.
  glm::vec4 screen_window{-1, 1, -1, 1};
  Projection projection;
  PixelFilter filter;

  void set_default_screen_window();
  // Ray through the middle of the lens, with unit direction. raster lies in [0, width) x [0, height), or
  // beyond by the radius of the pixel filter.
  Ray generate_ray(const Point2& raster) const;
  // Computes the raster position at which a world point is seen through the middle of the lens, and the
  // origin of its ray; false if the point is behind the camera or outside the image.
  bool project(const Point3& p, Point2* raster, Point3* origin) const;
  // Radius of the lens in camera space; 0 for a pinhole and for spherical cameras.
  float lens_radius() const;
};

// Generates the rays of one camera, to which it keeps a pointer.
class RayGenerator {
 public:
  explicit RayGenerator(const Camera& camera);
  // Ray through the middle of the lens.
  Ray operator()(const Point2& raster) const { return through(raster, {0, 0}); }
  // Ray through the point `lens` of the lens, scaled to the unit disk.
  Ray through(const Point2& raster, const Point2& lens) const;

 private:
  Point2 screen(const Point2& raster) const;
  Ray make(const PerspectiveProjection& p, const Point2& raster, const Point2& lens) const;
  Ray make(const OrthographicProjection& p, const Point2& raster, const Point2& lens) const;
  Ray make(const SphericalProjection& p, const Point2& raster, const Point2& lens) const;

  const Camera* camera_;
  float scale_ = 1;  // perspective: half width at z = 1 of the window from -1 to 1
};

}  // namespace kaustik
