#include "apps/sweep/sweep_grid.h"

#include <fmt/format.h>

#include <algorithm>

#include "apps/command_line/values.h"
#include "apps/command_line/whole_numbers.h"
#include "apps/console/exit_error.h"
#include "core/diagnostics/nearest_name.h"
#include "render/plan/plan.h"
#include "render/settings/names.h"

namespace kaustik::app {

namespace {

constexpr uint64_t kMostSamples = 1'000'000'000;
constexpr uint64_t kMostSeeds = 10'000;

template <class Value>
void add_once(std::string_view option, const std::string& text, Value value, std::vector<Value>* values) {
  if (std::find(values->begin(), values->end(), value) != values->end())
    refuse(fmt::format("{}: `{}` is given twice", option, text));
  values->push_back(std::move(value));
}

std::vector<RadiusChoice> radii_from(const std::vector<std::string>& texts) {
  std::vector<RadiusChoice> radii;
  for (const std::string& text : texts) {
    const std::optional<RadiusChoice> radius = parse_radius(text);
    if (!radius)
      refuse(
          fmt::format("--radius: `{}`: expected auto, a multiple of it like 0.5x, or metres above 0", text));
    add_once("--radius", text, *radius, &radii);
  }
  return radii;
}

std::vector<render::Method> methods_from(const std::vector<std::string>& texts) {
  std::vector<render::Method> methods;
  for (const std::string& text : texts) {
    const auto method = render::from_name<render::Method>(render::kMethodNames, text);
    if (!method)
      refuse(fmt::format("--methods: unknown method `{}`{}", text, name_hint(text, render::kMethodNames)));
    add_once("--methods", text, *method, &methods);
  }
  return methods;
}

// Checks here what the render would refuse later, so that nothing has been rendered in vain.
void check_passes(uint64_t passes, uint64_t photons) {
  if (passes > photons)
    refuse(fmt::format("--photons: {} photons cannot be divided among {} passes", count_text(photons),
                       count_text(passes)));
}

}  // namespace

SweepGrid parse_grid(const GridTexts& texts) {
  SweepGrid grid;
  grid.photons = whole_numbers("--photons", texts.photons);
  grid.radii = radii_from(texts.radii);
  grid.methods = methods_from(texts.methods);
  for (const uint64_t spp : whole_numbers("--spp", texts.spp, kMostSamples))
    grid.spp.push_back(static_cast<int>(spp));
  grid.seeds = whole_number("--seeds", texts.seeds, kMostSeeds);
  if (grid.photons.empty()) refuse("--photons: expected at least one count");
  if (grid.radii.empty()) refuse("--radius: expected at least one radius");
  return grid;
}

Settings settings_at(const SweepPoint& point, const SweepGrid& grid, const Settings& base,
                     const SettingOverrides& overrides) {
  Settings settings = base;
  render::RenderSettings& s = settings.render;
  s.spp = point.spp;
  if (!grid.methods.empty()) {
    s.method = point.method;
    if (!overrides.sets("direct")) s.direct.reset();
    if (!overrides.sets("caustics")) s.caustics.reset();
    if (!overrides.sets("indirect")) s.indirect.reset();
  }
  if (point.reads_photons()) {
    s.photons = point.photons;
    s.balance = render::Balance::kOff;
    point.radius.apply(settings);
  }
  return settings;
}

std::vector<SweepPoint> points_of(const SweepGrid& grid, const Settings& base,
                                  const SettingOverrides& overrides, const SceneNeeds& needs) {
  const auto methods = grid.methods.empty() ? std::vector{base.render.method} : grid.methods;
  const auto samples = grid.spp.empty() ? std::vector{base.render.spp} : grid.spp;
  std::vector<SweepPoint> points;
  for (const render::Method method : methods)
    for (const int spp : samples) {
      const SweepPoint bare{.method = method, .spp = spp, .radius = {}};
      const Settings settings = settings_at(bare, grid, base, overrides);
      if (!render::needs_photons(settings.render, needs)) {
        points.push_back(bare);
        continue;
      }
      for (const uint64_t photons : grid.photons) {
        check_passes(base.render.passes, photons);
        for (const RadiusChoice& radius : grid.radii) points.push_back({method, spp, photons, radius});
      }
    }
  return points;
}

std::string flags_of(const SweepPoint& point, const SweepGrid& grid, const SettingOverrides& overrides) {
  std::string flags;
  const auto add = [&](std::string_view name, const std::string& value) {
    flags += fmt::format("{}--{} {}", flags.empty() ? "" : " ", name, value);
  };
  if (!grid.methods.empty()) add("method", std::string(render::name_of(point.method)));
  if (point.reads_photons()) {
    add("photons", count_text(point.photons));
    add("radius", point.radius.text());
  }
  if (!grid.spp.empty() || !point.reads_photons()) add("spp", fmt::format("{}", point.spp));
  const Settings given = overrides.alone();
  for (const Setting& setting : settings_table())
    if (overrides.sets(setting.name))
      add(setting.name, fmt::format("{}", fmt::join(setting.show(given), " ")));
  return flags;
}

}  // namespace kaustik::app
