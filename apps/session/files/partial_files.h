#pragma once
// Builds the manifest of a partial result from a render job, and the settings of a job from a manifest.

#include <string>
#include <vector>

#include "apps/session/files/scene_loading.h"
#include "render/passes/partial_result.h"

namespace kaustik::app {

// For example "0.1.0 (c9c1c43), Embree 3.13.5, OpenImageIO 2.4.7, C library 2.36": the program and the
// libraries that affect its results. The first call creates an Embree device to ask for its version, so make
// it before rendering, and loads OpenImageIO.
std::string program_build();

// Settings by the names of their options, as texts that set them to the same values. Returns the settings
// that affect the sums over samples, or all others.
render::SettingTexts setting_texts(const Settings& settings, bool that_decide_sums);

// The manifest for the sums of a job. `outputs`: the file names as given. An empty `goal` means all passes
// that the settings ask for.
render::PartialManifest manifest_of(const Job& job, const std::vector<std::string>& outputs,
                                    const render::PassSet& goal, const render::PassSums& sums,
                                    const std::string& stopped_by = {});

// Calls read_partial. Throws ExitError (bad command line) for a file that cannot be used.
render::PartialResult load_partial(const std::string& path);

// All settings of a manifest, as if given on the command line. Throws ExitError (bad command line), which
// names `path`, when a setting is unknown or has a bad value.
SettingOverrides settings_of(const render::PartialManifest& manifest, const std::string& path);

// Throws ExitError (bad command line) unless this program on this machine can continue the sums: it must be
// the same build with the same instruction set.
void check_program(const render::PartialManifest& manifest, const std::string& path);

}  // namespace kaustik::app
