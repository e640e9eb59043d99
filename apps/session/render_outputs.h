#pragma once
// What the commands that end in pictures write and report.

#include <string>
#include <vector>

#include "apps/console/console.h"
#include "apps/settings/settings.h"
#include "render/passes/partial_result.h"
#include "render/renderer.h"
#include "render/statistics_json.h"

namespace CLI {
class App;
}

namespace kaustik::app {

struct OutputOptions {
  std::vector<std::string> files;  // pictures and partial results
  std::string statistics;          // empty: none
};

// -o and --stats. by_default: what is written without -o, for the help.
void add_output_options(CLI::App& parser, OutputOptions& options, const std::string& by_default);

// Throws ExitError (bad command line) for what cannot be written.
void check_outputs(const OutputOptions& options);

// Everything that goes into the files.
struct Outcome {
  const render::RenderResult& result;
  const Settings& settings;
  const render::PartialManifest& manifest;
};

// All files of options, partial results only when a pass is complete; fills times.write. The log says which.
void write_outputs(const OutputOptions& options, const Outcome& outcome, render::OuterTimes times,
                   const Console& console);

// Photons, seconds, what was dropped.
void report(const render::RenderResult& result, const render::OuterTimes& times, const Console& console);

}  // namespace kaustik::app
