#include "core/camera/perspective.h"

namespace kaustik {
namespace {

// Half the width at z = 1 of one unit of the screen window.
float fov_scale(float fov_degrees) {
  return static_cast<float>(std::tan(0.5 * fov_degrees * std::numbers::pi / 180));
}

}  // namespace

void PerspectiveCamera::set_default_screen_window() {
  const float aspect = static_cast<float>(width) / static_cast<float>(height);
  screen_window = aspect >= 1 ? glm::vec4(-aspect, aspect, -1, 1) : glm::vec4(-1, 1, -1 / aspect, 1 / aspect);
}

float PerspectiveCamera::screen_scale() const {
  return fov_scale(fov_degrees);
}

Ray PerspectiveCamera::generate_ray(const Point2& raster, float scale) const {
  const glm::vec4& w = screen_window;
  const float x = w.x + (w.y - w.x) * (raster.x / static_cast<float>(width));
  const float y = w.w - (w.w - w.z) * (raster.y / static_cast<float>(height));
  const Vector3 d = to_world.vector({x * scale, y * scale, 1});
  return {to_world.translation, glm::normalize(d)};
}

bool PerspectiveCamera::project(const Point3& p, Point2* raster) const {
  const Point3 c = to_world.inverse_point(p);
  if (!(c.z > 0)) return false;
  const glm::vec4& w = screen_window;
  const float scale = c.z * fov_scale(fov_degrees);
  const Point2 size(static_cast<float>(width), static_cast<float>(height));
  const Point2 r((c.x / scale - w.x) / (w.y - w.x) * size.x, (w.w - c.y / scale) / (w.w - w.z) * size.y);
  if (!(r.x >= 0 && r.x < size.x && r.y >= 0 && r.y < size.y)) return false;
  *raster = r;
  return true;
}

}  // namespace kaustik
