#include "apps/session/files/partial_files.h"

#include <fmt/format.h>
#ifdef __GLIBC__
#include <gnu/libc-version.h>
#endif

#include <filesystem>
#include <nlohmann/json.hpp>

#include "accel/embree_version.h"
#include "apps/console/exit_error.h"
#include "apps/machine/instruction_set.h"
#include "core/version.h"
#include "render/picture/image_formats.h"

namespace kaustik::app {

namespace {

std::string program_and_libraries() {
  std::string build = fmt::format("{} ({}), Embree {}, OpenImageIO {}", version(), build_id(),
                                  accel::embree_version(), render::image_formats().version());
#ifdef __GLIBC__
  build += fmt::format(", C library {}", gnu_get_libc_version());
#endif
  return build;
}

}  // namespace

std::string absolute_path(const std::string& path) {
  return std::filesystem::absolute(path).lexically_normal().string();
}

void check_utf8(const std::vector<std::string>& names) {
  for (const std::string& name : names) {
    try {
      (void)nlohmann::json(name).dump();
    } catch (const nlohmann::json::exception&) {
      refuse(fmt::format("{}: the name is not UTF-8, as partial results and photon maps need it", name));
    }
  }
}

std::string program_build() {
  static const std::string build = program_and_libraries();
  return build;
}

render::SettingTexts setting_texts(const Settings& settings,
                                   const std::function<bool(const Setting&)>& listed) {
  render::SettingTexts out;
  for (const Setting& setting : settings_table()) {
    if (!listed(setting)) continue;
    if (std::vector<std::string> texts = setting.show(settings); !texts.empty())
      out.emplace_back(setting.name, std::move(texts));
  }
  return out;
}

render::PartialManifest manifest_of(const Job& job, const std::vector<std::string>& outputs,
                                    const render::PassSet& goal, const render::PassSums& sums,
                                    const std::string& stopped_by) {
  Settings settings = job.settings;
  settings.render.passes = sums.shares;  // the number of passes may have been raised to save memory
  render::PartialManifest manifest;
  manifest.build = program_build();
  manifest.isa = instruction_set();
  manifest.scene_path = absolute_path(job.path);
  manifest.scene_hash = job.content_hash;
  manifest.settings = setting_texts(settings, [](const Setting& s) { return s.decides_sums; });
  manifest.presentation = setting_texts(settings, [](const Setting& s) { return !s.decides_sums; });
  for (const std::string& output : outputs) manifest.outputs.push_back(absolute_path(output));
  manifest.goal = goal.empty() ? render::PassSet(0, sums.shares) : goal;
  if (!stopped_by.empty()) manifest.goal = sums.passes;
  manifest.stopped_by = stopped_by;
  manifest.needs = job.scene.needs;
  return manifest;
}

render::PartialResult load_partial(const std::string& path) {
  try {
    return render::read_partial(path);
  } catch (const render::PartialError& error) {
    throw ExitError(kBadCommandLine, error.what());
  }
}

SettingOverrides overrides_from(const render::SettingTexts& settings, const std::string& path) {
  SettingOverrides overrides;
  for (const auto& [name, texts] : settings) {
    const Setting* setting = find_setting(name);
    if (!setting)
      throw ExitError(kBadCommandLine, fmt::format("{}: it contains an unknown setting `{}`", path, name));
    try {
      overrides.add(*setting, texts);
    } catch (const OptionError& error) {
      throw ExitError(kBadCommandLine, fmt::format("{}: {}", path, error.what()));
    }
  }
  return overrides;
}

SettingOverrides settings_of(const render::PartialManifest& manifest, const std::string& path) {
  SettingOverrides overrides = overrides_from(manifest.settings, path);
  overrides.append(overrides_from(manifest.presentation, path));
  return overrides;
}

void check_program(const std::string& build, const std::string& isa, const std::string& path,
                   std::string_view why) {
  const auto require = [&](const std::string& there, const std::string& here, std::string_view what) {
    if (there == here) return;
    throw ExitError(kBadCommandLine, fmt::format("{}: it was made with {} {}, but this is {}: {}", path, what,
                                                 there, here, why));
  };
  require(build, program_build(), "kaustik");
  require(isa, instruction_set(), "the instruction set");
}

}  // namespace kaustik::app
