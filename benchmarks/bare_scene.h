#pragma once
// The shapes of a scene in a plain Embree scene, robust like the renderer's: the upper limit of speed for
// everything that traces rays.

#include <cstddef>
#include <cstring>

#include "accel/embree_handles.h"
#include "core/scene/scene.h"

namespace kaustik::benchmarks {
namespace bare_detail {

inline void bounds(const RTCBoundsFunctionArguments* args) {
  const Bounds3 b = bounds_of(*static_cast<const Shape*>(args->geometryUserPtr));
  *args->bounds_o = {b.min.x, b.min.y, b.min.z, 0, b.max.x, b.max.y, b.max.z, 0};
}

// The distance at which ray i of N meets the sphere or disk; infinity when it misses.
inline float distance(const void* shape, RTCRayN* rays, unsigned N, unsigned i) {
  const Ray ray{{RTCRayN_org_x(rays, N, i), RTCRayN_org_y(rays, N, i), RTCRayN_org_z(rays, N, i)},
                {RTCRayN_dir_x(rays, N, i), RTCRayN_dir_y(rays, N, i), RTCRayN_dir_z(rays, N, i)},
                RTCRayN_tfar(rays, N, i)};
  const auto& geometry = static_cast<const Shape*>(shape)->geometry;
  Point2 uv;
  const auto* sphere = std::get_if<Sphere>(&geometry);
  const float t =
      sphere ? intersect_sphere(*sphere, ray) : intersect_disk(std::get<Disk>(geometry), ray, &uv);
  return t >= RTCRayN_tnear(rays, N, i) ? t : kInfinity;
}

// N is args->N; the case of a single ray is compiled separately.
inline void intersect_lanes(const RTCIntersectFunctionNArguments* args, unsigned N) {
  RTCRayN* rays = RTCRayHitN_RayN(args->rayhit, N);
  RTCHitN* hits = RTCRayHitN_HitN(args->rayhit, N);
  for (unsigned i = 0; i < N; ++i) {
    if (!args->valid[i]) continue;
    const float t = distance(args->geometryUserPtr, rays, N, i);
    if (!(t < RTCRayN_tfar(rays, N, i))) continue;
    RTCRayN_tfar(rays, N, i) = t;
    RTCHitN_geomID(hits, N, i) = args->geomID;
    RTCHitN_primID(hits, N, i) = args->primID;
  }
}
inline void intersect(const RTCIntersectFunctionNArguments* args) {
  args->N == 1 ? intersect_lanes(args, 1) : intersect_lanes(args, args->N);
}

inline void occluded(const RTCOccludedFunctionNArguments* args) {
  for (unsigned i = 0; i < args->N; ++i) {
    if (!args->valid[i]) continue;
    float& t_far = RTCRayN_tfar(args->ray, args->N, i);
    if (distance(args->geometryUserPtr, args->ray, args->N, i) < t_far) t_far = accel::kEmbreeOccluded;
  }
}

}  // namespace bare_detail

// Keeps pointers to the scene's shapes, which must outlive it.
class BareScene {
 public:
  explicit BareScene(const Scene& scene) {
    embree_.open_device();
    embree_.scene = rtcNewScene(embree_.device);
    rtcSetSceneFlags(embree_.scene, RTC_SCENE_FLAG_ROBUST);
    for (const Shape& shape : scene.shapes) {
      const auto* mesh = std::get_if<TriangleMesh>(&shape.geometry);
      mesh ? add(*mesh) : add_quadric(shape);
    }
    rtcCommitScene(embree_.scene);
    accel::check(embree_.device, "building the bare scene");
  }

  RTCScene scene() const { return embree_.scene; }

  // The distance to the nearest hit beyond `near`; zero when there is none.
  float distance(const Ray& ray, float near) const {
    // Stores the vectors that Embree loads: loading what was stored as single floats would stall.
    using Float4 [[gnu::vector_size(16)]] = float;
    const Float4 from_to[] = {{ray.o.x, ray.o.y, ray.o.z, near}, {ray.d.x, ray.d.y, ray.d.z, 0}};
    static_assert(offsetof(RTCRay, tnear) == 12 && offsetof(RTCRay, dir_x) == 16);
    RTCRayHit query;
    std::memcpy(static_cast<void*>(&query), from_to, sizeof(from_to));
    query.ray.tfar = kInfinity;
    query.ray.mask = 0xffffffffu;
    query.ray.id = query.ray.flags = 0;
    query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
    accel::embree_intersect(embree_.scene, &query);
    return query.hit.geomID == RTC_INVALID_GEOMETRY_ID ? 0 : query.ray.tfar;
  }

 private:
  void add(const TriangleMesh& mesh) {
    RTCGeometry g = rtcNewGeometry(embree_.device, RTC_GEOMETRY_TYPE_TRIANGLE);
    auto* p = static_cast<Point3*>(rtcSetNewGeometryBuffer(g, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                                           sizeof(Point3), mesh.P.size()));
    std::copy(mesh.P.begin(), mesh.P.end(), p);
    rtcSetSharedGeometryBuffer(g, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, mesh.indices.data(), 0,
                               sizeof(mesh.indices[0]), mesh.indices.size());
    attach(g);
  }
  void add_quadric(const Shape& shape) {
    RTCGeometry g = rtcNewGeometry(embree_.device, RTC_GEOMETRY_TYPE_USER);
    rtcSetGeometryUserPrimitiveCount(g, 1);
    rtcSetGeometryUserData(g, const_cast<Shape*>(&shape));
    rtcSetGeometryBoundsFunction(g, bare_detail::bounds, nullptr);
    rtcSetGeometryIntersectFunction(g, bare_detail::intersect);
    rtcSetGeometryOccludedFunction(g, bare_detail::occluded);
    attach(g);
  }
  void attach(RTCGeometry g) {
    rtcCommitGeometry(g);
    rtcAttachGeometry(embree_.scene, g);
    rtcReleaseGeometry(g);
  }

  accel::EmbreeHandles embree_;
};

}  // namespace kaustik::benchmarks
