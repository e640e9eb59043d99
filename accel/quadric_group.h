#pragma once
// Spheres, disks and other quadrics as Embree's user geometry, intersected by core/geometry.

#include <cstdint>
#include <vector>

#include "accel/embree_api.h"
#include "core/scene/scene.h"

namespace kaustik::accel {

// The shapes behind one Embree user geometry, one primitive each.
struct QuadricGroup {
  const Scene* scene = nullptr;
  std::vector<uint32_t> members;
  float to_scene = 1, to_embree = 1;  // lengths
  bool has_alpha = false;             // at least one member has alpha

  const Shape& shape(uint32_t primitive) const { return scene->shapes[members[primitive]]; }

  void add(const Shape& shape, uint32_t index) {
    members.push_back(index);
    has_alpha |= shape.has_alpha();
  }
};

// All members are of the same type, an AnalyticShape. Their hits name the shape. Embree points to the group
// while rays are traced.
RTCGeometry make_geometry(RTCDevice device, QuadricGroup& group);

}  // namespace kaustik::accel
