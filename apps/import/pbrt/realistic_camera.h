#pragma once
// Replaces pbrt's camera "realistic", which traces rays through the elements of a lens, by the nearest thin
// lens.

#include <functional>
#include <optional>
#include <string>

#include "core/diagnostics/diagnostics.h"
#include "core/scene/description/description.h"

namespace kaustik::pbrt {

// Opens a file that the scene names: its id; nothing, with a message in `error`, when it cannot be read.
using OpenFile = std::function<std::optional<uint32_t>(const std::string& name, std::string& error)>;

// Makes the camera "perspective" with the lens's paraxial focal length, focused at `focusdistance`, with the
// same `aperturediameter`. The field of view follows from the film. Adds a warning that describes the result,
// or an error.
void replace_realistic_camera(CameraDescription& replaced, const Directive* film, const OpenFile& open,
                              Diagnostics& diagnostics);

}  // namespace kaustik::pbrt
