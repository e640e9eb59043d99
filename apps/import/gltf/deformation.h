#pragma once
// Meshes as skins and morph targets leave them where nothing is animated.

#include <map>
#include <vector>

#include "apps/import/gltf/document.h"
#include "apps/import/gltf/nodes.h"
#include "core/scene/description/description.h"

namespace kaustik::gltf {

class Deformation {
 public:
  Deformation(const Document& document, const std::vector<PlacedNode>& nodes);

  // Whether the node's mesh stands otherwise than the mesh is written, so that it is no instance of it.
  bool applies_to(const View& node) const;
  // Changes P and N of a primitive's triangles. True where they lie in the world then: a skin's joints place
  // them, not the node.
  bool apply(const View& node, const View& primitive, ShapeDescription& shape) const;

 private:
  std::vector<double> weights_of(const View& node) const;
  void morph(const View& primitive, const std::vector<double>& weights, ShapeDescription& shape) const;
  std::vector<glm::dmat4> joints_of(const View& skin) const;
  void bend(const View& primitive, const std::vector<glm::dmat4>& joints, ShapeDescription& shape) const;

  const Document& document_;
  std::map<uint64_t, glm::dmat4> to_world_;  // of nodes
};

}  // namespace kaustik::gltf
