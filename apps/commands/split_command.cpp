// kaustik split: divides a render among the tasks of a cluster.

#include <fmt/format.h>

#include <filesystem>

#include "apps/cluster/job_folder.h"
#include "apps/command_line/values.h"
#include "apps/commands/commands.h"
#include "apps/console/exit_error.h"
#include "apps/console/progress_bar.h"
#include "apps/machine/thread_limit.h"
#include "apps/session/isa_option.h"
#include "apps/session/render_session.h"
#include "apps/session/stopping/source_choice.h"
#include "render/settings/names.h"

namespace kaustik::app {

namespace {

struct SplitOptions {
  std::string scene, folder;
  uint64_t tasks = 0;
  Engine engine = Engine::kSlurm;
  SettingOverrides overrides;
};

// Passes for each task, where the settings name none: a task that is stopped loses one.
constexpr uint64_t kPassesEach = 4;

void settle_passes(const SplitOptions& options, render::RenderSettings* settings) {
  if (settings->passes == 0) {
    const uint64_t samples = std::min<uint64_t>(uint64_t(settings->spp), settings->photons);
    settings->passes = options.tasks * std::clamp<uint64_t>(samples / options.tasks, 1, kPassesEach);
  }
  if (settings->passes < options.tasks)
    refuse(fmt::format("--tasks {}: there are only {} passes to divide; --passes asks for more",
                       options.tasks, settings->passes));
}

// Settles all that the tasks share, radii included. Nothing if a signal arrived.
std::optional<render::PassSums> settle(const InterruptGuard& interrupt, const RenderSession& session,
                                       Job& job, const Console& console) {
  const accel::Bvh bvh(job.scene, job.settings.render.threads);
  ProgressBar bar(console);
  const render::ProgressCallback progress = shown_in(bar, interrupt);
  if (session.settle_sources) settle_sources(job.scene, bvh, &job.settings.render);
  return render::begin_passes(job.scene, bvh, job.settings.render, progress);
}

int run_split(const SplitOptions& options, const Console& console) {
  if (options.tasks == 0) refuse("--tasks is required: how many tasks render");
  if (options.folder.empty()) refuse("-o is required: the folder of the job");
  const InterruptGuard interrupt;
  Job job;
  with_thread_limit(options.overrides.alone().render.threads, console,
                    [&] { job = load_job(options.scene, options.overrides, console, LoadFor::kPhotons); });
  if (job.settings.stop.any()) refuse("--time and --target-error cannot be divided among tasks");
  settle_passes(options, &job.settings.render);
  check_photons_of_passes(job);
  make_job_folder(options.folder);
  RenderSession session;
  settle_session(options.overrides, console, &job, &session);
  std::optional<render::PassSums> sums;
  with_thread_limit(job.settings.render.threads, console,
                    [&] { sums = settle(interrupt, session, job, console); });
  if (!sums || interrupt.requested()) {
    console.error("interrupted; nothing was written");
    return kInterrupted;
  }
  const std::string stem = std::filesystem::path(options.scene).stem().string();
  const std::string& root = options.overrides.root();
  const JobFolder folder{options.folder, options.tasks, sums->shares, options.engine,
                         root.empty() ? "" : absolute_path(root)};
  render::write_partial(folder.start(), manifest_of(job, {}, {}, *sums), *sums);
  write_job(folder, {stem + ".exr", stem + ".png"});
  console.note(fmt::format("{}: {} passes in {}; {}/{} starts them", options.folder, grouped(folder.passes),
                           counted(folder.tasks, "task"), options.folder,
                           options.engine == Engine::kSlurm ? "submit.sh" : "run.sh"));
  return kDone;
}

}  // namespace

Command make_split_command() {
  Command command("split", "Divide a render among the tasks of a cluster");
  const auto options = std::make_shared<SplitOptions>();
  command.add_argument("SCENE", options->scene, "Scene file, which all machines must see under this path");
  command.add_parsed("--tasks", "COUNT", "Number of tasks, among which the passes are divided",
                     [options](const std::string& text) {
                       const std::optional<uint64_t> tasks = parse_count(text);
                       if (!tasks || *tasks < 1 || *tasks > render::kMostPasses)
                         throw OptionError(
                             "--tasks", fmt::format("`{}`: expected a whole number, 1 to 2147483647", text));
                       options->tasks = *tasks;
                     });
  command.add_text("-o,--output", "FOLDER", options->folder,
                   "Folder to write, which must not exist or be empty");
  Option& engine = command.add_parsed("--engine", "NAME",
                                      "Who runs the tasks. slurm: an array job and a merge after it. shell: "
                                      "a script, for GNU parallel and other "
                                      "queues. Default: slurm",
                                      [options](const std::string& text) {
                                        const auto found = render::from_name<Engine>(kEngineNames, text);
                                        if (!found)
                                          throw OptionError(
                                              "--engine", fmt::format("`{}`: expected slurm or shell", text));
                                        options->engine = *found;
                                      });
  engine.choices = choices_of(kEngineNames);
  add_isa_option(command);
  command.add_quiet();
  add_setting_options(command, options->overrides, SettingsCommand::kRender);
  command.examples =
      "  kaustik split room.pbrt --tasks 64 --spp 1024 --photons 1G -o job\n"
      "  job/submit.sh --cpus-per-task=16 --time=2:00:00\n"
      "  kaustik status job";
  command.run = [options](const Console& console) { return run_split(*options, console); };
  return command;
}

}  // namespace kaustik::app
