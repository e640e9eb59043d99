// Rays of the cameras, and the projection of points onto the image.

#include "core/camera/camera.h"

#include "core/sampling/equal_area.h"
#include "core/sampling/warp.h"

namespace kaustik {
namespace {

float fov_scale(float fov_degrees) {
  return static_cast<float>(std::tan(0.5 * fov_degrees * std::numbers::pi / 180));
}

Point2 image_size(const Camera& camera) {
  return {static_cast<float>(camera.width), static_cast<float>(camera.height)};
}

// Camera space has +y up, whereas the maps of the sphere have +z up.
Vector3 spherical_direction(SphericalMapping mapping, const Point2& uv) {
  if (mapping == SphericalMapping::kEqualArea) {
    const Vector3 d = equal_area_square_to_sphere(wrap_equal_area_square(uv));
    return {d.x, d.z, d.y};
  }
  const auto turns = [](float t) { return t - std::floor(t); };
  const Point2 theta = cos_sin_turns(turns(0.5f * uv.y)), phi = cos_sin_turns(turns(uv.x));
  return {theta.y * phi.x, theta.x, theta.y * phi.y};
}

Point2 spherical_square(SphericalMapping mapping, const Vector3& d) {
  if (mapping == SphericalMapping::kEqualArea) return equal_area_sphere_to_square({d.x, d.z, d.y});
  const float turns = std::atan2(d.z, d.x) * (0.5f * kInvPi);
  return {turns < 0 ? turns + 1 : turns, std::acos(std::clamp(d.y, -1.0f, 1.0f)) * kInvPi};
}

// Maps a point of camera space to the unit square of the image; false if the point is behind the camera.
bool to_square(const PerspectiveProjection& p, const glm::vec4& w, const Point3& c, Point2* square) {
  if (!(c.z > 0)) return false;
  const float scale = c.z * fov_scale(p.fov_degrees);
  *square = {(c.x / scale - w.x) / (w.y - w.x), (w.w - c.y / scale) / (w.w - w.z)};
  return true;
}
bool to_square(const OrthographicProjection&, const glm::vec4& w, const Point3& c, Point2* square) {
  if (!(c.z > 0)) return false;
  *square = {(c.x - w.x) / (w.y - w.x), (w.w - c.y) / (w.w - w.z)};
  return true;
}
bool to_square(const SphericalProjection& p, const glm::vec4&, const Point3& c, Point2* square) {
  const float length = glm::length(c);
  if (!(length > 0)) return false;
  *square = spherical_square(p.mapping, c / length);
  return true;
}

}  // namespace

void Camera::set_default_screen_window() {
  const float aspect = static_cast<float>(width) / static_cast<float>(height);
  screen_window = aspect >= 1 ? glm::vec4(-aspect, aspect, -1, 1) : glm::vec4(-1, 1, -1 / aspect, 1 / aspect);
}

Ray Camera::generate_ray(const Point2& raster) const {
  return RayGenerator(*this)(raster);
}

float Camera::lens_radius() const {
  if (const auto* p = std::get_if<PerspectiveProjection>(&projection)) return p->lens.radius;
  if (const auto* p = std::get_if<OrthographicProjection>(&projection)) return p->lens.radius;
  return 0;
}

bool Camera::project(const Point3& p, Point2* raster, Point3* origin) const {
  const Point3 c = to_world.inverse_point(p);
  const bool ahead =
      std::visit([&](const auto& q) { return to_square(q, screen_window, c, raster); }, projection);
  if (!ahead) return false;
  const Point2 size = image_size(*this);
  *raster *= size;
  if (!(raster->x >= 0 && raster->x < size.x && raster->y >= 0 && raster->y < size.y)) return false;
  const bool parallel = std::holds_alternative<OrthographicProjection>(projection);
  *origin = parallel ? to_world.point({c.x, c.y, 0}) : to_world.translation;
  return true;
}

RayGenerator::RayGenerator(const Camera& camera) : camera_(&camera) {
  if (const auto* p = std::get_if<PerspectiveProjection>(&camera.projection))
    scale_ = fov_scale(p->fov_degrees);
}

Ray RayGenerator::through(const Point2& raster, const Point2& lens) const {
  if (const auto* p = std::get_if<PerspectiveProjection>(&camera_->projection)) return make(*p, raster, lens);
  return std::visit([&](const auto& p) { return make(p, raster, lens); }, camera_->projection);
}

Point2 RayGenerator::screen(const Point2& raster) const {
  const glm::vec4& w = camera_->screen_window;
  return {w.x + (w.y - w.x) * (raster.x / static_cast<float>(camera_->width)),
          w.w - (w.w - w.z) * (raster.y / static_cast<float>(camera_->height))};
}

// All rays through one raster position meet where the ray through the middle of the lens reaches the focal
// distance. Dividing by that distance leaves no unit of length in the direction.
Ray RayGenerator::make(const PerspectiveProjection& p, const Point2& raster, const Point2& lens) const {
  const Transform& t = camera_->to_world;
  const Point2 s = screen(raster);
  const float x = s.x * scale_, y = s.y * scale_;
  if (!(p.lens.radius > 0)) return {t.translation, glm::normalize(t.vector({x, y, 1}))};
  const Point2 from = p.lens.radius * lens, slope = from / p.lens.focal_distance;
  return {t.point({from.x, from.y, 0}), glm::normalize(t.vector({x - slope.x, y - slope.y, 1}))};
}

Ray RayGenerator::make(const OrthographicProjection& p, const Point2& raster, const Point2& lens) const {
  const Transform& t = camera_->to_world;
  const Point2 s = screen(raster), from = p.lens.radius * lens, slope = from / p.lens.focal_distance;
  return {t.point({s.x + from.x, s.y + from.y, 0}), glm::normalize(t.vector({-slope.x, -slope.y, 1}))};
}

Ray RayGenerator::make(const SphericalProjection& p, const Point2& raster, const Point2& /*lens*/) const {
  const Transform& t = camera_->to_world;
  return {t.translation,
          glm::normalize(t.vector(spherical_direction(p.mapping, raster / image_size(*camera_))))};
}

}  // namespace kaustik
