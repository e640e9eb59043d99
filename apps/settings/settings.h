#pragma once
// Everything that `kaustik render` can be told, from whichever side: defaults, scene file, command line.

#include <optional>

#include "render/picture/tonemap.h"
#include "render/settings.h"

namespace kaustik::app {

// When a render has enough passes; with none of these, when it has as many as were asked for.
struct StopSettings {
  std::optional<double> target_error;     // relative, see render::relative_error()
  std::optional<double> target_quantile;  // of the pixels; unset: their mean
  std::optional<double> seconds;
  bool any() const { return target_error || seconds; }
};

struct Settings {
  render::RenderSettings render;
  render::ToneSettings tone;
  StopSettings stop;
};

}  // namespace kaustik::app
