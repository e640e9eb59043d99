#pragma once
// The function that reads mesh files for the builder; core knows no file format.

#include <functional>
#include <string>

#include "core/diagnostics/source_location.h"
#include "core/geometry/shape.h"

namespace kaustik {

// The result of loading a mesh file: a mesh in object space, or an error.
struct MeshResult {
  TriangleMesh mesh;
  std::string error;  // one sentence that names the file; empty on success
};
// Reads the mesh that the parameter at `where` names. Called from several threads at once.
using MeshLoader = std::function<MeshResult(const std::string& filename, const SourceLocation& where)>;

}  // namespace kaustik
