#pragma once
// What a scene of another format lacks before it can be rendered.

#include "core/diagnostics/diagnostics.h"
#include "core/scene/description/description.h"

namespace kaustik {

// A camera that sees the box of all shapes from the side of +z and a little above, and a white sky of
// radiance 1 where nothing shines: each with a warning that says so.
void add_missing_view(SceneDescription& scene, const SourceLocation& where, DiagnosticList& diagnostics);

// The camera's transform: it stands at `eye` and looks at `target`, +y up, +x of a right-handed world to its
// right (pbrt's LookAt is for left-handed ones).
glm::dmat4 camera_looking_at(const glm::dvec3& eye, const glm::dvec3& target);

}  // namespace kaustik
