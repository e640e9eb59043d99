// kaustik resume: continues a render from a partial result.

#include <fmt/format.h>

#include "apps/command_line/values.h"
#include "apps/commands/commands.h"
#include "apps/console/exit_error.h"
#include "apps/machine/thread_limit.h"
#include "apps/session/files/output_files.h"
#include "apps/session/isa_option.h"
#include "apps/session/render_session.h"
#include "apps/session/stopping/stop_rules.h"
#include "render/plan/plan.h"

namespace kaustik::app {

namespace {

struct ResumeOptions {
  std::string partial, scene;
  OutputOptions outputs;
  LiveOptions live;
  double checkpoint_every = CheckpointSettings{}.every;
  uint64_t passes = 0;     // total number at the end; 0 = as the partial result's settings say
  render::PassSet only;    // the passes to render, into a checkpoint of their own; empty: all
  std::string checkpoint;  // of `only`
  double rank_timeout = kRankTimeout;
  SettingOverrides overrides;
};

// The passes that exist at the end.
render::PassSet goal_of(const ResumeOptions& options, const render::PartialResult& part) {
  const render::PassSet& goal = part.manifest.goal;
  if (!options.only.empty()) {
    if (const render::PassSet others = options.only.without(goal); !others.empty())
      throw ExitError(kBadCommandLine, fmt::format("--pass-range {}: {} asks for passes {}",
                                                   options.only.text(), options.partial, goal.text()));
    return options.only;
  }
  if (options.passes == 0) return goal;
  if (options.passes < part.sums.passes.end())
    throw ExitError(kBadCommandLine, fmt::format("--passes {}: {} already holds passes {}", options.passes,
                                                 options.partial, part.sums.passes.text()));
  return render::PassSet(goal.first(), options.passes);
}

// Loads the scene with the settings of the partial result. Throws ExitError if the scene's contents have
// changed.
Job load_again(const ResumeOptions& options, const render::PartialManifest& manifest,
               const Console& console) {
  SettingOverrides overrides = settings_of(manifest, options.partial);
  overrides.append(options.overrides);
  const std::string& scene = options.scene.empty() ? manifest.scene_path : options.scene;
  Job job;
  with_thread_limit(overrides.alone().render.threads, console,
                    [&] { job = load_job(scene, overrides, console); });
  if (job.content_hash != manifest.scene_hash)
    throw ExitError(
        kBadCommandLine,
        fmt::format("{} is not the scene of {}: the contents of its files differ", scene, options.partial));
  return job;
}

// Checks the stop rules, whether given now or stored in the partial result.
void check_rules(const ResumeOptions& options, const Job& job, const render::PassSet& goal,
                 const Console& console) {
  const StopSettings& stop = job.settings.stop;
  check_stop_settings(stop);
  if (!stop.any()) return;
  if (!options.only.empty())
    throw ExitError(kBadCommandLine,
                    "--pass-range cannot be combined with --target-error or --time, given or stored");
  if (goal.first() > 0)
    throw ExitError(
        kBadCommandLine,
        fmt::format("{} is only a part of a render, passes {}: --target-error and --time cannot be used",
                    options.partial, goal.text()));
  const render::RenderSettings& settings = job.settings.render;
  const bool photons = render::needs_photons(settings, job.scene.needs);
  if (stop.target_error && photons && !settings.estimate_bias.value_or(false))
    console.warning(
        fmt::format("the passes of {} did not measure their bias: --target-error limits the noise "
                    "alone",
                    options.partial));
}

int run_resume(const ResumeOptions& options, const Console& console) {
  const Stopwatch total;
  const std::unique_ptr<Ranks> ranks = join_ranks(options.rank_timeout, console);
  const InterruptGuard interrupt;
  if (ranks && !ranks->leads()) return serve_passes(*ranks, {}, options.overrides, interrupt, console);
  check_outputs(options.outputs);
  const std::string& checkpoint = options.checkpoint.empty() ? options.partial : options.checkpoint;
  check_writable(checkpoint);
  if (!options.checkpoint.empty())
    check_collisions({{"--checkpoint", checkpoint}},
                     {{"the partial result", options.partial}, {"the scene", options.scene}});
  render::PartialResult part = load_partial(options.partial);
  check_program(part.manifest.build, part.manifest.isa, options.partial, "their passes cannot be combined");
  RenderSession session;
  session.ranks = ranks.get();
  session.goal = goal_of(options, part);
  session.outputs = options.outputs;
  session.live = options.live;
  if (session.outputs.files.empty() && options.only.empty()) {
    session.outputs.files = part.manifest.outputs;
    for (const std::string& file : session.outputs.files)
      check_below_root(options.overrides.root(), options.partial, file);
  }
  check_outputs(session.outputs);
  check_collisions(named_files(session.outputs),
                   {{"the checkpoint", checkpoint}, {"the partial result", options.partial}});
  session.checkpoint = {checkpoint, options.checkpoint_every};
  if (!options.only.empty()) part.sums.passes = {};  // only its radii
  Job job = load_again(options, part.manifest, console);
  check_collisions(named_files(session.outputs), files_of(job));
  check_collisions({{"--checkpoint", checkpoint}}, files_of(job));
  session.bounded = options.passes > 0;
  check_rules(options, job, session.goal, console);
  const bool open = job.settings.stop.any() && !session.bounded;
  console.note(fmt::format("{} holds passes {}; to render: {}", options.partial, part.sums.passes.text(),
                           open ? "as many as needed" : session.goal.without(part.sums.passes).text()));
  session.done = std::move(part.sums);
  return run_session(job, std::move(session), interrupt, total, console);
}

void add_part_options(Command& command, ResumeOptions& options) {
  Option& range = command.add_parsed(
      "--pass-range", "A:B",
      "Render only passes A to B - 1, into a partial result of their own, with the settings and radii of "
      "PART, "
      "which stays as it is. `kaustik merge` combines the parts",
      [&options](const std::string& text) { options.only = parse_ranges("--pass-range", "passes", text); });
  range.needs = {"--checkpoint"};
  range.excludes = {"--passes"};
  command
      .add_text(
          "--checkpoint", "FILE", options.checkpoint,
          "Partial result (.kpart) of the passes of --pass-range, written from time to time and at the end")
      .needs = {"--pass-range"};
}

void add_resume_options(Command& command, ResumeOptions& options) {
  command.add_parsed(
      "--passes", "COUNT",
      "Total number of passes at the end, which may exceed the number that the render asked for. Default: "
      "that number",
      [&options](const std::string& text) {
        const std::optional<uint64_t> passes = parse_count(text);
        if (!passes || *passes < 1 || *passes > render::kMostPasses)
          throw OptionError("--passes", fmt::format("`{}`: expected a whole number, 1 to 2147483647", text));
        options.passes = *passes;
      });
  command.add_parsed(
      "--checkpoint-every", "TIME",
      "Least time between checkpoints, which are written at the end of a pass. Default: 60s",
      [&options](const std::string& text) { options.checkpoint_every = checkpoint_interval(text); });
}

}  // namespace

Command make_resume_command() {
  Command command("resume", "Continue a render from its checkpoint");
  const auto options = std::make_shared<ResumeOptions>();
  command.add_argument("PART", options->partial, "Partial result (.kpart): a checkpoint, or merged parts");
  add_output_options(command, options->outputs, "the files of the interrupted render");
  add_live_options(command, options->live);
  add_resume_options(command, *options);
  add_part_options(command, *options);
  command.add_text("--scene", "FILE", options->scene,
                   "Path of the scene if it has moved; its contents must be the same. Default: the path "
                   "stored in PART");
  add_isa_option(command);
  add_rank_options(command, options->rank_timeout);
  command.add_quiet();
  add_setting_options(command, options->overrides, SettingsCommand::kResume);
  command.run = [options](const Console& console) { return run_resume(*options, console); };
  return command;
}

}  // namespace kaustik::app
