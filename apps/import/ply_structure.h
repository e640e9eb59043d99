#pragma once
// Walks over a PLY file without storing anything.

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace kaustik::pbrt {

struct PlyStructure {
  uint64_t vertices = 0, faces = 0;
  uint64_t triangles = 0;  // after triangulation
  bool polygons = false;   // some face has more than three vertices
};

// Nothing, with a sentence that says where in the file, when the bytes are no complete PLY mesh.
std::optional<PlyStructure> check_ply(std::string_view bytes, std::string& error);

}  // namespace kaustik::pbrt
