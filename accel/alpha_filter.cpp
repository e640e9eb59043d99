// Embree's filter callback for triangles with alpha, and the hash of Embree's rays.

#include "accel/alpha_filter.h"

#include "core/scene/alpha.h"

namespace kaustik::accel {

uint64_t hash_of_ray(RTCRayN* rays, unsigned N, unsigned i) {
  return hash_ray({RTCRayN_org_x(rays, N, i), RTCRayN_org_y(rays, N, i), RTCRayN_org_z(rays, N, i)},
                  {RTCRayN_dir_x(rays, N, i), RTCRayN_dir_y(rays, N, i), RTCRayN_dir_z(rays, N, i)});
}

namespace {

// Rejects triangle hits at points where alpha says there is no surface. The hit point follows from the
// barycentrics alone, so an empty Ray will do.
void filter_alpha(const RTCFilterFunctionNArguments* args) {
  const auto& mesh = *static_cast<const AlphaMesh*>(args->geometryUserPtr);
  const uint32_t shape = mesh.shape == kNoIndex ? args->context->instID[0] : mesh.shape;
  for (unsigned i = 0; i < args->N; ++i) {
    if (!args->valid[i]) continue;
    const Point2 uv(RTCHitN_u(args->hit, args->N, i), RTCHitN_v(args->hit, args->N, i));
    const Hit hit{1, shape, RTCHitN_primID(args->hit, args->N, i), uv};
    if (!stops_at(*mesh.scene, Ray{}, hit, hash_of_ray(args->ray, args->N, i))) args->valid[i] = 0;
  }
}

}  // namespace

void set_alpha_filter(RTCGeometry geometry, const AlphaMesh* mesh) {
  rtcSetGeometryUserData(geometry, const_cast<AlphaMesh*>(mesh));
  rtcSetGeometryIntersectFilterFunction(geometry, filter_alpha);
  rtcSetGeometryOccludedFilterFunction(geometry, filter_alpha);
}

}  // namespace kaustik::accel
