#pragma once
// Replaces pbrt's camera "realistic", which traces rays through the elements of a lens, by the nearest thin
// lens.

#include "apps/import/common/scene_files.h"
#include "core/diagnostics/diagnostics.h"
#include "core/scene/description/description.h"

namespace kaustik::pbrt {

// Makes the camera "perspective" with the lens's paraxial focal length, focused at `focusdistance`, with the
// same `aperturediameter`. The field of view follows from the film. Adds a warning that describes the result,
// or an error.
void replace_realistic_camera(CameraDescription& replaced, const Directive* film, const TextOpener& open,
                              Diagnostics& diagnostics);

}  // namespace kaustik::pbrt
