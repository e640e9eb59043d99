#include "apps/import/view/model_box.h"

#include <cmath>
#include <map>

namespace kaustik {
namespace {

using UsePoint = std::function<void(const glm::dvec3&)>;

void for_vertices(const ShapeDescription& shape, const glm::dmat4& to_world, const UsePoint& use) {
  const Parameter* P = shape.find("P");
  for (size_t i = 0; P && i + 2 < P->numbers.size(); i += 3) {
    const glm::dvec3 p(to_world * glm::dvec4(P->numbers[i], P->numbers[i + 1], P->numbers[i + 2], 1));
    if (std::isfinite(p.x + p.y + p.z)) use(p);
  }
}

void for_corners(const ModelBox& box, const glm::dmat4& to_world, const UsePoint& use) {
  for (int corner = 0; !box.empty && corner < 8; ++corner) {
    const glm::dvec3 p(corner & 1 ? box.high.x : box.low.x, corner & 2 ? box.high.y : box.low.y,
                       corner & 4 ? box.high.z : box.low.z);
    use(glm::dvec3(to_world * glm::dvec4(p, 1)));
  }
}

}  // namespace

void ModelBox::add(const glm::dvec3& p) {
  low = empty ? p : glm::min(low, p);
  high = empty ? p : glm::max(high, p);
  empty = false;
}

double ModelBox::radius() const {
  const double r = 0.5 * glm::length(high - low);
  return r > 0 && std::isfinite(r) ? r : 1;
}

void for_points(const SceneDescription& scene, const UsePoint& use) {
  for (const ShapeDescription& shape : scene.shapes) for_vertices(shape, shape.object_to_world, use);
  std::map<std::string_view, std::vector<ModelBox>> boxes;
  for (const ObjectDescription& object : scene.objects) {
    for (const ShapeDescription& shape : object.shapes) {
      ModelBox& box = boxes[object.name].emplace_back();
      for_vertices(shape, shape.object_to_world, [&](const glm::dvec3& p) { box.add(p); });
    }
  }
  for (const InstanceDescription& instance : scene.instances) {
    const auto found = boxes.find(instance.object);
    if (found == boxes.end()) continue;
    for (const ModelBox& box : found->second) for_corners(box, instance.instance_to_world, use);
  }
}

ModelBox box_of(const SceneDescription& scene) {
  ModelBox box;
  for_points(scene, [&](const glm::dvec3& p) { box.add(p); });
  return box;
}

}  // namespace kaustik
