#pragma once
// The sensor that the Film and Camera lines describe.

#include "core/camera/sensor.h"
#include "core/diagnostics/diagnostics.h"
#include "core/scene/description/description.h"

namespace kaustik {

// pbrt-v4's sensor "cie1931": radiance times exposure time (s) times iso / 100; if a white balance is given,
// also the adaptation that makes light of that colour temperature white. Other sensors of pbrt are replaced
// by this one, with a warning; unknown sensors and a shutter that does not open are errors. Parameters that
// violate the schema are reported when the schema is checked, not here.
Sensor build_sensor(const SceneDescription& description, DiagnosticList& diagnostics);

}  // namespace kaustik
