#pragma once
// The subcommands. Each adds its options to a CLI11 command and leaves there what to do once they are parsed.

#include <functional>
#include <memory>

#include "apps/console/console.h"
#include "apps/run.h"

namespace CLI {
class App;
}

namespace kaustik::app {

struct Command {
  CLI::App* parser = nullptr;
  // Returns the exit code; throws ExitError, or anything else for failures while working.
  std::function<int(const Console&)> run;
  // Set by --quiet where the command has it.
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

}  // namespace kaustik::app
