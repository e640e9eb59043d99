#pragma once
// A scene description as text in pbrt-v4's format.

#include <functional>
#include <string>

#include "core/scene/description/description.h"

namespace kaustik::app {

// What stands beside the text.
struct SceneTextFiles {
  // The name to write for a file that a parameter names.
  std::function<std::string(const std::string& name, const SourceLocation& where)> file;
  // Takes a shape "trianglemesh"; gives the name of a PLY file that holds its vertices and faces, or an empty
  // one where they are to be written into the text.
  std::function<std::string(const ShapeDescription& shape)> mesh;
};

// Read again, it gives the same scene: numbers are written as short as they can be without changing, matrices
// in full. Materials all have names; those that had none are called "material N". What was written in blocks,
// includes, spectra or other color spaces is written out.
std::string scene_text(const SceneDescription& scene, const SceneTextFiles& files);

}  // namespace kaustik::app
