#pragma once
// Flattens the node hierarchy of a glTF file.

#include <glm/glm.hpp>
#include <vector>

#include "apps/import/gltf/animation.h"

namespace kaustik::gltf {

struct PlacedNode {
  uint64_t node = 0;
  glm::dmat4 to_world{1};
  bool animated = false;  // whether an animation changes it, or an ancestor
};

// All visible nodes of the file's scene in this pose, parents before children, in the order of the file.
// Throws FormatError for a node that has two parents or is its own ancestor.
std::vector<PlacedNode> placed_nodes(const Document& document, const Pose& pose, FileWarnings& warnings);

// Transforms from mesh to node: the identity, or one per instance of EXT_mesh_gpu_instancing.
std::vector<glm::dmat4> instances_of(const Document& document, const View& node, FileWarnings& warnings);

}  // namespace kaustik::gltf
