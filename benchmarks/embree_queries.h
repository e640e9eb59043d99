#pragma once
// Embree's queries for single rays and packets, with their flags, which differ between 3.13 and 4.

#include "accel/embree_api.h"

namespace kaustik::benchmarks {

// Outlives its queries; filled once, not per call.
class EmbreeQueries {
 public:
#if RTC_VERSION_MAJOR >= 4
  EmbreeQueries(RTCScene scene, bool coherent) : scene_(scene) {
    const RTCRayQueryFlags flags = coherent ? RTC_RAY_QUERY_FLAG_COHERENT : RTC_RAY_QUERY_FLAG_INCOHERENT;
    rtcInitIntersectArguments(&intersect_);
    rtcInitOccludedArguments(&occluded_);
    intersect_.flags = occluded_.flags = flags;
  }
  void intersect(const int*, RTCRayHit* query) {
    rtcIntersect1(scene_, query, &intersect_);
  }
  void intersect(const int* valid, RTCRayHit8* query) {
    rtcIntersect8(valid, scene_, query, &intersect_);
  }
  void intersect(const int* valid, RTCRayHit16* query) {
    rtcIntersect16(valid, scene_, query, &intersect_);
  }
  void occluded(RTCRay* query) {
    rtcOccluded1(scene_, query, &occluded_);
  }

 private:
  RTCScene scene_;
  RTCIntersectArguments intersect_;
  RTCOccludedArguments occluded_;
#else
  EmbreeQueries(RTCScene scene, bool coherent) : scene_(scene) {
    rtcInitIntersectContext(&context_);
    context_.flags = coherent ? RTC_INTERSECT_CONTEXT_FLAG_COHERENT : RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT;
  }
  void intersect(const int*, RTCRayHit* query) {
    rtcIntersect1(scene_, &context_, query);
  }
  void intersect(const int* valid, RTCRayHit8* query) {
    rtcIntersect8(valid, scene_, &context_, query);
  }
  void intersect(const int* valid, RTCRayHit16* query) {
    rtcIntersect16(valid, scene_, &context_, query);
  }
  void occluded(RTCRay* query) {
    rtcOccluded1(scene_, &context_, query);
  }

 private:
  RTCScene scene_;
  RTCIntersectContext context_;
#endif
};

}  // namespace kaustik::benchmarks
