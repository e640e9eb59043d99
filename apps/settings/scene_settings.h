#pragma once
// What a scene file says about how it wants to be rendered: its Film, Sampler and Integrator lines.

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "apps/settings/settings.h"
#include "core/diagnostics/diagnostics.h"
#include "core/scene/description/description.h"

namespace kaustik::app {

struct SceneSettings {
  Settings settings;               // defaults, overlaid with what the file says
  int width = 1280, height = 720;  // of the Film line; pbrt's defaults
  std::string output;              // Film "filename"; empty when not given
  bool fixed_screen_window =
      false;                       // the camera line gives its own: another aspect ratio must not replace it
  std::vector<std::string> notes;  // one sentence each, for the log
};

// Interprets the lines. Sampler "pixelsamples" is the samples per pixel; Film gives the size, the crop and
// the default output. Integrator "photonmap" takes every setting of settings_table() by its name (dashes may
// be left out). Integrator "sppm" asks for shadow rays, caustic photons and indirect photons with its
// maxdepth, photonsperiteration and radius; "path" for method mc with its maxdepth (both: 5 when not given,
// as in pbrt). Any other integrator of pbrt is a note, and the method stays auto. Parameters that pbrt knows
// and that mean nothing here are one warning each; unknown ones, unknown integrators and bad values are
// errors.
SceneSettings settings_from_scene(const SceneDescription& description, DiagnosticList& diagnostics);

}  // namespace kaustik::app
