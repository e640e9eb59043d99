#include "apps/import/gltf/nodes.h"

#include <fmt/format.h>

#include <glm/gtc/quaternion.hpp>

namespace kaustik::gltf {
namespace {

// The matrix of a translation, a rotation (quaternion x, y, z, w, of any length) and a scale.
glm::dmat4 transform_of(const std::vector<double>& t, const std::vector<double>& r,
                        const std::vector<double>& s, FileWarnings& warnings) {
  const double length = std::sqrt(r[0] * r[0] + r[1] * r[1] + r[2] * r[2] + r[3] * r[3]);
  const bool turns = length > 0;
  if (!turns) warnings.count("rotations by a quaternion of zeros are left out", "node");
  const glm::dquat q = turns ? glm::dquat(r[3], r[0], r[1], r[2]) / length : glm::dquat(1, 0, 0, 0);
  glm::dmat3 m = glm::mat3_cast(q);
  for (int k = 0; k < 3; ++k) m[k] *= s[static_cast<size_t>(k)];
  glm::dmat4 out(m);
  out[3] = glm::dvec4(t[0], t[1], t[2], 1);
  return out;
}

glm::dmat4 local_transform(const View& node, const NodePose* pose, FileWarnings& warnings) {
  const View matrix = node["matrix"];
  const bool moved = pose && (pose->translation || pose->rotation || pose->scale);
  if (matrix && !moved) {
    const std::vector<double> m = matrix.numbers(16, {});
    glm::dmat4 out;
    for (int i = 0; i < 16; ++i) out[i / 4][i % 4] = m[static_cast<size_t>(i)];
    return out;
  }
  std::vector<double> t = node["translation"].numbers(3, {0, 0, 0});
  std::vector<double> r = node["rotation"].numbers(4, {0, 0, 0, 1});
  std::vector<double> s = node["scale"].numbers(3, {1, 1, 1});
  if (moved) {
    t = pose->translation.value_or(t);
    r = pose->rotation.value_or(r);
    s = pose->scale.value_or(s);
  }
  return transform_of(t, r, s, warnings);
}

bool is_visible(const View& node) {
  return node["extensions"]["KHR_node_visibility"]["visible"].flag(true);
}

// The root nodes of the file's default scene; in a file without scenes, every node that has no parent.
std::vector<uint64_t> roots_of(const Document& document) {
  const uint64_t nodes = document.size("nodes");
  std::vector<uint64_t> roots;
  if (document.size("scenes") > 0) {
    const uint64_t shown = document.root()["scene"].index(document.size("scenes")).value_or(0);
    const View list = document.item("scenes", shown)["nodes"];
    for (uint64_t i = 0; i < list.size(); ++i) roots.push_back(*list.at(i).index(nodes));
    return roots;
  }
  std::vector<bool> child(nodes, false);
  for (uint64_t n = 0; n < nodes; ++n) {
    const View children = document.item("nodes", n)["children"];
    for (uint64_t i = 0; i < children.size(); ++i) child[*children.at(i).index(nodes)] = true;
  }
  for (uint64_t n = 0; n < nodes; ++n) {
    if (!child[n]) roots.push_back(n);
  }
  return roots;
}

}  // namespace

std::vector<PlacedNode> placed_nodes(const Document& document, const Pose& pose, FileWarnings& warnings) {
  const uint64_t nodes = document.size("nodes");
  std::vector<bool> met(nodes, false);
  std::vector<PlacedNode> out, waiting;
  const auto push = [&](uint64_t n, const glm::dmat4& parent, bool animated) {
    if (met[n]) document.item("nodes", n).fail("has two parents or is its own ancestor");
    met[n] = true;
    waiting.push_back({n, parent, animated || pose.of(n) != nullptr});
  };
  const std::vector<uint64_t> roots = roots_of(document);
  for (size_t i = roots.size(); i-- > 0;) push(roots[i], glm::dmat4(1), false);
  while (!waiting.empty()) {
    PlacedNode at = waiting.back();
    waiting.pop_back();
    const View node = document.item("nodes", at.node);
    if (!is_visible(node)) continue;
    at.to_world = at.to_world * local_transform(node, pose.of(at.node), warnings);
    out.push_back(at);
    const View children = node["children"];
    for (uint64_t i = children.size(); i-- > 0;) push(*children.at(i).index(nodes), at.to_world, at.animated);
  }
  return out;
}

std::vector<glm::dmat4> instances_of(const Document& document, const View& node, FileWarnings& warnings) {
  const View attributes = node["extensions"]["EXT_mesh_gpu_instancing"]["attributes"];
  if (!attributes) return {glm::dmat4(1)};
  std::optional<uint64_t> count;
  const auto values = [&](const char* name, int components, const std::vector<double>& otherwise) {
    const auto accessor = attributes[name].index(document.size("accessors"));
    if (!accessor) return otherwise;
    const Elements e = document.elements(*accessor, components);
    if (count && *count != e.count)
      attributes[name].fail(fmt::format("must have {} instances, as the other attributes have", *count));
    count = e.count;
    return e.values;
  };
  const std::vector<double> t = values("TRANSLATION", 3, {}), r = values("ROTATION", 4, {}),
                            s = values("SCALE", 3, {});
  const auto part = [](const std::vector<double>& all, uint64_t i, size_t n, std::vector<double> otherwise) {
    if (all.empty()) return otherwise;
    const auto at = all.begin() + static_cast<std::ptrdiff_t>(i * n);
    return std::vector<double>(at, at + static_cast<std::ptrdiff_t>(n));
  };
  std::vector<glm::dmat4> out;
  for (uint64_t i = 0; i < count.value_or(0); ++i)
    out.push_back(transform_of(part(t, i, 3, {0, 0, 0}), part(r, i, 4, {0, 0, 0, 1}),
                               part(s, i, 3, {1, 1, 1}), warnings));
  return out;
}

}  // namespace kaustik::gltf
