#pragma once
#include "core/camera/camera.h"
#include "core/scene/schema/schema.h"

namespace kaustik {

// Checks the Camera and Film lines and makes the camera from them; pbrt's defaults for what is absent. Errors
// leave a usable camera.
Camera build_camera(const SceneDescription& description, WarnedOnce& warned, DiagnosticList& diagnostics);

// True when m is affine and can be inverted in float precision.
bool is_usable_transform(const glm::dmat4& m);

}  // namespace kaustik
