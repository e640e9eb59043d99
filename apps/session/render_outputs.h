#pragma once
// Writes the output files and the closing report of the commands that make pictures.

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "apps/command_line/command.h"
#include "apps/console/console.h"
#include "apps/live/live_render.h"
#include "apps/session/files/collisions.h"
#include "apps/settings/table/settings.h"
#include "render/passes/partial_result.h"
#include "render/renderer.h"
#include "render/statistics_json.h"

namespace kaustik::app {

struct OutputOptions {
  std::vector<std::string> files;  // pictures and partial results
  std::string statistics;          // empty = none
};

// Adds -o and --stats. `by_default`: names what is written without -o, for the help.
void add_output_options(Command& command, OutputOptions& options, const std::string& by_default);

// Throws ExitError (bad command line) for a file that cannot be written.
void check_outputs(const OutputOptions& options);

// The files with the options that name them, for check_collisions().
std::vector<NamedFile> named_files(const OutputOptions& options);

// Warns of layers that none of the output files can hold: pictures other than EXR have none.
void warn_of_layers(const OutputOptions& options, const std::vector<std::string>& layers,
                    const Console& console);

// Everything that goes into the output files.
struct Outcome {
  const render::RenderResult& result;
  const Settings& settings;
  const render::PartialManifest& manifest;
  LiveRender* live = nullptr;       // shows the final picture, if not null
  nlohmann::ordered_json memory{};  // memory_json(), or null
};

// Writes all files of `options`, partial results only if at least one pass is complete, and the report. The
// log names each file. A file that cannot be written is an error message and does not cost the others; false
// then. `times.write` is set here.
bool write_outputs(const OutputOptions& options, const Outcome& outcome, render::OuterTimes times,
                   const Console& console);

// Logs the photons, the times, and warnings about dropped samples.
void report(const render::RenderResult& result, const render::OuterTimes& times, const Console& console);

}  // namespace kaustik::app
