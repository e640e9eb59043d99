#pragma once
// All settings of a render, from whichever source: defaults, scene file, command line.

#include <optional>

#include "apps/settings/table/import_options.h"
#include "render/picture/tonemap.h"
#include "render/settings/settings.h"

namespace kaustik::app {

// The rules that decide when a render has enough passes. Without any, it renders the number of passes asked
// for.
struct StopSettings {
  std::optional<double> target_error;     // relative, see render::relative_error()
  std::optional<double> target_quantile;  // of the pixels; unset = their mean
  std::optional<double> seconds;          // time limit
  bool any() const { return target_error || seconds; }
};

// How PNG and JPEG files show radiance.
struct ToneChoice {
  std::optional<float> exposure;  // stops; unset = automatic, see render::automatic_exposure()
  render::Tonemap tonemap = render::Tonemap::kFilmic;
};

// The settings of a render for which nothing is given: those of --quality medium.
inline render::RenderSettings medium_quality() {
  render::RenderSettings settings;
  settings.photons = 4'000'000;
  settings.balance = render::Balance::kOn;
  settings.spp = 8;
  settings.sample_balance = render::Balance::kOn;
  return settings;
}

struct Settings {
  render::RenderSettings render = medium_quality();
  ToneChoice tone;
  StopSettings stop;
  ImportOptions import_options;
};

}  // namespace kaustik::app
