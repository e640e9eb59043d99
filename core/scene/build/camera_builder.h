#pragma once
// Builds the camera from a scene description.

#include "core/camera/camera.h"
#include "core/scene/schema/schema.h"

namespace kaustik {

// Checks the Camera, Film and PixelFilter lines and builds the camera from them, with pbrt's defaults for
// what is absent. The camera is usable even after errors.
Camera build_camera(const SceneDescription& description, WarnedOnce& warned, DiagnosticList& diagnostics);

}  // namespace kaustik
