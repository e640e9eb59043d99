// Queries Embree for its version.

#include "accel/embree_version.h"

#include <fmt/format.h>

#include "accel/embree_handles.h"

namespace kaustik::accel {

std::string embree_version() {
  EmbreeHandles embree;
  embree.open_device();
  const auto property = [&](RTCDeviceProperty p) { return rtcGetDeviceProperty(embree.device, p); };
  return fmt::format("{}.{}.{}", property(RTC_DEVICE_PROPERTY_VERSION_MAJOR),
                     property(RTC_DEVICE_PROPERTY_VERSION_MINOR),
                     property(RTC_DEVICE_PROPERTY_VERSION_PATCH));
}

}  // namespace kaustik::accel
