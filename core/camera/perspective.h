#pragma once
#include "core/math/ray.h"
#include "core/math/transform.h"

namespace kaustik {

// Pinhole camera, pbrt's conventions: camera space looks along +z with +y up and +x right; fov is the full
// angle of the shorter image axis. Raster space: pixels, row 0 on top.
struct PerspectiveCamera {
  Transform to_world;
  float fov_degrees = 90;
  int width = 1280, height = 720;
  // Screen window (x_min, x_max, y_min, y_max) at z = 1 before the fov's scale: (-aspect, aspect, -1, 1)
  // unless given.
  glm::vec4 screen_window{-1, 1, -1, 1};

  void set_default_screen_window();
  // Unit direction. raster in [0, width) x [0, height).
  Ray generate_ray(const Point2& raster) const { return generate_ray(raster, screen_scale()); }
  // The same, for many rays; scale: that of screen_scale(), which costs a tangent.
  Ray generate_ray(const Point2& raster, float scale) const;
  float screen_scale() const;
  // Raster position of a world point in front of the camera; false behind it or outside the image.
  bool project(const Point3& p, Point2* raster) const;
};

}  // namespace kaustik
