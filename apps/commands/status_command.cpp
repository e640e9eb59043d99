// kaustik status: what the tasks of a job have rendered.

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <filesystem>

#include "apps/cluster/job_folder.h"
#include "apps/cluster/job_scripts.h"
#include "apps/commands/commands.h"
#include "apps/console/exit_error.h"

namespace kaustik::app {

namespace {

struct TaskState {
  uint64_t task = 0;
  render::PassSet done, missing;
  std::string trouble;  // why its part cannot be used; empty: it can
};

TaskState state_of(const JobFolder& job, uint64_t task, const render::PartialResult& start) {
  TaskState state{task, {}, job.passes_of(task), {}};
  if (!std::filesystem::exists(job.part(task))) return state;
  try {
    const render::PartialResult part = render::read_partial(job.part(task));
    state.trouble = render::difference(start, part);
    if (state.trouble.empty()) state.done = part.sums.passes.common(job.passes_of(task));
  } catch (const render::PartialError& error) {
    state.trouble = error.what();
  }
  state.missing = state.missing.without(state.done);
  return state;
}

// The command that renders what is missing.
std::string command_for(const JobFolder& job, const std::vector<uint64_t>& tasks) {
  const std::string path = quoted(job.path);
  if (job.engine == Engine::kSlurm) return fmt::format("TASKS={} {}/submit.sh", fmt::join(tasks, ","), path);
  std::string command;
  for (const uint64_t task : tasks) command += fmt::format("{}/task.sh {} && ", path, task);
  return command + path + "/merge.sh";
}

int run_status(const std::string& path, const Console& console) {
  const JobFolder job = read_job_folder(path);
  const render::PartialResult start = load_partial(job.start());
  if (start.sums.shares != job.passes) refuse(fmt::format("{}: job.json is not that of start.kpart", path));
  render::PassSet done, missing;
  std::vector<uint64_t> unfinished;
  for (uint64_t task = 0; task < job.tasks; ++task) {
    const TaskState state = state_of(job, task, start);
    done.add(state.done), missing.add(state.missing);
    if (state.missing.empty()) continue;
    unfinished.push_back(task);
    console.out << fmt::format("task {}: {} of {} passes done, missing {}{}\n", task, state.done.count(),
                               job.passes_of(task).count(), state.missing.text(),
                               state.trouble.empty() ? "" : fmt::format("; remove it: {}", state.trouble));
  }
  console.out << fmt::format("{} of {} passes done in {} of {} tasks\n", done.count(), job.passes,
                             job.tasks - unfinished.size(), job.tasks);
  if (unfinished.empty())
    console.out << fmt::format("{}/merge.sh writes the picture\n", quoted(path));
  else
    console.out << fmt::format("missing passes {}: {}\n", missing.text(), command_for(job, unfinished));
  return kDone;
}

}  // namespace

Command make_status_command() {
  Command command("status", "Show which passes of a job that `split` has written are done");
  const auto folder = std::make_shared<std::string>();
  command.add_argument("FOLDER", *folder, "Folder of the job");
  command.run = [folder](const Console& console) { return run_status(*folder, console); };
  return command;
}

}  // namespace kaustik::app
