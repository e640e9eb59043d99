#pragma once
// What a partial result says about the render that it belongs to, and a render from what it says.

#include <string>
#include <vector>

#include "apps/session/scene_loading.h"
#include "render/passes/partial_result.h"

namespace kaustik::app {

// "0.1.0 (c9c1c43), Embree 3.13.5, OpenImageIO 2.4.7, C library 2.36": the program, and the libraries whose
// bits it computes with. The first call asks Embree, best before it is at work, and loads OpenImageIO.
std::string program_build();

// Settings by the names of their options, as texts that assign what is set: those that decide the sums over
// samples, or the others.
render::SettingTexts setting_texts(const Settings& settings, bool that_decide_sums);

// What the sums of a job go with. outputs: as they were given. An empty goal stands for all passes that the
// settings ask for.
render::PartialManifest manifest_of(const Job& job, const std::vector<std::string>& outputs,
                                    const render::PassSet& goal, const render::PassSums& sums,
                                    const std::string& stopped_by = {});

// read_partial; a file that cannot be used is a bad command line (ExitError).
render::PartialResult load_partial(const std::string& path);

// Both kinds of settings, as if they had been given on the command line. path: for the ExitError (bad command
// line) when one is unknown or has a bad value.
SettingOverrides settings_of(const render::PartialManifest& manifest, const std::string& path);

// Throws ExitError (bad command line) unless this program on this machine can go on with the sums: the same
// build, the same instructions.
void check_program(const render::PartialManifest& manifest, const std::string& path);

}  // namespace kaustik::app
