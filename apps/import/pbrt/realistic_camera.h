#pragma once
// pbrt's camera "realistic", which traces rays through the elements of a lens, as the thin lens that comes
// nearest.

#include <functional>
#include <optional>
#include <string>

#include "core/diagnostics/diagnostics.h"
#include "core/scene/description/description.h"

namespace kaustik::pbrt {

// Opens a file that the scene names: its index, or nothing with what went wrong.
using OpenFile = std::function<std::optional<uint32_t>(const std::string& name, std::string& error)>;

// The camera becomes "perspective": of the lens's paraxial focal length, focused at `focusdistance`, with
// `aperturediameter` as it is. Its field of view follows from the film. Says so, or what is wrong.
void replace_realistic_camera(CameraDescription& replaced, const Directive* film, const OpenFile& open,
                              Diagnostics& diagnostics);

}  // namespace kaustik::pbrt
