#pragma once
// The hierarchy of a glTF file, laid flat.

#include <glm/glm.hpp>
#include <vector>

#include "apps/import/gltf/document.h"

namespace kaustik::gltf {

struct PlacedNode {
  uint64_t node = 0;
  glm::dmat4 to_world{1};
};

// Every node of the file's scene, parents before children, in the order of the file. A node that is met twice
// (two parents, or its own ancestor) is an error.
std::vector<PlacedNode> placed_nodes(const Document& document);

// Where the node's mesh stands in it: once, or as often as EXT_mesh_gpu_instancing says.
std::vector<glm::dmat4> instances_of(const Document& document, const View& node);

}  // namespace kaustik::gltf
