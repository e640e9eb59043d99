#pragma once
// An Embree device and scene that are released with their owner.

#include "accel/embree_error.h"

namespace kaustik::accel {

// Releasing the device still calls its memory monitor: declare what that writes to before this member.
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

  // Throws std::runtime_error when Embree gives no device.
  void open_device() {
    device = rtcNewDevice(nullptr);
    if (!device) throw_embree(rtcGetDeviceError(nullptr), "opening the device");
  }
};

}  // namespace kaustik::accel
