// kaustik render: renders a scene file to pictures.

#include <fmt/format.h>

#include <filesystem>

#include "apps/commands/commands.h"
#include "apps/console/exit_error.h"
#include "apps/machine/launched.h"
#include "apps/machine/thread_limit.h"
#include "apps/sequence/sequence.h"
#include "apps/session/files/output_files.h"
#include "apps/session/isa_option.h"
#include "apps/session/render_session.h"
#include "apps/settings/unread_settings.h"
#include "render/plan/plan.h"

namespace kaustik::app {

namespace {

struct RenderOptions {
  std::string scene;
  OutputOptions outputs;
  CheckpointSettings checkpoint;
  LiveOptions live;
  SequenceOptions sequence;
  std::string map, save_map;  // map files to read and to write; empty: none
  render::PassSet passes;
  double rank_timeout = kRankTimeout;
  SettingOverrides overrides;
};

// The files of -o, or the scene's Film "filename", or the scene's name as EXR in the working directory.
std::vector<std::string> outputs_of(const RenderOptions& options, const Job& job) {
  if (!options.outputs.files.empty()) return options.outputs.files;
  const std::string name = job.scene_output.empty()
                               ? std::filesystem::path(options.scene).stem().string() + ".exr"
                               : job.scene_output;
  if (!job.scene_output.empty()) check_below_root(options.overrides.root(), options.scene, name);
  check_image_output(name);
  return {name};
}

void check_passes(const RenderOptions& options, const Job& job) {
  check_photons_of_passes(job);
  if (!options.passes.empty() && job.settings.render.passes == 0)
    throw ExitError(
        kBadCommandLine,
        "--pass-range needs --passes, the number of passes among which photons and samples are divided");
  if (!options.passes.empty() && job.settings.stop.any())
    throw ExitError(kBadCommandLine, "--pass-range cannot be combined with --target-error or --time");
}

void note_checkpoint(const RenderOptions& options, const Console& console) {
  if (!options.checkpoint.path.empty() && std::filesystem::exists(options.checkpoint.path))
    console.warning(fmt::format("{} exists and will be replaced; `kaustik resume` would continue it",
                                options.checkpoint.path));
}

void warn_of_unread(const RenderOptions& options, const Job& job, const Console& console) {
  const render::EstimatorPlan plan = render::make_plan(job.settings.render, job.scene.needs);
  for (const std::string& warning : unread_settings(options.overrides, plan)) console.warning(warning);
}

// The files that the command writes, with the options that name them.
std::vector<NamedFile> files_of(const RenderOptions& options) {
  std::vector<NamedFile> files = named_files(options.outputs);
  files.push_back({"--checkpoint", options.checkpoint.path});
  files.push_back({"--save-map", options.save_map});
  return files;
}

// The file that is written where -o names none is the scene's choice.
void check_with_scene(RenderOptions options, const std::vector<std::string>& outputs, const Job& job) {
  const bool by_scene = options.outputs.files.empty();
  options.outputs.files = outputs;
  std::vector<NamedFile> files = files_of(options);
  if (by_scene) files.front().option = "the output";
  check_collisions(files, files_of(job));
}

// Whether ranks may share the passes: sequences and kept maps have none.
bool has_passes_to_share(const RenderOptions& options) {
  return !options.sequence.any() && options.map.empty() && options.save_map.empty();
}

// The ranks that an MPI launcher has started; null if there are none.
std::unique_ptr<Ranks> ranks_of(const RenderOptions& options, const Console& console) {
  std::unique_ptr<Ranks> ranks = join_ranks(options.rank_timeout, console);
  if (ranks && !has_passes_to_share(options))
    throw ExitError(ranks->leads() ? kBadCommandLine : kDone,
                    ranks->leads() ? "several ranks share the passes of one picture: sequences and kept "
                                     "maps take one process each"
                                   : "");
  return ranks;
}

int serve_render(const RenderOptions& options, Ranks& ranks, const Console& console) {
  const InterruptGuard interrupt;
  const auto load = [&](const Console& quiet) { return load_job(options.scene, options.overrides, quiet); };
  return serve_passes(ranks, load, options.overrides, interrupt, console);
}

int run_render(const RenderOptions& options, const Console& console) {
  const Stopwatch total;
  const std::unique_ptr<Ranks> ranks = ranks_of(options, console);
  if (ranks && !ranks->leads()) return serve_render(options, *ranks, console);
  if (!options.sequence.any()) check_outputs(options.outputs);
  if (options.sequence.overwrite && !options.sequence.any())
    throw ExitError(kBadCommandLine, "--overwrite needs --camera-path or --frames");
  if (!options.checkpoint.path.empty()) check_writable(options.checkpoint.path);
  if (!options.save_map.empty()) check_map_output(options.save_map);
  check_collisions(files_of(options), {{"the scene", options.scene}, {"--map", options.map}});
  const InterruptGuard interrupt;
  RenderSession session;
  session.launched = launched().ranks > 0 && has_passes_to_share(options);
  session.ranks = ranks.get();
  session.maps.save = options.save_map;
  if (!options.map.empty()) session.maps.from = open_map_file(options.map);
  const SettingOverrides overrides =
      session.maps.from ? with_settings_of(*session.maps.from, options.overrides) : options.overrides;
  Job job;
  with_thread_limit(overrides.alone().render.threads, console,
                    [&] { job = load_job(options.scene, overrides, console); });
  warn_of_unread(options, job, console);
  session.outputs = options.outputs, session.checkpoint = options.checkpoint, session.goal = options.passes;
  session.live = options.live;
  if (options.sequence.any()) {
    const Sequence sequence = make_sequence(options.sequence, session, job, console);
    settle_session(overrides, console, &job, &session);
    check_passes(options, job);
    return run_sequence(options.sequence, sequence, overrides, job, std::move(session), interrupt, console);
  }
  session.outputs.files = outputs_of(options, job);
  check_with_scene(options, session.outputs.files, job);
  warn_of_layers(session.outputs, job.settings.render.aov, console);
  settle_session(overrides, console, &job, &session);
  check_passes(options, job);
  note_checkpoint(options, console);
  return run_session(job, std::move(session), interrupt, total, console);
}

constexpr const char* kExamples =
    "  kaustik render room.pbrt -o room.exr -o room.png     radiance, and a picture for the screen\n"
    "  kaustik render model.glb -o model.png --time 2m      the best picture of two minutes\n"
    "  kaustik render room.pbrt -o room.png --quality draft --width 320\n"
    "  kaustik render room.pbrt -o room.exr --target-error 2% --time 1h\n"
    "  kaustik render room.pbrt --camera-path path.json --frames 0:48 -o out/frame.%04d.png\n"
    "  kaustik render room.pbrt -o caustic.exr --aov caustic --crop 100 300 200 400";

void add_map_options(Command& command, RenderOptions& options) {
  command.add_text("--save-map", "FILE", options.save_map,
                   "Keep the photon maps in this file (.kmap), for --map");
  command
      .add_text(
          "--map", "FILE", options.map,
          "Take the photon maps from this file, which --save-map or `kaustik shoot` has written, with its "
          "settings of the photons. Samples, radii and the camera may be others")
      .excludes = {"--save-map"};
}

void add_sequence_options(Command& command, RenderOptions& options) {
  command.add_text(
      "--camera-path", "FILE", options.sequence.camera_path,
      "Render a sequence along the camera path of this JSON file, to -o frame.%04d.exr. Photons of "
      "a world that stands still are shot once, and frames whose files exist are left as they are");
  command.add_parsed(
      "--frames", "A:B",
      "Frames A to B - 1 of the camera path, or of an animated glTF file at 24 frames a second. "
      "Default: all",
      [&options](const std::string& text) {
        options.sequence.frames = parse_ranges("--frames", "frames", text);
      });
  command.add_flag("--overwrite", options.sequence.overwrite, "Render frames whose files exist again");
}

void add_pass_options(Command& command, RenderOptions& options) {
  command.add_text(
      "--checkpoint", "FILE", options.checkpoint.path,
      "Write the complete passes to this partial result (.kpart) from time to time and at the end. `kaustik "
      "resume` continues from it");
  command
      .add_parsed(
          "--checkpoint-every", "TIME",
          "Least time between checkpoints, like 60s, 10m or 1.5h. They are written at the end of a pass. "
          "Default: 60s",
          [&options](const std::string& text) { options.checkpoint.every = checkpoint_interval(text); })
      .needs = {"--checkpoint"};
  command.add_parsed(
      "--pass-range", "A:B",
      "Render only passes A to B - 1; needs --passes. `kaustik merge` combines the parts. Default: all",
      [&options](const std::string& text) { options.passes = parse_ranges("--pass-range", "passes", text); });
}

}  // namespace

Command make_render_command() {
  Command command("render", "Render a scene to EXR, PNG or JPEG files");
  const auto options = std::make_shared<RenderOptions>();
  command.add_argument("SCENE", options->scene, "Scene file: .pbrt, .gltf, .glb, .obj, .ply or .stl");
  add_output_options(command, options->outputs,
                     "the scene's Film \"filename\", else the scene's name with .exr");
  add_pass_options(command, *options);
  add_map_options(command, *options);
  add_sequence_options(command, *options);
  add_live_options(command, options->live);
  add_isa_option(command);
  add_rank_options(command, options->rank_timeout);
  command.add_quiet();
  add_setting_options(command, options->overrides, SettingsCommand::kRender);
  command.examples = kExamples;
  command.run = [options](const Console& console) { return run_render(*options, console); };
  return command;
}

}  // namespace kaustik::app
