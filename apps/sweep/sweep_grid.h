#pragma once
// The grid of a sweep: the combinations of settings that it renders.

#include <optional>
#include <string>
#include <vector>

#include "apps/settings/setting_options.h"
#include "apps/settings/table/number_settings.h"
#include "core/scene/needs.h"
#include "render/settings/settings.h"

namespace kaustik::app {

// The lists as typed. `methods` and `spp` may be empty; then the scene's own setting holds.
struct GridTexts {
  std::vector<std::string> photons = {"100k", "1M"}, radii = {"0.5x", "auto", "2x"}, methods{}, spp{};
  std::string seeds = "5";
};

struct SweepGrid {
  std::vector<uint64_t> photons;
  std::vector<RadiusChoice> radii;
  std::vector<render::Method> methods;
  std::vector<int> spp;
  uint64_t seeds = 5;
};

// One combination of settings: a point in the charts, rendered once per seed.
struct SweepPoint {
  render::Method method = render::Method::kAuto;
  int spp = 1;
  uint64_t photons = 0;  // 0 = the method uses no photons and hence no radius
  RadiusChoice radius;

  bool reads_photons() const { return photons > 0; }
  bool operator==(const SweepPoint&) const = default;
};

// Throws ExitError (bad command line) for an invalid photon count, radius, method or sample count, and for
// values given twice.
SweepGrid parse_grid(const GridTexts& texts);

// The settings of a point, without the seed. Without --methods the estimators are the scene's own; with it,
// they are the method's, except those that the command line names.
Settings settings_at(const SweepPoint& point, const SweepGrid& grid, const Settings& base,
                     const SettingOverrides& overrides);

// All points, ordered by method, samples, photons and radius as in the lists. A method that uses no photons
// has one point per sample count. Throws ExitError (bad command line) for a point with fewer photons than
// passes.
std::vector<SweepPoint> points_of(const SweepGrid& grid, const Settings& base,
                                  const SettingOverrides& overrides, const SceneNeeds& needs);

// The options that render the point, such as "--method photon --photons 1M --radius 0.5x --width 64": its
// values in the grid, and the settings given on the command line.
std::string flags_of(const SweepPoint& point, const SweepGrid& grid, const SettingOverrides& overrides);

}  // namespace kaustik::app
