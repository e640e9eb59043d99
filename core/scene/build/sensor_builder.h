#pragma once
// The sensor that the Film and Camera lines describe.

#include "core/camera/sensor.h"
#include "core/diagnostics/diagnostics.h"
#include "core/scene/description/description.h"

namespace kaustik {

// pbrt-v4's sensor "cie1931": radiance times exposure time (s) times iso / 100, then, where a white balance
// is given, the adaptation that makes light of that colour temperature white. Other sensors of pbrt are taken
// for this one, with a warning; unknown ones and a shutter that does not open are errors. Parameters that the
// schema refuses are left to it.
Sensor build_sensor(const SceneDescription& description, DiagnosticList& diagnostics);

}  // namespace kaustik
