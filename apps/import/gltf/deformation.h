#pragma once
// Applies the skins and morph targets of a glTF file to its meshes, in one pose.

#include <map>
#include <vector>

#include "apps/import/gltf/file/document.h"
#include "apps/import/gltf/nodes.h"
#include "core/scene/description/description.h"

namespace kaustik::gltf {

class Deformation {
 public:
  Deformation(const Document& document, const Pose& pose, const std::vector<PlacedNode>& nodes);

  // Whether a skin or morph weights deform the node's mesh. It then cannot be an instance of the shared mesh.
  bool applies_to(uint64_t node) const;
  // Deforms P and N of a primitive's triangles. True if they are then in world space: with a skin, the joints
  // place the mesh, not the node.
  bool apply(uint64_t node, const View& primitive, ShapeDescription& shape) const;

 private:
  std::vector<double> weights_of(uint64_t node) const;
  void morph(const View& primitive, const std::vector<double>& weights, ShapeDescription& shape) const;
  std::vector<glm::dmat4> joints_of(const View& skin) const;
  void bend(const View& primitive, const std::vector<glm::dmat4>& joints, ShapeDescription& shape) const;

  const Document& document_;
  const Pose& pose_;
  std::map<uint64_t, glm::dmat4> to_world_;  // by node
};

}  // namespace kaustik::gltf
