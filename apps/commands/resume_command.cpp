// kaustik resume: goes on with a render from a partial result.

#include <fmt/format.h>

#include <CLI/CLI.hpp>

#include "apps/commands/commands.h"
#include "apps/console/exit_error.h"
#include "apps/machine/thread_limit.h"
#include "apps/session/output_files.h"
#include "apps/session/render_session.h"
#include "apps/session/stop_rules.h"
#include "apps/settings/values.h"
#include "render/maps/photon_maps.h"

namespace kaustik::app {

namespace {

struct ResumeOptions {
  std::string partial, scene;
  OutputOptions outputs;
  double checkpoint_every = CheckpointSettings{}.every;
  uint64_t passes = 0;  // 0: as the render was to have
  SettingOverrides overrides;
};

constexpr std::string_view kSettings[] = {"threads",         "aov", "exposure", "tonemap", "target-error",
                                          "target-quantile", "time"};

// The passes that there will be in the end.
render::PassSet goal_of(const ResumeOptions& options, const render::PartialResult& part) {
  const render::PassSet& goal = part.manifest.goal;
  if (options.passes == 0) return goal;
  if (options.passes < part.sums.passes.end())
    throw ExitError(kBadCommandLine, fmt::format("--passes {}: {} holds passes {} already", options.passes,
                                                 options.partial, part.sums.passes.text()));
  return render::PassSet(goal.first(), options.passes);
}

// The scene with the settings of the render that is gone on with.
Job load_again(const ResumeOptions& options, const render::PartialManifest& manifest,
               const Console& console) {
  SettingOverrides overrides = settings_of(manifest, options.partial);
  overrides.append(options.overrides);
  const std::string& scene = options.scene.empty() ? manifest.scene_path : options.scene;
  Job job;
  with_thread_limit(overrides.alone().render.threads, [&] { job = load_job(scene, overrides, console); });
  if (job.content_hash != manifest.scene_hash)
    throw ExitError(
        kBadCommandLine,
        fmt::format("{} is not the scene of {}: its files or meshes have changed", scene, options.partial));
  return job;
}

// Rules for when to stop, given now or held by the part.
void check_rules(const ResumeOptions& options, const Job& job, const render::PassSet& goal,
                 const Console& console) {
  const StopSettings& stop = job.settings.stop;
  check_stop_settings(stop);
  if (!stop.any()) return;
  if (goal.first() > 0)
    throw ExitError(
        kBadCommandLine,
        fmt::format("{} is the part of a render that is to hold passes {}: no --target-error, no --time",
                    options.partial, goal.text()));
  const render::RenderSettings& settings = job.settings.render;
  const bool photons = render::kinds_needed(render::make_plan(settings, job.scene.needs)).any();
  if (stop.target_error && photons && !settings.estimate_bias.value_or(false))
    console.warning(
        fmt::format("the passes of {} have not measured their bias: --target-error is held against the "
                    "noise alone",
                    options.partial));
}

int run_resume(const ResumeOptions& options, const Console& console) {
  const Stopwatch total;
  check_outputs(options.outputs);
  check_writable(options.partial);
  const InterruptGuard interrupt;
  render::PartialResult part = load_partial(options.partial);
  check_program(part.manifest, options.partial);
  RenderSession session;
  session.goal = goal_of(options, part);
  session.outputs = options.outputs;
  if (session.outputs.files.empty()) session.outputs.files = part.manifest.outputs;
  check_outputs(session.outputs);
  session.checkpoint = {options.partial, options.checkpoint_every};
  Job job = load_again(options, part.manifest, console);
  session.bounded = options.passes > 0;
  check_rules(options, job, session.goal, console);
  const bool open = job.settings.stop.any() && !session.bounded;
  console.note(fmt::format("{} holds passes {}; to render: {}", options.partial, part.sums.passes.text(),
                           open ? "until they are enough" : session.goal.without(part.sums.passes).text()));
  session.done = std::move(part.sums);
  return run_session(std::move(job), std::move(session), interrupt, total, console);
}

void add_pass_options(CLI::App& parser, ResumeOptions& options) {
  parser
      .add_option_function<std::string>(
          "--passes",
          [&options](const std::string& text) {
            const std::optional<uint64_t> passes = parse_count(text);
            if (!passes || *passes < 1 || *passes > render::kMostPasses)
              throw CLI::ValidationError("--passes",
                                         fmt::format("`{}`: expected a whole number, 1 to 2147483647", text));
            options.passes = *passes;
          },
          "Passes that there will be in the end, also more than the render was to have: each is like those "
          "that are there. Default: as the render was to have")
      ->option_text("COUNT");
  parser
      .add_option_function<std::string>(
          "--checkpoint-every",
          [&options](const std::string& text) { options.checkpoint_every = checkpoint_interval(text); },
          "Time between checkpoints, which replace PART at the end of a pass. Default: 60s")
      ->option_text("TIME");
}

}  // namespace

Command make_resume_command(CLI::App& program) {
  Command command;
  command.parser = program.add_subcommand("resume", "Go on with a render from its checkpoint");
  const auto options = std::make_shared<ResumeOptions>();
  CLI::App& parser = *command.parser;
  parser.add_option("PART", options->partial, "Partial result (.kpart): a checkpoint, or merged parts")
      ->required()
      ->option_text(" ");
  add_output_options(parser, options->outputs, "the files that the render was to write");
  add_pass_options(parser, *options);
  parser
      .add_option("--scene", options->scene,
                  "Where the scene lies now; its contents must be the same. Default: where it lay")
      ->option_text("FILE");
  parser.add_flag("-q,--quiet", *command.quiet, "No log and no progress; warnings and errors still come");
  add_setting_options(parser, options->overrides, kSettings);
  command.run = [options](const Console& console) { return run_resume(*options, console); };
  return command;
}

}  // namespace kaustik::app
