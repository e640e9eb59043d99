#pragma once
// Writes a scene description as text in pbrt-v4's format.

#include <functional>
#include <string>

#include "core/scene/description/description.h"

namespace kaustik::app {

// How the text names the files beside it.
struct SceneTextFiles {
  // Returns the name to write for a file that a parameter names.
  std::function<std::string(const std::string& name, const SourceLocation& where)> file;
  // Takes a shape "trianglemesh" and returns the name of a PLY file that holds its vertices and faces, or an
  // empty string to have them written into the text.
  std::function<std::string(const ShapeDescription& shape)> mesh;
};

// Reading the text gives the same scene: numbers have as few digits as identify them, matrices are written in
// full. Unnamed materials are called "material N". The result has no includes, spectra or other colour
// spaces, and each directive carries its own transform.
std::string scene_text(const SceneDescription& scene, const SceneTextFiles& files);

}  // namespace kaustik::app
