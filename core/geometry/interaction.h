#pragma once
// Hits and surface points, with bounded errors.

#include "core/geometry/shape.h"
#include "core/math/error_bounds.h"
#include "core/math/frame.h"
#include "core/math/ray.h"

namespace kaustik {

// The result of an intersection: enough to rebuild the surface point with a bounded error.
struct Hit {
  float t = kInfinity;
  uint32_t shape = kNoIndex;
  uint32_t primitive = 0;
  Point2 uv{0};  // triangles: barycentrics of vertices 1 and 2; disks: local xy; others: unused

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
  Point2 hit_uv{0};    // as in Hit; surface_parameters() computes uv and its derivatives from it on demand
  Vector3 tangent{0};  // dpdu, set by BsdfAt if the BSDF is anisotropic

  // The frame in which BSDFs are defined: z = ns, and x along the tangent if there is one.
  Frame shading_frame() const {
    return tangent == Vector3(0) ? Frame::from_z(ns) : Frame::from_z(ns, tangent);
  }

  // Ray that leaves in direction w, which need not be of unit length.
  Ray spawn(const Vector3& w, float t_max = kInfinity) const {
    return {offset_origin(p, p_error, n, w), w, t_max};
  }
};

// Rebuilds the surface point of a hit from the shape's own data (barycentrics, or reprojection onto the
// sphere) rather than as ray.at(t), so that its error does not grow with the length of the ray.
SurfaceInteraction make_interaction(const std::vector<Shape>& shapes, const Ray& ray, const Hit& hit);

}  // namespace kaustik
