#pragma once
// Embree's error codes as C++ exceptions.

#include <stdexcept>
#include <string>

#include "accel/embree_api.h"

namespace kaustik::accel {

[[noreturn]] inline void throw_embree(RTCError code, const std::string& what) {
  if (code == RTC_ERROR_OUT_OF_MEMORY) throw std::runtime_error("Embree: out of memory while " + what);
  throw std::runtime_error("Embree: error " + std::to_string(static_cast<int>(code)) + " while " + what);
}

// Throws std::runtime_error for the device's oldest pending error, if there is one. `what` completes "...
// while ".
inline void check(RTCDevice device, const std::string& what) {
  const RTCError code = rtcGetDeviceError(device);
  if (code != RTC_ERROR_NONE) throw_embree(code, what);
}

}  // namespace kaustik::accel
