// Intersection, bounds and area of disks and annuli.

#include "core/geometry/analytic/disk.h"

#include "core/geometry/analytic/quadric_bounds.h"

namespace kaustik {

float intersect_disk(const Disk& disk, const Ray& ray, Point2* uv) {
  const Point3 o = disk.to_world.inverse_point(ray.o);
  const Vector3 d = disk.to_world.inverse_vector(ray.d);
  const float t = -o.z / d.z;
  if (!(t > 0 && t < ray.t_max)) return kInfinity;
  const Point2 p(o.x + t * d.x, o.y + t * d.y);
  const float r2 = glm::dot(p, p);
  if (!(r2 <= 1 && r2 >= disk.inner * disk.inner)) return kInfinity;
  *uv = p;
  return t;
}

SurfacePoint Disk::at_hit(const Ray& /*ray*/, float /*t*/, const Point2& uv) const {
  return {to_world.point({uv.x, uv.y, 0}), disk_error(to_world), disk_normal(to_world)};
}

Bounds3 Disk::bounds() const {
  return bounds_about(to_world.translation, half_extent(to_world.linear, 2), disk_error(to_world));
}

double Disk::area() const {
  const glm::dvec3 x(to_world.linear[0]);
  const glm::dvec3 y(to_world.linear[1]);
  const double hole = inner;
  return std::numbers::pi * (1 - hole * hole) * glm::length(glm::cross(x, y));
}

}  // namespace kaustik
