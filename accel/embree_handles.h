#pragma once
// Owns an Embree device and scene.

#include "accel/embree_error.h"
#include "accel/embree_isa.h"

namespace kaustik::accel {

// Releasing the device still calls its memory monitor, so declare the counter that the monitor writes to
// before this member.
struct EmbreeHandles {
  RTCDevice device = nullptr;
  RTCScene scene = nullptr;

  EmbreeHandles() = default;
  EmbreeHandles(const EmbreeHandles&) = delete;
  EmbreeHandles& operator=(const EmbreeHandles&) = delete;
  ~EmbreeHandles() {
    if (scene) rtcReleaseScene(scene);
    if (device) rtcReleaseDevice(device);
  }

  // Throws std::runtime_error when Embree provides no device.
  void open_device() {
    const std::string& isa = embree_isa_limit();
    device = rtcNewDevice(isa.empty() ? nullptr : ("isa=" + isa).c_str());
    if (!device) throw_embree(rtcGetDeviceError(nullptr), "opening the device");
  }
};

}  // namespace kaustik::accel
