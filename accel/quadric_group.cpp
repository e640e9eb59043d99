// Embree's callbacks for user geometry: bounds, intersection and occlusion of spheres, disks and other
// quadrics.

#include "accel/quadric_group.h"

#include <bit>

#include "accel/alpha_filter.h"
#include "core/geometry/analytic/sphere_lanes.h"
#include "core/scene/alpha.h"

namespace kaustik::accel {

namespace {

// Ray i of N in scene units, with its range open again: the inverse of how Bvh passes rays to Embree.
Ray to_ray(RTCRayN* rays, unsigned N, unsigned i, float to_scene) {
  const float t_max = std::bit_cast<float>(std::bit_cast<uint32_t>(RTCRayN_tfar(rays, N, i)) + 1);
  const Point3 o(RTCRayN_org_x(rays, N, i), RTCRayN_org_y(rays, N, i), RTCRayN_org_z(rays, N, i));
  const Vector3 d(RTCRayN_dir_x(rays, N, i), RTCRayN_dir_y(rays, N, i), RTCRayN_dir_z(rays, N, i));
  return {to_scene * o, d, to_scene * t_max};
}

// Nearest crossing that alpha does not reject, or infinity. A ray meets a sphere or a disk at most twice.
template <AnalyticShape G>
float intersect_with_alpha(const QuadricGroup& group, uint32_t primitive, Ray ray, uint64_t ray_hash,
                           Point2* uv) {
  const auto& geometry = std::get<G>(group.shape(primitive).geometry);
  float passed = 0;
  for (uint32_t crossing = 0; crossing < G::kMostCrossings; ++crossing) {
    const float t = geometry.intersect(ray, uv);
    if (t == kInfinity) break;
    const Hit hit{t, group.members[primitive], 0, *uv};
    if (stops_at(*group.scene, ray, hit, ray_hash + crossing)) return passed + t;
    passed += t;
    ray = make_interaction(group.scene->shapes, ray, hit).spawn(ray.d, ray.t_max - t);
  }
  return kInfinity;
}

// Nearest intersection of ray i of N; t in Embree's units.
template <AnalyticShape G>
float intersect_quadric(const QuadricGroup& group, uint32_t primitive, RTCRayN* rays, unsigned N, unsigned i,
                        Point2* uv) {
  const Ray ray = to_ray(rays, N, i, group.to_scene);
  if (group.has_alpha && group.shape(primitive).has_alpha()) {
    return group.to_embree * intersect_with_alpha<G>(group, primitive, ray, hash_of_ray(rays, N, i), uv);
  }
  return group.to_embree * std::get<G>(group.shape(primitive).geometry).intersect(ray, uv);
}

void quadric_bounds(const RTCBoundsFunctionArguments* args) {
  const auto& group = *static_cast<const QuadricGroup*>(args->geometryUserPtr);
  const Bounds3 b = bounds_of(group.shape(args->primID));
  const Point3 lower = group.to_embree * b.min, upper = group.to_embree * b.max;
  *args->bounds_o = {lower.x, lower.y, lower.z, 0, upper.x, upper.y, upper.z, 0};
}

// Whether a hit replaces the ray's current one: it is nearer, or as near and of a shape earlier in the scene.
bool replaces(float held_t, unsigned held_shape, float t, unsigned shape) {
  return t < held_t || (t == held_t && held_shape > shape);
}

// Intersects all N rays, valid or not: t in Embree's units; uv for disks.
template <AnalyticShape G>
void intersect_all(const QuadricGroup& group, uint32_t primitive, RTCRayN* rays, unsigned N, float* t,
                   Point2* uv) {
  for (unsigned i = 0; i < N; ++i) t[i] = intersect_quadric<G>(group, primitive, rays, N, i, &uv[i]);
}

template <>
void intersect_all<Sphere>(const QuadricGroup& group, uint32_t primitive, RTCRayN* rays, unsigned N, float* t,
                           Point2* uv) {
  if (N != kPacket || group.has_alpha) {
    for (unsigned i = 0; i < N; ++i) t[i] = intersect_quadric<Sphere>(group, primitive, rays, N, i, &uv[i]);
    return;
  }
  // The same conversion as to_ray(), for a whole packet.
  const auto& packet = *reinterpret_cast<const RTCRay16*>(rays);
  alignas(64) float x[kPacket], y[kPacket], z[kPacket], t_max[kPacket];
  for (size_t i = 0; i < kPacket; ++i) {
    x[i] = group.to_scene * packet.org_x[i];
    y[i] = group.to_scene * packet.org_y[i];
    z[i] = group.to_scene * packet.org_z[i];
    t_max[i] = group.to_scene * std::bit_cast<float>(std::bit_cast<uint32_t>(packet.tfar[i]) + 1);
  }
  const auto& sphere = std::get<Sphere>(group.shape(primitive).geometry);
  intersect_sphere_lanes(sphere, {{x, y, z}, {packet.dir_x, packet.dir_y, packet.dir_z}, t_max}, kPacket, t);
  for (size_t i = 0; i < kPacket; ++i) t[i] *= group.to_embree;
}

template <AnalyticShape G>
void quadric_intersect(const RTCIntersectFunctionNArguments* args) {
  const auto& group = *static_cast<const QuadricGroup*>(args->geometryUserPtr);
  const unsigned N = args->N, primitive = args->primID, shape = group.members[primitive];
  RTCRayN* rays = RTCRayHitN_RayN(args->rayhit, N);
  RTCHitN* hits = RTCRayHitN_HitN(args->rayhit, N);
  alignas(64) float t[kPacket];
  Point2 uv[kPacket] = {};
  intersect_all<G>(group, primitive, rays, N, t, uv);
  for (unsigned i = 0; i < N; ++i) {
    const unsigned instance = RTCHitN_instID(hits, N, i, 0);
    const unsigned held = instance == RTC_INVALID_GEOMETRY_ID ? RTCHitN_geomID(hits, N, i) : instance;
    if (!args->valid[i] || !replaces(RTCRayN_tfar(rays, N, i), held, t[i], shape)) continue;
    RTCRayN_tfar(rays, N, i) = t[i];
    RTCHitN_u(hits, N, i) = uv[i].x;
    RTCHitN_v(hits, N, i) = uv[i].y;
    RTCHitN_primID(hits, N, i) = 0;
    RTCHitN_geomID(hits, N, i) = shape;
    RTCHitN_instID(hits, N, i, 0) = args->context->instID[0];
  }
}

template <AnalyticShape G>
void quadric_occluded(const RTCOccludedFunctionNArguments* args) {
  const auto& group = *static_cast<const QuadricGroup*>(args->geometryUserPtr);
  for (unsigned i = 0; i < args->N; ++i) {
    if (!args->valid[i]) continue;
    Point2 uv(0);
    float& t_far = RTCRayN_tfar(args->ray, args->N, i);
    if (intersect_quadric<G>(group, args->primID, args->ray, args->N, i, &uv) <= t_far)
      t_far = kEmbreeOccluded;
  }
}

template <AnalyticShape G>
RTCGeometry geometry_of(RTCDevice device, QuadricGroup& group) {
  RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_USER);
  rtcSetGeometryUserPrimitiveCount(geometry, static_cast<unsigned>(group.members.size()));
  rtcSetGeometryUserData(geometry, &group);
  rtcSetGeometryBoundsFunction(geometry, quadric_bounds, nullptr);
  rtcSetGeometryIntersectFunction(geometry, quadric_intersect<G>);
  rtcSetGeometryOccludedFunction(geometry, quadric_occluded<G>);
  return geometry;
}

}  // namespace

RTCGeometry make_geometry(RTCDevice device, QuadricGroup& group) {
  return std::visit(
      [&]<class G>(const G&) -> RTCGeometry {
        if constexpr (AnalyticShape<G>) return geometry_of<G>(device, group);
        return nullptr;
      },
      group.shape(0).geometry);
}

}  // namespace kaustik::accel
