#pragma once
#include "core/geometry/shape.h"
#include "core/math/error_bounds.h"
#include "core/math/frame.h"
#include "core/math/ray.h"

namespace kaustik {

// What an intersection returns: enough to rebuild the surface point with bounded error.
struct Hit {
  float t = kInfinity;
  uint32_t shape = kNoIndex;
  uint32_t primitive = 0;
  Point2 uv{0};  // triangles: barycentrics of vertices 1 and 2; disks: local xy; spheres: unused

  bool valid() const { return shape != kNoIndex; }
};

// A point on a surface, in world space.
struct SurfaceInteraction {
  Point3 p{0};
  float p_error = 0;    // bound on |computed - true| along the normal, metres
  Normal3 n{0, 0, 1};   // oriented geometric normal, unit
  Normal3 ns{0, 0, 1};  // shading normal, unit, in n's hemisphere
  uint32_t shape = kNoIndex, primitive = 0;
  uint32_t material = 0, light = kNoIndex, surface_group = 0;
  Point2 hit_uv{0};  // of the Hit: from it surface_parameters() makes uv and its derivatives where asked for
  Vector3 tangent{0};  // dpdu where the BSDF is not the same all around; BsdfAt sets it

  // In which BSDFs are defined: z = ns, x along the tangent where there is one.
  Frame shading_frame() const {
    return tangent == Vector3(0) ? Frame::from_z(ns) : Frame::from_z(ns, tangent);
  }

  // Ray leaving in direction w (need not be unit).
  Ray spawn(const Vector3& w, float t_max = kInfinity) const {
    return {offset_origin(p, p_error, n, w), w, t_max};
  }
};

// Rebuilds the surface point of a hit from the shape's own data (barycentrics, or the reprojected sphere),
// not from ray.at(t): its error does not grow with the ray's length.
SurfaceInteraction make_interaction(const std::vector<Shape>& shapes, const Ray& ray, const Hit& hit);

// t of the nearest intersection with 0 < t < ray.t_max of a sphere or disk, or kInfinity; fills hit.uv for
// disks. Sphere: Haines et al. 2019, "Precision Improvements for Ray/Sphere Intersection". Used by Embree's
// callbacks and the oracle.
float intersect_sphere(const Sphere& sphere, const Ray& ray);
float intersect_disk(const Disk& disk, const Ray& ray, Point2* uv);

}  // namespace kaustik
