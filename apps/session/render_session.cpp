#include "apps/session/render_session.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "apps/command_line/values.h"
#include "apps/console/exit_code.h"
#include "apps/console/progress_bar.h"
#include "apps/machine/thread_limit.h"
#include "apps/session/denoising.h"
#include "apps/session/render_job.h"
#include "apps/session/stopping/denoising_time.h"
#include "apps/session/stopping/source_choice.h"
#include "apps/session/stopping/stop_rules.h"
#include "apps/session/stopping/time_plan.h"
#include "render/camera/pixel_range.h"
#include "render/film/error_estimate.h"
#include "render/passes/memory_forecast.h"

namespace kaustik::app {

namespace {

render::ProgressCallback shown_by(ProgressBar& bar, const InterruptGuard& interrupt, LiveRender* live,
                                  const Console& console) {
  return [&bar, &interrupt, live, &console](const render::Progress& progress) {
    const TimeLeft::Estimate estimate = bar.update(progress);
    const auto signalled = [&] { return interrupt.requested(); };
    if (!live) return !signalled();
    live->tell(progress, estimate.fraction, estimate.seconds);
    const std::vector<LiveMessage> messages = live->take_messages();
    if (!messages.empty()) bar.clear();
    show_messages(messages, console);
    return live->go_on(signalled);
  };
}

// The render as its followers see it; null if there are none.
std::shared_ptr<LiveRender> live_of(const Job& job, const RenderSession& session) {
  if (session.followed || !session.live.any()) return session.followed;
  return make_live(job);
}

// How many passes the denoiser needs to have both halves of the samples.
uint64_t passes_to_denoise(const render::RenderSettings& settings) {
  if (!settings.denoise.value_or(false) || settings.passes < 2) return 1;
  const render::PassShare each = render::pass_share(0, settings.passes, settings.photons, settings.spp);
  uint64_t first_of_other = 0;
  while (!render::pass_in_half(first_of_other, settings.passes, each.end_sample)) ++first_of_other;
  return first_of_other + 1;
}

// Shows the mean of the passes so far, and its error.
void show_passes(const render::PassSums& sums, LiveRender& live) {
  const render::ErrorMap errors = render::estimate_errors(sums.totals);
  render::Film film = sums.totals.mean();
  render::show_errors(errors, &film);
  live.picture.show(film);
  const double error = render::relative_error(errors, sums.passes.count());
  if (std::isfinite(error)) live.tell_error(sums.passes.count(), error);
}

// Shows the first pass while it is rendered, or the passes that there are already.
render::PixelsCallback follow(const render::PassSums& done, LiveRender* live) {
  if (live && !done.passes.empty()) show_passes(done, *live);
  if (!live || !done.passes.empty()) return {};
  return [live](const render::PixelRange& range, int cell, const render::FilmSums& sums) {
    live->picture.add(range, cell, sums);
  };
}

// Lets trials choose what the session leaves open. Without any, the result has nothing but defaults.
FilledTime run_trials(Job& job, const RenderSession& session, const accel::Bvh& bvh,
                      const InterruptGuard& interrupt, LiveRender* live, const Stopwatch& total,
                      double seconds_after, const Console& console) {
  if (session.fill_time) {
    // Trials are no part of the render that a bar could show.
    const auto signalled = [&] { return interrupt.requested(); };
    const auto go_on = [&](const render::Progress&) { return live ? live->go_on(signalled) : !signalled(); };
    if (live) live->tell({.phase = "trials"}, 0, std::nullopt);
    return settle_time(job.scene, bvh, total, seconds_after, go_on, console, &job.settings);
  }
  if (!session.settle_sources) return {};
  const auto explored = std::make_shared<render::ExploredScene>();
  explored->guides = std::make_unique<render::PhotonGuides>();
  const int asked = job.settings.render.spp;
  const std::string sources = settle_sources(job.scene, bvh, &job.settings.render, explored->guides.get());
  if (!sources.empty())
    console.note(fmt::format("light is not divided between photons and paths: rendered with{}", sources));
  if (job.settings.render.spp > asked)
    console.note(fmt::format("paths bring what photons would, with more noise: rendered with --spp {}",
                             job.settings.render.spp));
  return {.explored = explored};
}

// The passes to render: open-ended if a rule decides when to stop, and only the finished ones if the rule is
// already met.
render::PassSet goal_of(const Job& job, const RenderSession& session, StopRule& rule) {
  if (rule.met_by(session.done)) return session.done.passes;
  const bool open = job.settings.stop.any() && !session.bounded;
  if (open) return {0, render::kMostPasses};
  const bool all = session.ranks && session.goal.empty();
  return all ? render::PassSet(0, job.settings.render.passes) : session.goal;
}

// Makes the photons of a session with kept maps. False, after an error message, if the file for them could
// not be written: the render goes on.
bool take_photons(const RenderSession& session, const Job& job, const accel::Bvh& bvh,
                  const render::ProgressCallback& progress, std::shared_ptr<render::FirstPhotons>* photons,
                  const Console& console) {
  const KeptMaps& maps = session.maps;
  if (!maps.any()) return true;
  note_cameras(maps, job, session.views, writes_sums(session), console);
  try {
    make_photons(maps, job, bvh, session.views, progress, photons);
  } catch (const render::MapFileError& error) {
    if (maps.from) throw;
    console.error(error.what());
    return false;
  }
  if (!maps.save.empty() && !maps.photons && (*photons)->photons.radii()) console.note("wrote " + maps.save);
  return true;
}

double seconds_of(const render::RenderStatistics& s) {
  return s.photon_trace_s + s.photon_build_s + s.render_s;
}

// Tells the bar when the render ends, as far as that is known. seconds: of --time.
void set_ends(ProgressBar& bar, const render::PassSet& goal, const render::PassSums& done,
              std::optional<double> seconds, const Stopwatch& total) {
  if (!goal.empty() && goal.end() < render::kMostPasses) bar.set_end(goal.without(done.passes).end());
  if (seconds) bar.set_deadline(*seconds - seconds_of(done.statistics) - total.seconds());
}

// The message that tells what an interrupted render leaves behind. how: "interrupted".
std::string interruption(const render::RenderResult& result, std::string_view how) {
  switch (result.shown) {
    case render::Shown::kPasses:
      return fmt::format("{}: the picture shows passes {}", how, result.sums.passes.text());
    case render::Shown::kTiles:
      return fmt::format(
          "{} in the first pass: the picture shows the finished tiles and is black elsewhere; there is no "
          "complete pass to resume from",
          how);
    case render::Shown::kNothing:
      break;
  }
  return fmt::format("{} before the first tile was finished: nothing was written", how);
}

// Whether those who follow the render have ended it.
bool was_stopped(const LiveRender* live) {
  return live && live->status().stopped;
}

// Logs which rule ended the render, if one did.
void report_stop(const StopRule& rule, const render::RenderResult& result, const Console& console) {
  if (rule.reason().empty()) return;
  const std::string error = rule.progress();
  const uint64_t passes = result.sums.passes.count();
  console.note(fmt::format("stopped by --{} after {} pass{}{}{}", rule.reason(), passes,
                           passes == 1 ? "" : "es", error.empty() ? "" : ": ", error));
}

// Logs the options that give the bits of a single pass again.
void report_filled(double seconds, const render::RenderSettings& settings, const Console& console) {
  console.note(fmt::format("--time {}s gave --spp {} --photons {} --adaptive {}{}", seconds, settings.spp,
                           settings.photons, settings.adaptive,
                           settings.denoise.value_or(false) ? " --denoise on" : ""));
}

// Only partial results need a full manifest. It names library versions, for which OpenImageIO must be loaded,
// so pictures alone get a short one.
render::PartialManifest manifest_for_outputs(const Job& job, const RenderSession& session,
                                             const render::PassSums& sums, const std::string& stopped_by) {
  if (writes_sums(session)) return manifest_of(job, session.outputs.files, session.goal, sums, stopped_by);
  render::PartialManifest manifest;
  manifest.needs = job.scene.needs;
  manifest.stopped_by = stopped_by;
  return manifest;
}

// What `--stats` says of memory; null without it.
nlohmann::ordered_json memory_of(const Job& job, const accel::Bvh& bvh, const RenderSession& session,
                                 const render::RenderResult& result) {
  if (session.outputs.statistics.empty()) return nullptr;
  const render::RenderInput input{job.scene, bvh, job.settings.render, result.plan, session.views};
  const bool in_passes = result.sums.totals.pixels().width() > 0;
  const bool shot = !session.maps.from && !result.cancelled;  // kept photons stay in their file
  return memory_json(job.memory, in_passes, shot ? render::photons_bytes(input, result.sums.shares) : 0);
}

int finish(const Job& job, const accel::Bvh& bvh, const RenderSession& session, RenderOutcome outcome,
           Checkpoint& checkpoint, const StopRule& rule, LiveRender* live, const Console& console) {
  const render::RenderResult& result = outcome.result;
  const bool stopped = was_stopped(live);
  if (result.cancelled && stopped) console.note(interruption(result, "stopped by a viewer"));
  if (result.cancelled && !stopped && !session.followed) console.error(interruption(result, "interrupted"));
  if (result.cancelled && session.only_complete) return kInterrupted;
  if (result.shown == render::Shown::kNothing) return stopped && session.followed ? kDone : kInterrupted;
  // If the checkpoint cannot be written, the pictures still are, and vice versa.
  bool checkpoint_written = false;
  std::string trouble;
  try {
    checkpoint_written = checkpoint.finish(result.sums, rule.reason());
  } catch (const std::exception& error) {
    trouble = fmt::format("the checkpoint was not written: {}", error.what());
  }
  const render::PartialManifest manifest = manifest_for_outputs(job, session, result.sums, rule.reason());
  report_stop(rule, result, console);
  const bool written = write_outputs(
      session.outputs, {result, job.settings, manifest, live, memory_of(job, bvh, session, result)},
      outcome.times, console);
  if (checkpoint_written) console.note("wrote " + session.checkpoint.path);
  if (!trouble.empty()) console.error(trouble);
  if (!written) return kFailed;
  if (result.cancelled && !stopped) return kInterrupted;
  return trouble.empty() ? kDone : kFailed;
}

// Renders on all ranks, or here if this process is alone or no pass is missing.
render::RenderResult render_task(const RenderSession& session, const Job& job, const accel::Bvh& bvh,
                                 const render::ProgressCallback& progress, StopRule& rule,
                                 render::RenderTask task, const Console& console) {
  if (!session.ranks || task.passes.without(task.done.passes).empty())
    return render::render(job.scene, bvh, job.settings.render, progress, std::move(task));
  const std::string& checkpoint = session.checkpoint.path;
  if (checkpoint.empty())
    console.note(
        "without --checkpoint, nothing is left if the launcher ends all ranks because one is killed");
  RankRules rules;
  rules.has_time_for = [&](double seconds) { return rule.has_time_for(seconds); };
  rules.out_of_time = [&] { rule.stop_for_time(); };
  render::RenderResult result = render_on_ranks(session.ranks->coordinator(), job, bvh, progress,
                                                std::move(rules), std::move(task), console);
  if (result.cancelled && !checkpoint.empty())
    console.warning(fmt::format(
        "if the launcher ends this process before the checkpoint is written, `kaustik resume {}` goes "
        "on after the last one",
        checkpoint));
  return result;
}

}  // namespace

bool writes_sums(const RenderSession& session) {
  const std::vector<std::string>& files = session.outputs.files;
  return !session.checkpoint.path.empty() || std::any_of(files.begin(), files.end(), render::is_partial_name);
}

// Where the settings leave it open: paths of method `auto` end early unless an error is asked for, which
// would not tell what that blurs.
void settle_final_gather(const StopSettings& stop, render::RenderSettings* settings) {
  if (settings->final_gather) return;
  const bool counts =
      stop.target_error || names_error_layer(settings->aov) || settings->estimate_bias.value_or(false);
  settings->final_gather = settings->method == render::Method::kAuto && !counts;
}

void settle_session(const SettingOverrides& given, const Console& console, Job* job, RenderSession* session) {
  Settings& settings = job->settings;
  check_stop_rules(session->maps, settings.stop);
  const bool in_passes = writes_sums(*session) || session->launched;
  if (session->launched) settle_rank_passes(console, &settings);
  settle_denoising(in_passes, &settings);
  settle_final_gather(settings.stop, &settings.render);
  session->fill_time = session->goal.empty() && time_decides(settings, given, job->scene.needs, in_passes);
  check_stop_settings(settings.stop);
  if (settings.stop.any()) settings.render.sample_balance = render::Balance::kOff;
  if (session->fill_time) return;
  settle_error_settings(console, job->scene.needs, &settings);
  session->settle_sources = !session->maps.any();
  if (session->maps.any()) {  // photons that carry all light serve any number of samples
    const render::EstimatorPlan plan = render::make_plan(settings.render, job->scene.needs);
    settings.render = with_photons(settings.render, plan);
  }
  settle_kept_maps(session->maps, console, job);
  if (session->maps.any() && !session->goal.empty() && session->goal != render::PassSet(0, 1))
    throw ExitError(kBadCommandLine,
                    fmt::format("--pass-range {}: kept photon maps hold pass 0 alone", session->goal.text()));
}

namespace {

// What writing sums needs before the work starts. Returns the lock of the checkpoint; null if there is none.
std::unique_ptr<FileLock> prepare_sums(const Job& job, const RenderSession& session) {
  if (writes_sums(session) || session.ranks)
    program_build();  // asks Embree for its version before it starts to work
  if (!writes_sums(session)) return nullptr;
  check_utf8({job.path});
  check_utf8(session.outputs.files);
  return lock_checkpoint(session.checkpoint);
}

// Paths go on where what they would end in takes more than half of the memory that is left without it.
void leave_out_final_gather(bool in_passes, const Console& console, Job* job) {
  render::RenderSettings without = job->settings.render;
  without.final_gather = false;
  MemoryPlan& memory = job->memory;
  const uint64_t more = memory.surfaces - render::surfaces_bytes(job->scene, memory.sides, without);
  const uint64_t least = memory.total(in_passes) - more;
  if (least >= memory.limit.bytes || 2 * more <= memory.limit.bytes - least) return;
  console.note("memory is short: rendered with --final-gather off");
  job->settings.render.final_gather = false;
  memory.surfaces -= more;
}

// Forecasts the memory anew, now that the settings are decided, and leaves the rest to photons. Throws
// std::runtime_error if nothing is left.
void settle_memory(const RenderSession& session, const Console& console, Job* job) {
  if (session.bvh) return;  // what made the BVH has forecast its renders
  render::RenderSettings& settings = job->settings.render;
  const bool open = job->settings.stop.any() && !session.fill_time;
  const bool in_passes = writes_sums(session) || session.ranks || settings.passes > 1 || open;
  // A render that fills a time decides later whether to denoise.
  job->memory = plan_memory(job->scene, job->memory.sides, settings, job->settings.stop.seconds.has_value());
  if (settings.final_gather.value_or(false)) leave_out_final_gather(in_passes, console, job);
  check_memory(job->memory, in_passes);
  // Kept photons stay in their file.
  if (!session.maps.from) set_photon_memory(job->memory, in_passes, &settings);
}

}  // namespace

std::shared_ptr<LiveRender> make_live(const Job& job) {
  const Camera& camera = job.scene.camera;
  const render::PixelRange range = render::rendered_range(job.settings.render.crop, camera);
  return std::make_shared<LiveRender>(std::filesystem::path(job.path).filename().string(), range,
                                      camera.width, camera.height);
}

int run_session(Job& job, RenderSession session, const InterruptGuard& interrupt, const Stopwatch& total,
                const Console& console) {
  int code = kDone;
  const std::unique_ptr<FileLock> lock = prepare_sums(job, session);
  settle_memory(session, console, &job);  // when libraries for sums are loaded
  with_thread_limit(job.settings.render.threads, console, [&] {
    render::OuterTimes times{.load = job.load_seconds};
    const Stopwatch watch;
    std::optional<accel::Bvh> own;
    const accel::Bvh& bvh = session.bvh ? *session.bvh : own.emplace(job.scene, job.settings.render.threads);
    times.bvh = watch.seconds();
    const std::shared_ptr<LiveRender> live = live_of(job, session);
    const auto viewers =
        live ? start_viewers(session.live, live, job.settings.render.aov, job.settings.tone, console)
             : LiveViewers{};
    const double seconds_after = settle_timed_denoising(job.scene.camera, console, &job.settings);
    FilledTime filled = run_trials(job, session, bvh, interrupt, live.get(), total, seconds_after, console);
    const std::optional<double> seconds = job.settings.stop.seconds;
    const double filled_seconds = filled.single_pass ? *seconds : 0;
    times.trials =
        watch.seconds() - times.bvh - (filled.photons ? seconds_of(filled.photons->statistics) : 0);
    if (filled.single_pass) job.settings.stop.seconds.reset();  // the settings already fit the time
    Checkpoint checkpoint(session.checkpoint, job, session.outputs.files, session.goal, console);
    StopRule rule(job.settings.stop, seconds_of(session.done.statistics), total, seconds_after,
                  passes_to_denoise(job.settings.render));
    if (session.settled) session.settled(job.settings);
    for (const std::string& note : render::make_plan(job.settings.render, job.scene.needs).notes)
      console.note(note);
    const render::PassSet goal = goal_of(job, session, rule);
    ProgressBar bar(console);
    set_ends(bar, goal, session.done, seconds, total);
    std::optional<MapCheck> check;
    const auto after_pass = [&](const render::PassSums& sums) {
      if (check) check->finish();  // before anything is written
      const bool enough = session.ranks ? rule.reaches_target(sums) : rule.enough(sums);
      bar.remark(rule.progress());
      if (const auto passes = rule.passes_needed(sums)) bar.set_end(*passes);
      if (live && sums.totals.pixels().width() > 0) show_passes(sums, *live);
      if (!enough) checkpoint.after_pass(sums);
      return !enough;
    };
    render::PixelsCallback on_pixels = follow(session.done, live.get());
    const render::ProgressCallback progress = shown_by(bar, interrupt, live.get(), console);
    if (session.maps.from && !session.maps.photons) check.emplace(*session.maps.from);
    const bool map_written = take_photons(session, job, bvh, progress, &filled.photons, console);
    render::RenderTask task{.passes = goal,
                            .done = std::move(session.done),
                            .after_pass = after_pass,
                            .keep_sums = writes_sums(session) || session.ranks,
                            .adaptive_work = std::move(filled.adaptive_work),
                            .on_pixels = std::move(on_pixels),
                            .views = std::move(session.views),
                            .photons = std::move(filled.photons),
                            .explored = std::move(filled.explored)};
    RenderOutcome outcome{render_task(session, job, bvh, progress, rule, std::move(task), console), times};
    bar.clear();
    if (check) check->finish();
    if (filled_seconds > 0) job.settings.render.adaptive = float(outcome.result.statistics.adaptive_work);
    if (filled_seconds > 0) report_filled(filled_seconds, job.settings.render, console);
    outcome.times.total = total.seconds();
    code = finish(job, bvh, session, std::move(outcome), checkpoint, rule, live.get(), console);
    if (!map_written && code == kDone) code = kFailed;
    if (live) live->finish();
  });
  return code;
}

void check_photons_of_passes(const Job& job) {
  const render::RenderSettings& settings = job.settings.render;
  if (settings.passes > settings.photons && render::needs_photons(settings, job.scene.needs))
    refuse(fmt::format("--passes {}: {} photons cannot be divided among so many passes", settings.passes,
                       settings.photons));
}

render::PassSet parse_ranges(std::string_view option, std::string_view what, const std::string& text) {
  const std::optional<render::PassSet> ranges = render::PassSet::parse(text);
  if (!ranges)
    throw OptionError(std::string(option),
                      fmt::format("`{}`: expected {} BEGIN:END, like 0:16 or 0:4,8:12", text, what));
  return *ranges;
}

double checkpoint_interval(const std::string& text) {
  if (const std::optional<double> seconds = parse_duration(text)) return *seconds;
  throw OptionError("--checkpoint-every",
                    fmt::format("`{}`: expected a time with its unit, like 60s, 10m or 1.5h", text));
}

}  // namespace kaustik::app
