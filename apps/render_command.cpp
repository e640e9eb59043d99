// kaustik render: a scene file to pictures.

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>

#include "apps/commands.h"
#include "apps/console/progress_bar.h"
#include "apps/exit_error.h"
#include "apps/interrupt.h"
#include "apps/output_files.h"
#include "apps/render_job.h"
#include "apps/scene_loading.h"
#include "apps/stopwatch.h"
#include "apps/thread_limit.h"
#include "render/image_io.h"
#include "render/names.h"

namespace kaustik::app {

namespace {

struct RenderOptions {
  std::string scene;
  std::vector<std::string> outputs;
  std::string statistics;
  SettingOverrides overrides;
};

// What -o says, or the scene's Film "filename", or the scene's name as EXR in the working directory.
std::vector<std::string> outputs_of(const RenderOptions& options, const Job& job) {
  if (!options.outputs.empty()) return options.outputs;
  const std::string name = job.scene_output.empty()
                               ? std::filesystem::path(options.scene).stem().string() + ".exr"
                               : job.scene_output;
  check_image_output(name);
  return {name};
}

RenderOutcome render_with_bar(const Job& job, const InterruptGuard& interrupt, const Console& console) {
  const render::EstimatorPlan plan = render::make_plan(job.settings.render, job.scene.needs);
  for (const std::string& note : plan.notes) console.note(note);
  ProgressBar bar(console);
  return render_job(job.scene, job.settings.render, [&](const render::Progress& progress) {
    bar.update(progress);
    return !interrupt.requested();
  });
}

void write_outputs(const std::vector<std::string>& outputs, const Job& job,
                   const render::RenderResult& result) {
  render::WriteOptions write;
  write.layers = render::layers_from_names(job.settings.render.aov);
  write.metadata = render::metadata_of(result, job.settings.render);
  write.tone = job.settings.tone;
  for (const std::string& path : outputs) render::write_film(path, result.film, write);
}

void report_photons(const render::RenderResult& result, const Console& console) {
  const render::RenderStatistics& s = result.statistics;
  if (s.photons.emitted == 0) return;
  std::string stored;
  for (size_t k = 0; k < s.photons.stored.size(); ++k) {
    stored +=
        fmt::format("{}{} {}", k == 0 ? "" : ", ", photon::kPhotonKindNames[k], grouped(s.photons.stored[k]));
  }
  console.note(fmt::format("photons: {} emitted; stored: {}", grouped(s.photons.emitted), stored));
  if (s.radius > 0) console.note(fmt::format("gather radius: {:.4g} m", s.radius));
  if (result.plan.direct == render::DirectEstimator::kLecture) {
    console.note(fmt::format(
        "lecture: {} points from photons ({} after climbing); shadow rays at {} with too few photons, "
        "{} with shadow photons, {} near a cell's face",
        grouped(s.lecture.from_photons), grouped(s.lecture.climbed), grouped(s.lecture.fallback_few),
        grouped(s.lecture.fallback_shadow), grouped(s.lecture.fallback_face)));
  }
}

void report(const render::RenderResult& result, const render::OuterTimes& times, const Console& console) {
  const render::RenderStatistics& s = result.statistics;
  report_photons(result, console);
  console.note(fmt::format(
      "seconds: load {:.2f}, bvh {:.2f}, photon trace {:.2f}, photon build {:.2f}, render {:.2f}, "
      "write {:.2f}, total {:.2f}",
      times.load, times.bvh, s.photon_trace_s, s.photon_build_s, s.render_s, times.write, times.total));
  if (s.dropped_samples > 0) {
    console.warning(
        fmt::format("{} samples were not finite or negative and count as black", s.dropped_samples));
    for (const render::DroppedSample& example : s.dropped_examples) console.note("  " + example.text());
  }
}

int run_render(const RenderOptions& options, const Console& console) {
  const Stopwatch total;
  for (const std::string& path : options.outputs) check_image_output(path);
  if (!options.statistics.empty()) check_writable(options.statistics);
  const InterruptGuard interrupt;
  const int load_threads = options.overrides.alone().render.threads;
  Job job;
  with_thread_limit(load_threads, [&] { job = load_job(options.scene, options.overrides, console); });
  const std::vector<std::string> outputs = outputs_of(options, job);

  int code = kDone;
  with_thread_limit(job.settings.render.threads, [&] {
    RenderOutcome outcome = render_with_bar(job, interrupt, console);
    if (outcome.result.cancelled || interrupt.requested()) {
      console.error("interrupted; no picture was written");
      code = kInterrupted;
      return;
    }
    const Stopwatch write_watch;
    write_outputs(outputs, job, outcome.result);
    outcome.times.load = job.load_seconds;
    outcome.times.write = write_watch.seconds();
    outcome.times.total = total.seconds();
    if (!options.statistics.empty()) {
      write_text_file(options.statistics, render::statistics_json(outcome.result, job.settings.render,
                                                                  job.scene.needs, outcome.times));
    }
    report(outcome.result, outcome.times, console);
    for (const std::string& path : outputs) console.note("wrote " + path);
    if (!options.statistics.empty()) console.note("wrote " + options.statistics);
  });
  return code;
}

}  // namespace

Command make_render_command(CLI::App& program) {
  Command command;
  command.parser = program.add_subcommand("render", "Render a scene to EXR, PNG or JPEG files");
  const auto options = std::make_shared<RenderOptions>();
  CLI::App& parser = *command.parser;
  parser.add_option("SCENE", options->scene, "Scene file in pbrt-v4's text format")
      ->required()
      ->option_text(" ");
  parser
      .add_option("-o,--output", options->outputs,
                  "Picture to write: .exr (float, with layers), .png, .jpg. Give it again for more files. "
                  "Default: the scene's Film \"filename\"")
      ->option_text("FILE")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  parser.add_option("--stats", options->statistics, "Write counts, times and settings as JSON")
      ->option_text("FILE");
  parser.add_flag("-q,--quiet", *command.quiet, "No log and no progress; warnings and errors still come");
  add_setting_options(parser, options->overrides);
  command.run = [options](const Console& console) { return run_render(*options, console); };
  return command;
}

}  // namespace kaustik::app
