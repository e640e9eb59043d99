#pragma once
// Finds cameras that stand in another medium than the light by mistake.

#include "core/diagnostics/diagnostics.h"
#include "core/scene/scene.h"

namespace kaustik {

// Warns where a light shines in a medium to which no surfaces lead from the camera's. Directives are read in
// their order, so that a `MediumInterface` behind `Camera` does not move the camera.
void check_camera_medium(const Scene& scene, const SourceLocation& camera, DiagnosticList& diagnostics);

}  // namespace kaustik
