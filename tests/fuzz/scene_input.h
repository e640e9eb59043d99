#pragma once
// Scenes and meshes as inputs of fuzz targets.

#include <algorithm>
#include <filesystem>
#include <string>

#include "apps/import/import_scene.h"
#include "core/memory/process_memory.h"
#include "core/scene/shapes/mesh_loader.h"
#include "tests/fuzz/input_folder.h"

namespace kaustik::fuzz {

// Loads the scene as `kaustik render` does, and checks that it comes or that errors say why not, and that
// what is said about it can be printed.
inline void load_input_scene(const std::filesystem::path& path, ImportOptions options = {}) {
  constexpr uint64_t kMemory = 64u << 20;  // enough for any of these, and too little to take seconds
  options.room = MemoryRoom(held_memory() + kMemory, "the test");
  Diagnostics diagnostics;
  const auto loaded = pbrt::load_scene(path, diagnostics, options);
  if (loaded.has_value() == diagnostics.has_errors())
    throw Violation(loaded ? "a scene with errors was loaded" : "a scene was refused without an error");
  diagnostics.format_all();
}

// Loads a model under an even sky, since the studio of models without a light takes a thousand times longer
// to build than small models.
inline void load_input_model(const std::filesystem::path& path) {
  load_input_scene(path, {.view = {.sky = "1", .floor = Floor::kOff}});
}

// Checks that a mesh without an error has indices of its own vertices.
inline void check_mesh(const MeshResult& loaded) {
  if (!loaded.error.empty()) return;
  const TriangleMesh& mesh = loaded.mesh;
  for (const auto& triangle : mesh.indices)
    if (*std::max_element(triangle.begin(), triangle.end()) >= mesh.P.size())
      throw Violation("a triangle has an index out of range");
  for (const size_t size : {mesh.N.size(), mesh.uv.size()})
    if (size != 0 && size != mesh.P.size()) throw Violation("a mesh has incomplete attributes");
}

}  // namespace kaustik::fuzz
