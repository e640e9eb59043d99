#include "apps/import/gltf/deformation.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

namespace kaustik::gltf {
namespace {

std::vector<double>* numbers_of(ShapeDescription& shape, std::string_view name) {
  for (Parameter& p : shape.parameters) {
    if (p.name == name) return &p.numbers;
  }
  return nullptr;
}

// Reads a vertex attribute. Throws unless it has as many elements as there are vertices.
std::optional<std::vector<double>> attribute(const Document& document, const View& attributes,
                                             const char* name, int components, uint64_t vertices) {
  const auto accessor = attributes[name].index(document.size("accessors"));
  if (!accessor) return std::nullopt;
  if (document.count(*accessor) != vertices)
    attributes[name].fail(fmt::format("must have as many vertices as the positions, {}", vertices));
  return document.elements(*accessor, components).values;
}

glm::dvec3 at(const std::vector<double>& v, size_t i) {
  return {v[3 * i], v[3 * i + 1], v[3 * i + 2]};
}

void set(std::vector<double>& v, size_t i, const glm::dvec3& x) {
  for (size_t k = 0; k < 3; ++k) v[3 * i + k] = x[static_cast<int>(k)];
}

}  // namespace

Deformation::Deformation(const Document& document, const Pose& pose, const std::vector<PlacedNode>& nodes)
    : document_(document), pose_(pose) {
  for (const PlacedNode& n : nodes) to_world_.emplace(n.node, n.to_world);
}

// The morph weights of the node in its pose, or else of its mesh; empty if all are zero.
std::vector<double> Deformation::weights_of(uint64_t index) const {
  const View node = document_.item("nodes", index);
  const NodePose* pose = pose_.of(index);
  const auto mesh = node["mesh"].index(document_.size("meshes"));
  View list = node["weights"];
  if (!list && mesh) list = document_.item("meshes", *mesh)["weights"];
  std::vector<double> weights;
  for (uint64_t i = 0; i < list.size(); ++i) weights.push_back(list.at(i).number());
  if (pose && pose->weights) weights = *pose->weights;
  const bool none = std::all_of(weights.begin(), weights.end(), [](double w) { return w == 0; });
  return none ? std::vector<double>() : weights;
}

bool Deformation::applies_to(uint64_t node) const {
  return document_.item("nodes", node).has("skin") || !weights_of(node).empty();
}

bool Deformation::apply(uint64_t node, const View& primitive, ShapeDescription& shape) const {
  morph(primitive, weights_of(node), shape);
  const auto skin = document_.item("nodes", node)["skin"].index(document_.size("skins"));
  if (!skin || !primitive["attributes"].has("JOINTS_0") || !primitive["attributes"].has("WEIGHTS_0"))
    return false;
  bend(primitive, joints_of(document_.item("skins", *skin)), shape);
  return true;
}

void Deformation::morph(const View& primitive, const std::vector<double>& weights,
                        ShapeDescription& shape) const {
  const View targets = primitive["targets"];
  for (const auto& [from, to] : {std::pair{"POSITION", "P"}, std::pair{"NORMAL", "N"}}) {
    std::vector<double>* values = numbers_of(shape, to);
    for (uint64_t t = 0; values && t < std::min<uint64_t>(targets.size(), weights.size()); ++t) {
      if (weights[t] == 0) continue;
      const auto moved = attribute(document_, targets.at(t), from, 3, values->size() / 3);
      for (size_t i = 0; moved && i < values->size(); ++i) (*values)[i] += weights[t] * (*moved)[i];
    }
  }
}

// For each joint, the transform from the mesh's bind pose to the world.
std::vector<glm::dmat4> Deformation::joints_of(const View& skin) const {
  std::vector<glm::dmat4> joints;
  const View list = skin["joints"];
  std::vector<double> inverse;
  if (const auto accessor = skin["inverseBindMatrices"].index(document_.size("accessors")))
    inverse = document_.elements(*accessor, 16).values;
  if (!inverse.empty() && inverse.size() < 16 * list.size())
    skin["inverseBindMatrices"].fail(fmt::format("has fewer matrices than the {} joints", list.size()));
  for (uint64_t j = 0; j < list.size(); ++j) {
    const auto found = to_world_.find(list.at(j).index(document_.size("nodes")).value_or(0));
    glm::dmat4 m = found == to_world_.end() ? glm::dmat4(1) : found->second;
    glm::dmat4 bound(1);
    for (size_t k = 0; k < 16 && !inverse.empty(); ++k)
      bound[static_cast<int>(k / 4)][static_cast<int>(k % 4)] = inverse[16 * j + k];
    joints.push_back(m * bound);
  }
  return joints;
}

// Linear blend skinning: transforms each vertex by the weighted mean of its four joints.
void Deformation::bend(const View& primitive, const std::vector<glm::dmat4>& joints,
                       ShapeDescription& shape) const {
  std::vector<double>* P = numbers_of(shape, "P");
  std::vector<double>* N = numbers_of(shape, "N");
  const size_t vertices = P->size() / 3;
  const View attributes = primitive["attributes"];
  const auto which = attribute(document_, attributes, "JOINTS_0", 4, vertices);
  const auto weights = attribute(document_, attributes, "WEIGHTS_0", 4, vertices);
  for (size_t i = 0; i < vertices; ++i) {
    glm::dmat4 m(0);
    double sum = 0;
    for (size_t k = 4 * i; k < 4 * i + 4; ++k) {
      const double w = (*weights)[k];
      if (w == 0) continue;
      if (!((*which)[k] >= 0 && (*which)[k] < double(joints.size())))
        attributes["JOINTS_0"].fail(
            fmt::format("names joint {}, but there are {}", (*which)[k], joints.size()));
      m += w * joints[static_cast<size_t>((*which)[k])];
      sum += w;
    }
    if (!(sum > 0)) continue;
    m /= sum;
    set(*P, i, glm::dvec3(m * glm::dvec4(at(*P, i), 1)));
    if (N) set(*N, i, glm::transpose(glm::inverse(glm::dmat3(m))) * at(*N, i));
  }
  // Joints that cancel each other leave no normal.
  if (N && std::any_of(N->begin(), N->end(), [](double v) { return !std::isfinite(v); }))
    std::erase_if(shape.parameters, [](const Parameter& p) { return p.name == "N"; });
}

}  // namespace kaustik::gltf
