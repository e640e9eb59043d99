#pragma once
// The only file that depends on Embree's version: 3.13 and 4 differ in the include path and in how a query's
// options are passed (a context filled per call, or optional arguments).

#include <cstddef>
#include <limits>

#if __has_include(<embree4/rtcore.h>)
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

namespace kaustik::accel {

// Number of rays in a packet of embree_intersect().
inline constexpr size_t kPacket = 16;

#if RTC_VERSION_MAJOR >= 4
inline void embree_intersect(RTCScene scene, RTCRayHit* query) {
  rtcIntersect1(scene, query, nullptr);
}
inline void embree_occluded(RTCScene scene, RTCRay* query) {
  rtcOccluded1(scene, query, nullptr);
}
// coherent: traverse the packet as one bundle, which pays in small BVHs when the directions are alike.
inline void embree_intersect(RTCScene scene, const int* valid, bool coherent, RTCRayHit16* query) {
  RTCIntersectArguments arguments;
  rtcInitIntersectArguments(&arguments);
  arguments.flags = coherent ? RTC_RAY_QUERY_FLAG_COHERENT : RTC_RAY_QUERY_FLAG_INCOHERENT;
  rtcIntersect16(valid, scene, query, &arguments);
}
#else
inline void embree_intersect(RTCScene scene, RTCRayHit* query) {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcIntersect1(scene, &context, query);
}
inline void embree_occluded(RTCScene scene, RTCRay* query) {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcOccluded1(scene, &context, query);
}
inline void embree_intersect(RTCScene scene, const int* valid, bool coherent, RTCRayHit16* query) {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  context.flags = coherent ? RTC_INTERSECT_CONTEXT_FLAG_COHERENT : RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT;
  rtcIntersect16(valid, scene, &context, query);
}
#endif

// Embree marks an occluded ray by this value of tfar.
inline constexpr float kEmbreeOccluded = -std::numeric_limits<float>::infinity();

}  // namespace kaustik::accel
