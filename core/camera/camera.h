#pragma once
// Cameras in pbrt's conventions: camera space looks along +z with +y up and +x right. Raster space: pixels,
// row 0 on top.

#include <variant>

#include "core/camera/pixel_filter.h"
#include "core/math/ray.h"
#include "core/math/transform.h"

namespace kaustik {

// A thin lens in the plane z = 0 of camera space: what lies at z = focal_distance is sharp. Metres, camera
// space. Radius 0: a pinhole.
struct ThinLens {
  float radius = 0;
  float focal_distance = 1e6f;
};

// fov: full angle of one unit of the screen window to both sides, that is of the shorter image axis.
struct PerspectiveProjection {
  float fov_degrees = 90;
  ThinLens lens;
};

// Parallel rays from the plane z = 0; the screen window is in metres there.
struct OrthographicProjection {
  ThinLens lens;
};

// All directions, with +y up: by latitude (rows) and longitude (columns), or by equal areas (Clarberg 2008).
enum class SphericalMapping { kEquirectangular, kEqualArea };
struct SphericalProjection {
  SphericalMapping mapping = SphericalMapping::kEqualArea;
};

using Projection = std::variant<PerspectiveProjection, OrthographicProjection, SphericalProjection>;

struct Camera {
  Transform to_world;
  int width = 1280, height = 720;
  // Screen window (x_min, x_max, y_min, y_max): at z = 1 before the fov's scale, or in metres (orthographic).
  // (-aspect, aspect, -1, 1) unless given; shorter side -1 to 1. Spherical cameras have none.
  glm::vec4 screen_window{-1, 1, -1, 1};
  Projection projection;
  PixelFilter filter;

  void set_default_screen_window();
  // Through the middle of the lens; unit direction. raster in [0, width) x [0, height), or beyond by as much
  // as the pixel filter reaches.
  Ray generate_ray(const Point2& raster) const;
  // Raster position of a world point as seen through the middle of the lens, and where its ray begins; false
  // behind the camera or outside the image.
  bool project(const Point3& p, Point2* raster, Point3* origin) const;
  // Radius of the lens, camera space; 0 where there is none.
  float lens_radius() const;
};

// Makes the rays of one camera; keeps a pointer to it.
class RayGenerator {
 public:
  explicit RayGenerator(const Camera& camera);
  // Through the middle of the lens.
  Ray operator()(const Point2& raster) const { return through(raster, {0, 0}); }
  // lens: a point of the unit disk, the part of the lens that the ray goes through.
  Ray through(const Point2& raster, const Point2& lens) const;

 private:
  Point2 screen(const Point2& raster) const;
  Ray make(const PerspectiveProjection& p, const Point2& raster, const Point2& lens) const;
  Ray make(const OrthographicProjection& p, const Point2& raster, const Point2& lens) const;
  Ray make(const SphericalProjection& p, const Point2& raster, const Point2& lens) const;

  const Camera* camera_;
  float scale_ = 1;  // perspective: half the width at z = 1 of one unit of the screen window
};

}  // namespace kaustik
