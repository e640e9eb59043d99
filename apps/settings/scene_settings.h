#pragma once
// Reads the render settings of a scene file from its Film, Sampler and Integrator directives.

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "apps/settings/table/settings.h"
#include "core/diagnostics/diagnostics.h"
#include "core/scene/description/description.h"

namespace kaustik::app {

struct SceneSettings {
  Settings settings;               // the defaults, changed as the file says
  int width = 1280, height = 720;  // from Film; these are pbrt's defaults
  std::string output;              // Film "filename"; empty when not given
  bool fixed_screen_window =
      false;  // the camera sets its screen window: another aspect ratio must not change it
  std::vector<std::string> notes;  // one sentence each, for the log
};

// Interprets the directives. Sampler "pixelsamples" sets the samples per pixel; Film sets the size, the crop
// and the default output. Integrator "photonmap" takes every setting of settings_table() by its name (dashes
// may be left out). Integrator "sppm" sets shadow rays, caustic photons and indirect photons, with its
// maxdepth, photonsperiteration and radius. For any other integrator of pbrt the method stays auto, with the
// file's maxdepth, and a note says so. maxdepth defaults to 5, as in pbrt. Each parameter of pbrt's
// integrators that has no effect here gives a warning, as does an unknown integrator, for which auto is used
// as well. Unknown parameters of "photonmap" and bad values are errors.
SceneSettings settings_from_scene(const SceneDescription& description, DiagnosticList& diagnostics);

}  // namespace kaustik::app
