#pragma once
// Applies the skins and morph targets of a glTF file to its meshes, in the pose that the file states;
// animations are not played.

#include <map>
#include <vector>

#include "apps/import/gltf/document.h"
#include "apps/import/gltf/nodes.h"
#include "core/scene/description/description.h"

namespace kaustik::gltf {

class Deformation {
 public:
  Deformation(const Document& document, const std::vector<PlacedNode>& nodes);

  // Whether a skin or morph weights deform the node's mesh. It then cannot be an instance of the shared mesh.
  bool applies_to(const View& node) const;
  // Deforms P and N of a primitive's triangles. True if they are then in world space: with a skin, the joints
  // place the mesh, not the node.
  bool apply(const View& node, const View& primitive, ShapeDescription& shape) const;

 private:
  std::vector<double> weights_of(const View& node) const;
  void morph(const View& primitive, const std::vector<double>& weights, ShapeDescription& shape) const;
  std::vector<glm::dmat4> joints_of(const View& skin) const;
  void bend(const View& primitive, const std::vector<glm::dmat4>& joints, ShapeDescription& shape) const;

  const Document& document_;
  std::map<uint64_t, glm::dmat4> to_world_;  // by node
};

}  // namespace kaustik::gltf
