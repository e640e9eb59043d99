#include "apps/import/common/default_view.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "apps/import/common/make_parameter.h"
#include "apps/import/common/stand_in_sky.h"

namespace kaustik {
namespace {

struct Box {
  glm::dvec3 low{std::numeric_limits<double>::infinity()}, high{-std::numeric_limits<double>::infinity()};

  void add(const ShapeDescription& shape, const glm::dmat4& to_world) {
    const Parameter* P = shape.find("P");
    for (size_t i = 0; P && i + 2 < P->numbers.size(); i += 3) {
      const glm::dvec3 p(to_world * glm::dvec4(P->numbers[i], P->numbers[i + 1], P->numbers[i + 2], 1));
      low = glm::min(low, p);
      high = glm::max(high, p);
    }
  }
};

Box box_of(const SceneDescription& scene) {
  Box box;
  for (const ShapeDescription& shape : scene.shapes) box.add(shape, shape.object_to_world);
  for (const InstanceDescription& instance : scene.instances) {
    for (const ObjectDescription& object : scene.objects) {
      if (object.name != instance.object) continue;
      for (const ShapeDescription& shape : object.shapes)
        box.add(shape, instance.instance_to_world * shape.object_to_world);
    }
  }
  return box;
}

void add_camera(SceneDescription& scene, const SourceLocation& where) {
  constexpr double kFov = 40;  // degrees, of the shorter side
  const Box box = box_of(scene);
  const bool any = box.low.x <= box.high.x;
  const glm::dvec3 center = any ? 0.5 * (box.low + box.high) : glm::dvec3(0);
  const double radius = any ? std::max(0.5 * glm::length(box.high - box.low), 1e-30) : 1;
  const double distance = 1.05 * radius / std::sin(glm::radians(kFov / 2));
  const glm::dvec3 eye = center + distance * glm::normalize(glm::dvec3(0.35, 0.3, 1));
  DirectiveMaker<CameraDescription> camera("perspective", where);
  camera.number("fov", kFov);
  camera->camera_to_world = camera_looking_at(eye, center);
  scene.camera = std::move(*camera);
}

}  // namespace

glm::dmat4 camera_looking_at(const glm::dvec3& eye, const glm::dvec3& target) {
  const glm::dvec3 ahead = glm::normalize(target - eye);
  const glm::dvec3 right = glm::normalize(glm::cross(ahead, glm::dvec3(0, 1, 0)));
  return {glm::dvec4(right, 0), glm::dvec4(glm::cross(right, ahead), 0), glm::dvec4(ahead, 0),
          glm::dvec4(eye, 1)};
}

void add_missing_view(SceneDescription& scene, const SourceLocation& where, Diagnostics& diagnostics) {
  if (!scene.camera) {
    add_camera(scene, where);
    diagnostics.warning(where, "the file has no camera: one that sees the whole scene is used");
  }
  if (const double share = emitted_share(scene, diagnostics.files); share < kLeastEmittedShare) {
    DirectiveMaker<LightDescription> sky("infinite", where);
    sky.rgb("L", glm::dvec3(1));
    scene.lights.push_back(std::move(*sky));
    diagnostics.warning(where, fmt::format("the file has no light{}: a white sky of radiance 1 is used",
                                           share > 0 ? " that reaches its surfaces" : ""));
  }
}

}  // namespace kaustik
