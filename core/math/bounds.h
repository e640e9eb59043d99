#pragma once
// Axis-aligned bounding boxes.

#include "core/math/vec.h"

namespace kaustik {

// Axis-aligned box; empty (min > max) until something is added.
struct Bounds3 {
  Point3 min{kInfinity}, max{-kInfinity};

  bool empty() const { return !(min.x <= max.x && min.y <= max.y && min.z <= max.z); }
  void add(const Point3& p) {
    min = glm::min(min, p);
    max = glm::max(max, p);
  }
  void add(const Bounds3& b) {
    min = glm::min(min, b.min);
    max = glm::max(max, b.max);
  }
  Point3 center() const { return 0.5f * min + 0.5f * max; }
  Vector3 diagonal() const { return empty() ? Vector3(0) : max - min; }
  // Radius of the sphere about center() that contains the box.
  float radius() const { return 0.5f * glm::length(diagonal()); }
};

}  // namespace kaustik
