#pragma once
// The folder of a render job that is divided into tasks: what `kaustik split` writes, and what its tasks
// leave.
//
//   job.json      number of tasks and passes, engine
//   start.kpart   a partial result of no pass: scene, settings, and the radii of the first pass
//   task.sh       renders the passes of one task into parts/TASK.kpart
//   merge.sh      adds the parts and writes the picture
//   submit.sh     submits both to Slurm; or run.sh, which runs them one after the other
//   parts, logs   folders

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "apps/session/files/partial_files.h"
#include "render/passes/pass_set.h"

namespace kaustik::app {

// Who runs the tasks.
enum class Engine { kSlurm, kShell };
inline constexpr std::array<std::string_view, 2> kEngineNames = {"slurm", "shell"};

struct JobFolder {
  std::string path;
  uint64_t tasks = 0, passes = 0;
  Engine engine = Engine::kSlurm;
  std::string root = {};  // --root of the tasks, for scripts that are written; empty: none

  // The passes of a task: their numbers differ by one at most.
  render::PassSet passes_of(uint64_t task) const;
  std::string start() const { return path + "/start.kpart"; }
  std::string part(uint64_t task) const;
};

// Creates the folder. Throws ExitError (bad command line) for one that exists and is not empty, or that
// cannot be written.
void make_job_folder(const std::string& path);

// Writes all but start.kpart into the folder. pictures: the files that merge.sh writes by default. Throws
// std::runtime_error for a file that cannot be written.
void write_job(const JobFolder& job, const std::vector<std::string>& pictures);

// Throws ExitError (bad command line) for a folder that `kaustik split` has not written.
JobFolder read_job_folder(const std::string& path);

}  // namespace kaustik::app
