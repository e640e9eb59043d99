#pragma once
// The only place that knows which Embree it is: 3.13 and 4 differ in the include path and in how a query's
// options travel (a context filled per call, or optional arguments).

#include <limits>

#if __has_include(<embree4/rtcore.h>)
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

namespace kaustik::accel {

#if RTC_VERSION_MAJOR >= 4
inline void embree_intersect(RTCScene scene, RTCRayHit* query) {
  rtcIntersect1(scene, query, nullptr);
}
inline void embree_occluded(RTCScene scene, RTCRay* query) {
  rtcOccluded1(scene, query, nullptr);
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
#endif

// Embree marks an occluded ray by this far end.
inline constexpr float kEmbreeOccluded = -std::numeric_limits<float>::infinity();

}  // namespace kaustik::accel
