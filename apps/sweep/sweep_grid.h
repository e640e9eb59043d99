#pragma once
// The grid of a sweep: which renders it is made of.

#include <optional>
#include <string>
#include <vector>

#include "apps/settings/number_settings.h"
#include "apps/settings/setting_options.h"
#include "core/scene/needs.h"
#include "render/settings.h"

namespace kaustik::app {

// The lists as they were typed. methods, spp: empty when not given; then the scene's own holds.
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

// One setting of the knobs: a point of the charts, rendered once for each seed.
struct SweepPoint {
  render::Method method = render::Method::kAuto;
  int spp = 1;
  uint64_t photons = 0;  // 0: the method reads no photons, and so no radius
  RadiusChoice radius;

  bool reads_photons() const { return photons > 0; }
  bool operator==(const SweepPoint&) const = default;
};

// Throws ExitError (bad command line): what is no photon count, radius, method or sample count, or is given
// twice.
SweepGrid parse_grid(const GridTexts& texts);

// Settings of a point, of any seed. Without --methods the estimators are the scene's own; with it, the
// method's but for those that the command line names.
Settings settings_at(const SweepPoint& point, const SweepGrid& grid, const Settings& base,
                     const SettingOverrides& overrides);

// By method, samples, photons, radius, as the lists have them. A method that reads no photons has one point
// for each sample count. Throws ExitError (bad command line) for a point with fewer photons than passes.
std::vector<SweepPoint> points_of(const SweepGrid& grid, const Settings& base,
                                  const SettingOverrides& overrides, const SceneNeeds& needs);

// "--method photon --photons 1M --radius 0.5x --width 64": what to type for the point, of the lists that the
// grid varies or the user gave, and the settings that the command line gave.
std::string flags_of(const SweepPoint& point, const SweepGrid& grid, const SettingOverrides& overrides);

}  // namespace kaustik::app
