#pragma once
// The subcommands. Each function adds a CLI11 subcommand with its options, and returns what to run after
// parsing.

#include <functional>
#include <memory>

#include "apps/console/console.h"
#include "apps/console/exit_code.h"

namespace CLI {
class App;
}

namespace kaustik::app {

struct Command {
  CLI::App* parser = nullptr;
  // Runs the command and returns the exit code. Throws ExitError, or any other exception for a failure during
  // the work.
  std::function<int(const Console&)> run;
  // Set by --quiet, if the command has this option.
  std::shared_ptr<bool> quiet = std::make_shared<bool>(false);
};

Command make_render_command(CLI::App& program);
Command make_resume_command(CLI::App& program);
Command make_merge_command(CLI::App& program);
Command make_photons_command(CLI::App& program);
Command make_compare_command(CLI::App& program);
Command make_info_command(CLI::App& program);
Command make_convert_command(CLI::App& program);
Command make_bench_command(CLI::App& program);
Command make_sweep_command(CLI::App& program);
Command make_reference_command(CLI::App& program);

}  // namespace kaustik::app
