#pragma once
// The extent of an imported scene.

#include <functional>
#include <glm/glm.hpp>

#include "core/scene/description/description.h"

namespace kaustik {

struct ModelBox {
  glm::dvec3 low{0}, high{0};
  bool empty = true;

  void add(const glm::dvec3& p);
  glm::dvec3 center() const { return 0.5 * (low + high); }
  // Half of the diagonal; 1 for a box without extent.
  double radius() const;
};

// Calls use(p) for points in world space whose convex hull holds every triangle mesh: the vertices, or the
// corners of the bounding boxes of instanced meshes. Other shapes are left out.
void for_points(const SceneDescription& scene, const std::function<void(const glm::dvec3&)>& use);

ModelBox box_of(const SceneDescription& scene);

}  // namespace kaustik
