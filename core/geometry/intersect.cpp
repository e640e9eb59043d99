// Intersections of a ray with a sphere and a disk. Both work in object space and are exact, including
// ellipsoids.

#include "core/geometry/interaction.h"

namespace kaustik {

float intersect_sphere(const Sphere& sphere, const Ray& ray) {
  const Vector3 o = sphere.to_world.inverse_point(ray.o);
  const Vector3 d = sphere.to_world.inverse_vector(ray.d);
  const float a = glm::dot(d, d);
  const float b = -glm::dot(o, d);
  // Haines et al. 2019: compute the discriminant from the point of the line nearest to the centre, which
  // avoids cancellation for distant origins.
  const Vector3 nearest = o + (b / a) * d;
  const float discriminant = 1 - glm::dot(nearest, nearest);
  if (!(discriminant >= 0)) return kInfinity;
  const float root = std::sqrt(a * discriminant);
  // The sign of c tells outside from inside. An origin that left the surface by its error bound is certain to
  // lie on its side, so the near root has the right sign and t needs no threshold.
  const float distance = glm::length(o);
  const float c = (distance - 1) * (distance + 1);
  if (c > 0) {
    if (b <= 0) return kInfinity;  // outside, moving away
    const float t = c / (b + root);
    return t > 0 && t < ray.t_max ? t : kInfinity;
  }
  // Inside: take the far root, in the form without cancellation.
  const float t = b >= 0 ? (b + root) / a : c / (b - root);
  return t > 0 && t < ray.t_max ? t : kInfinity;
}

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

}  // namespace kaustik
