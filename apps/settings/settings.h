#pragma once
// Everything that `kaustik render` can be told, from whichever side: defaults, scene file, command line.

#include "render/settings.h"
#include "render/tonemap.h"

namespace kaustik::app {

struct Settings {
  render::RenderSettings render;
  render::ToneSettings tone;
};

}  // namespace kaustik::app
