#include "apps/sequence/sequence.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "apps/console/exit_error.h"
#include "apps/console/progress_bar.h"
#include "apps/import/import_scene.h"
#include "apps/machine/thread_limit.h"
#include "apps/sequence/frame_names.h"
#include "apps/session/stopping/source_choice.h"
#include "apps/session/tone.h"
#include "core/scene/build/camera_builder.h"
#include "render/passes/passes.h"
#include "render/picture/exposure.h"
#include "render/picture/image_io.h"

namespace kaustik::app {

namespace {

// Cameras for which the photons of a sequence are shot: so many of its frames, evenly spread.
constexpr uint64_t kMostViews = 32;

// The options that a render of this frame alone would be given. camera: the scene's.
SettingOverrides options_of(const Sequence& sequence, uint64_t frame,
                            const std::optional<CameraDescription>& camera) {
  SettingOverrides options;
  if (sequence.animated) options.add(*find_setting("frame"), {fmt::format("{}", frame)});
  if (!sequence.path) return options;
  const FrameView view = sequence.path->at(frame, camera);
  options.add(*find_setting("look-at"), view.look_at_texts());
  if (view.fov) options.add(*find_setting("fov"), view.fov_texts());
  return options;
}

// Finds the cameras of frames in a world that stands still.
class FrameCameras {
 public:
  FrameCameras(const Sequence& sequence, const Job& job)
      : sequence_(sequence), job_(job), settings_(job.settings) {}

  ImportOptions options_at(uint64_t frame) const {
    Settings settings = settings_;
    options_of(sequence_, frame, job_.view.camera).apply(settings);
    return settings.import_options;
  }

  Camera at(uint64_t frame) const {
    Diagnostics diagnostics;
    SceneDescription view = view_at(frame, diagnostics);
    if (sequence_.path) pbrt::place_camera(job_.path, options_at(frame).view, &view, diagnostics);
    WarnedOnce warned;
    if (view.camera) view.camera->camera_to_world[3] -= glm::dvec4(job_.scene.origin, 0);
    Camera camera = build_camera(view, warned, diagnostics);
    if (diagnostics.has_errors()) refuse(fmt::format("frame {}: {}", frame, diagnostics.format_all()));
    camera.width = job_.scene.camera.width, camera.height = job_.scene.camera.height;
    if (!job_.fixed_screen_window) camera.set_default_screen_window();
    return camera;
  }

 private:
  SceneDescription view_at(uint64_t frame, Diagnostics& diagnostics) const {
    if (!sequence_.animated || sequence_.path) return job_.view;
    ImportOptions options = options_at(frame);
    options.texture_pixels = false;
    auto scene = pbrt::import_scene(job_.path, diagnostics, options);
    if (!scene) refuse(fmt::format("frame {}: the scene cannot be read any more", frame));
    SceneDescription view = job_.view;
    view.camera = scene->camera;
    return view;
  }

  const Sequence& sequence_;
  const Job& job_;
  const Settings settings_;  // before any frame's options
};

std::vector<Camera> views_of(const Sequence& sequence, const FrameCameras& cameras) {
  std::vector<Camera> views;
  const uint64_t count = std::min(sequence.frames, kMostViews);
  for (uint64_t i = 0; i < count; ++i)
    views.push_back(cameras.at(count == 1 ? 0 : i * (sequence.frames - 1) / (count - 1)));
  return views;
}

OutputOptions outputs_of(const OutputOptions& patterns, uint64_t frame) {
  OutputOptions outputs = patterns;
  for (std::string& file : outputs.files) file = frame_name(file, frame);
  if (!outputs.statistics.empty()) outputs.statistics = frame_name(outputs.statistics, frame);
  return outputs;
}

bool all_exist(const OutputOptions& outputs) {
  std::error_code ignored;
  return std::ranges::all_of(outputs.files,
                             [&](const std::string& file) { return std::filesystem::exists(file, ignored); });
}

// The frames to render.
std::vector<uint64_t> missing_frames(const SequenceOptions& options, const Sequence& sequence,
                                     const RenderSession& session) {
  std::vector<uint64_t> missing;
  const render::PassSet wanted = options.frames.value_or(render::PassSet(0, sequence.frames));
  for (const render::PassSet::Range& range : wanted.ranges())
    for (uint64_t frame = range.begin; frame < range.end; ++frame)
      if (options.overwrite || !all_exist(outputs_of(session.outputs, frame))) missing.push_back(frame);
  return missing;
}

// Exposure of a small picture of few samples by the job's camera, so that all frames are shown alike. Its
// photons are those of the frames, or few.
float common_exposure(Job& job, const RenderSession& session, const accel::Bvh& bvh,
                      const render::ProgressCallback& progress) {
  constexpr int kWidth = 160, kSamples = 8;
  constexpr uint64_t kPhotons = 200'000;
  const render::RenderSettings settings = job.settings.render;
  const Camera camera = job.scene.camera;
  job.scene.camera.height = std::max(1, camera.height * std::min(kWidth, camera.width) / camera.width);
  job.scene.camera.width = std::min(kWidth, camera.width);
  render::RenderSettings& few = job.settings.render;
  few.crop = {}, few.spp = kSamples, few.adaptive = 0, few.denoise = false, few.estimate_bias = false;
  few.passes = 1;
  if (!session.maps.photons) few.photons = std::min(few.photons, kPhotons);
  render::RenderTask task{.keep_sums = false, .views = session.views};
  KeptMaps maps = session.maps;
  maps.explored = nullptr;  // what a small picture finds out about the scene is not for the frames
  if (maps.photons) make_photons(maps, job, bvh, session.views, {}, &task.photons);
  const render::Film film = render::render(job.scene, bvh, few, progress, std::move(task)).film;
  job.settings.render = settings;
  job.scene.camera = camera;
  return render::automatic_exposure(render::image_of(film), render::lights_seen(film),
                                    job.settings.tone.tonemap);
}

// Sets the exposure of all frames, if files show it and the settings leave it open.
void settle_exposure(Job& job, const RenderSession& session, const accel::Bvh& bvh,
                     const InterruptGuard& interrupt, const Console& console) {
  const bool tones = std::ranges::any_of(session.outputs.files, shows_tones);
  if (!tones || job.settings.tone.exposure || interrupt.requested()) return;
  const auto go_on = [&](const render::Progress&) { return !interrupt.requested(); };
  job.settings.tone.exposure = common_exposure(job, session, bvh, go_on);
  console.note(
      fmt::format("exposure: --exposure {} (automatic, for all frames)", *job.settings.tone.exposure));
}

// What the frames of a world that stands still share: its BVH and photons. Everything is settled for the
// first frame of the sequence, and for the views of all, so that the frames that are rendered do not matter.
class StandingWorld {
 public:
  StandingWorld(const Sequence& sequence, Job& job, RenderSession& session, const InterruptGuard& interrupt,
                const Console& console)
      : job_(job), session_(session), cameras_(sequence, job) {
    session.views = views_of(sequence, cameras_);
    job.scene.camera = session.views.front();
    with_thread_limit(job.settings.render.threads, console, [&] {
      bvh_.emplace(job.scene, job.settings.render.threads);
      session.bvh = &*bvh_;
      shoot(interrupt, console);
      settle_exposure(job, session, *bvh_, interrupt, console);
    });
  }

  // Whether the file of the maps could not be written.
  bool failed() const { return failed_; }

  void show(uint64_t frame) {
    job_.scene.camera = cameras_.at(frame);
    job_.settings.import_options = cameras_.options_at(frame);
  }

 private:
  // Chooses paths or photon maps, and shoots the photons of a single pass. Photons of several passes are shot
  // by each frame.
  void shoot(const InterruptGuard& interrupt, const Console& console) {
    ProgressBar bar(console);
    const render::ProgressCallback progress = shown_in(bar, interrupt);
    render::RenderSettings& settings = job_.settings.render;
    if (std::exchange(session_.settle_sources, false)) settle_sources(job_.scene, *bvh_, &settings);
    render::EstimatorPlan plan = render::make_plan(settings, job_.scene.needs);
    if (!render::kinds_needed(plan).any() || render::choose_passes(job_.scene, *bvh_, settings, &plan) > 1)
      return;
    // The frames share photons that carry all light.
    settings = with_photons(settings, plan);
    KeptMaps& maps = session_.maps;
    if (maps.from) maps.from->check_columns();
    maps.explored = std::make_shared<render::ExploredScene>();
    note_cameras(maps, job_, session_.views, false, console);
    std::shared_ptr<render::FirstPhotons> first;
    try {
      make_photons(maps, job_, *bvh_, session_.views, progress, &first);
    } catch (const render::MapFileError& error) {
      if (maps.from) throw;
      console.error(error.what());  // the frames are rendered all the same
      failed_ = true;
    }
    if (!first->photons.radii()) return;  // interrupted
    if (!maps.save.empty() && !failed_) console.note("wrote " + maps.save);
    maps.photons = std::make_shared<const render::KeptPhotons>(first->photons.keep(first->statistics));
    job_.settings.render.passes = 1;
  }

  Job& job_;
  RenderSession& session_;
  FrameCameras cameras_;
  std::optional<accel::Bvh> bvh_;
  bool failed_ = false;
};

// The job of a frame of a world that moves, with the settings that were settled for the first one.
Job moved_job(const Sequence& sequence, uint64_t frame, const SettingOverrides& given, const Job& first,
              const Console& console) {
  SettingOverrides overrides = given;
  overrides.append(options_of(sequence, frame, first.view.camera));
  Job job;
  with_thread_limit(first.settings.render.threads, console,
                    [&] { job = load_job(first.path, overrides, console); });
  const ImportOptions options = job.settings.import_options;
  job.settings = first.settings;
  job.settings.import_options = options;
  return job;
}

// Settles for the first frame what all frames of a world that moves share.
void settle_moving_world(const Sequence& sequence, const SettingOverrides& given, Job& job,
                         RenderSession& session, const InterruptGuard& interrupt, const Console& console) {
  job = moved_job(sequence, 0, given, job, console);
  with_thread_limit(job.settings.render.threads, console, [&] {
    const accel::Bvh bvh(job.scene, job.settings.render.threads);
    if (std::exchange(session.settle_sources, false)) settle_sources(job.scene, bvh, &job.settings.render);
    settle_exposure(job, session, bvh, interrupt, console);
  });
}

// No two files of a frame may have one name, at any number of digits.
void check_patterns(const OutputOptions& patterns, uint64_t frames) {
  for (uint64_t frame = 1; frame < frames; frame *= 10)
    check_collisions(named_files(outputs_of(patterns, frame)), {});
}

}  // namespace

Sequence make_sequence(const SequenceOptions& options, const RenderSession& session, const Job& job,
                       const Console& console) {
  Sequence sequence;
  if (!options.camera_path.empty()) sequence.path = CameraPath::read(options.camera_path, console.err);
  if (const auto& animation = job.view.animation) {
    sequence.animated = true, sequence.moves_world = animation->moves_world;
    const double last = std::floor(animation->seconds * double(kFramesPerSecond));
    if (!(last < double(kMostFrames)))
      refuse(fmt::format("{} is animated for {:.3g} s: a sequence has at most {} frames", job.path,
                         animation->seconds, kMostFrames));
    sequence.frames = uint64_t(last) + 1;
  }
  if (sequence.path) sequence.frames = sequence.path->frames();
  if (sequence.frames == 0)
    refuse(fmt::format("--frames needs --camera-path, since {} is not animated", job.path));
  if (options.frames && options.frames->end() > sequence.frames)
    refuse(fmt::format("--frames {}: the sequence has frames 0:{}", options.frames->text(), sequence.frames));
  if (job.settings.stop.any()) refuse("--time and --target-error cannot be combined with a sequence");
  if (!session.checkpoint.path.empty() || !session.goal.empty() || session.live.any())
    refuse("a sequence cannot be combined with --checkpoint, --pass-range, --view, --preview or --display");
  if (session.maps.any() && sequence.moves_world)
    refuse("--map and --save-map cannot be combined with a scene whose shapes or lights move");
  if (std::ranges::any_of(session.outputs.files, render::is_partial_name))
    refuse("frames of a sequence cannot be partial results: their photons are those of all frames");
  if (session.outputs.files.empty()) refuse("a sequence needs -o with a pattern such as frame.%04d.exr");
  try {
    const OutputOptions first = outputs_of(session.outputs, 0);
    check_outputs(first);
    check_collisions(named_files(first), files_of(job));
    check_patterns(session.outputs, sequence.frames);
    warn_of_layers(first, job.settings.render.aov, console);
  } catch (const std::invalid_argument& error) {
    refuse(error.what());
  }
  return sequence;
}

int run_sequence(const SequenceOptions& options, const Sequence& sequence, const SettingOverrides& given,
                 Job& job, RenderSession session, const InterruptGuard& interrupt, const Console& console) {
  const std::vector<uint64_t> missing = missing_frames(options, sequence, session);
  if (missing.empty()) {
    console.note("every frame exists; --overwrite renders them again");
    return kDone;
  }
  session.only_complete = true;
  std::optional<StandingWorld> world;
  if (!sequence.moves_world)
    world.emplace(sequence, job, session, interrupt, console);
  else
    settle_moving_world(sequence, given, job, session, interrupt, console);
  for (const uint64_t frame : missing) {
    if (interrupt.requested()) return kInterrupted;
    const std::string place = sequence.path ? ": " + sequence.path->at(frame, job.view.camera).options() : "";
    console.note(fmt::format("frame {} of {}{}", frame, sequence.frames, place));
    const Stopwatch total;
    RenderSession of_frame = session;
    of_frame.outputs = outputs_of(session.outputs, frame);
    check_collisions(named_files(of_frame.outputs), files_of(job));
    std::optional<Job> moved;
    if (world)
      world->show(frame);
    else
      moved = moved_job(sequence, frame, given, job, console);
    const int code = run_session(moved ? *moved : job, std::move(of_frame), interrupt, total, console);
    if (code != kDone) return code;
  }
  return world && world->failed() ? kFailed : kDone;
}

}  // namespace kaustik::app
