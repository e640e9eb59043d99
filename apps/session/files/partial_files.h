#pragma once
// Builds the manifest of a partial result from a render job, and the settings of a job from a manifest.

#include <functional>
#include <string>
#include <vector>

#include "apps/session/files/scene_loading.h"
#include "render/passes/partial_result.h"

namespace kaustik::app {

std::string absolute_path(const std::string& path);

// For example "0.1.0 (c9c1c43), Embree 3.13.5, OpenImageIO 2.4.7, C library 2.36": the program and the
// libraries that affect its results. The first call creates an Embree device to ask for its version, so make
// it before rendering, and loads OpenImageIO.
std::string program_build();

// Throws ExitError (bad command line) for a file name that is not UTF-8, as manifests must be.
void check_utf8(const std::vector<std::string>& names);

// The settings that `listed` picks, by the names of their options, as texts that set them to the same values.
render::SettingTexts setting_texts(const Settings& settings,
                                   const std::function<bool(const Setting&)>& listed);

// The manifest for the sums of a job. `outputs`: the file names as given. An empty `goal` means all passes
// that the settings ask for.
render::PartialManifest manifest_of(const Job& job, const std::vector<std::string>& outputs,
                                    const render::PassSet& goal, const render::PassSums& sums,
                                    const std::string& stopped_by = {});

// Calls read_partial. Throws ExitError (bad command line) for a file that cannot be used.
render::PartialResult load_partial(const std::string& path);

// Settings of the file `path`, as if given on the command line. Throws ExitError (bad command line), which
// names the file, when a setting is unknown or has a bad value.
SettingOverrides overrides_from(const render::SettingTexts& settings, const std::string& path);

// All settings of a manifest.
SettingOverrides settings_of(const render::PartialManifest& manifest, const std::string& path);

// Throws ExitError (bad command line) unless this program on this machine computes the same bits as the one
// that wrote the file `path`: it must be the same build with the same instruction set. why: "their passes
// cannot be combined".
void check_program(const std::string& build, const std::string& isa, const std::string& path,
                   std::string_view why);

}  // namespace kaustik::app
