#pragma once
// Adds a camera and a light to scenes of other formats (glTF, OBJ) that have none.

#include "core/diagnostics/diagnostics.h"
#include "core/scene/description/description.h"

namespace kaustik {

// Adds, each with a warning, what the scene lacks: a camera that sees the bounding box of all shapes from +z
// and slightly above, and a white sky of radiance 1. Emitters that hardly light the scene (stand_in_sky.h) do
// not replace the sky.
void add_missing_view(SceneDescription& scene, const SourceLocation& where, Diagnostics& diagnostics);

// The camera-to-world transform of a camera at `eye` that looks at `target`, with +y up. For right-handed
// worlds: seen along -z, +x points right. (pbrt's LookAt assumes a left-handed world.)
glm::dmat4 camera_looking_at(const glm::dvec3& eye, const glm::dvec3& target);

}  // namespace kaustik
