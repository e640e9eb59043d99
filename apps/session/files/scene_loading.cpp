#include "apps/session/files/scene_loading.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "apps/console/exit_error.h"
#include "apps/session/files/dark_scene.h"
#include "apps/session/files/wide_radius.h"
#include "core/parallel/work_span.h"
#include "core/stopwatch.h"

namespace kaustik::app {

namespace {

// Prints the errors and warnings of scene and settings together, so that one run shows every error of a file.
void print_diagnostics(Diagnostics& diagnostics, const Console& console) {
  diagnostics.merge_equal_warnings();
  console.err << diagnostics.format_all();
}

[[noreturn]] void refuse_scene(const std::string& path, size_t errors) {
  throw ExitError(kBadScene, fmt::format("{}: {}", path, counted(errors, "error")));
}

bool names_place(const DiagnosticList& diagnostics, const SourceLocation& place) {
  return std::any_of(diagnostics.entries().begin(), diagnostics.entries().end(), [&](const Diagnostic& d) {
    return d.location.file == place.file && d.location.line == place.line &&
           d.location.column == place.column;
  });
}

// Reports a scene that could not be built, together with the errors of its settings. An error that both the
// schema and the settings find is reported once.
[[noreturn]] void report_broken_scene(const std::string& path, const ImportOptions& options,
                                      Diagnostics& diagnostics, const Console& console) {
  print_diagnostics(diagnostics, console);
  Diagnostics again;
  DiagnosticList settings_only;
  if (const auto description = pbrt::import_scene(path, again, options))
    settings_from_scene(*description, settings_only);
  size_t errors = diagnostics.error_count();
  for (const Diagnostic& diagnostic : settings_only.entries()) {
    if (names_place(diagnostics, diagnostic.location)) continue;
    console.err << again.format(diagnostic);
    errors += diagnostic.severity == Severity::kError;
  }
  refuse_scene(path, errors);
}

// Sets the image size: the command line's, or the scene's. If only one side is given, the other keeps the
// scene's aspect ratio.
void resolve_size(const SceneSettings& file, const render::RenderSettings& settings, Camera& camera) {
  int width = settings.width, height = settings.height;
  const double aspect = double(file.width) / double(file.height);
  if (width == 0 && height == 0) width = file.width, height = file.height;
  if (height == 0) height = std::max(1, static_cast<int>(std::lround(width / aspect)));
  if (width == 0) width = std::max(1, static_cast<int>(std::lround(height * aspect)));
  camera.width = width;
  camera.height = height;
  if (!file.fixed_screen_window) camera.set_default_screen_window();
}

void resolve_crop(const SceneSettings& file, const SettingOverrides& overrides, const Camera& camera,
                  render::RenderSettings& settings, const Console& console) {
  const bool same_size = camera.width == file.width && camera.height == file.height;
  if (!overrides.sets("crop") && !settings.crop.empty() && !same_size) {
    settings.crop = {};
    console.note("the scene's crop window is for another image size: the whole image is rendered");
  }
  const render::CropWindow& crop = settings.crop;
  if (!crop.empty() && (crop.x1 > camera.width || crop.y1 > camera.height)) {
    throw ExitError(kBadCommandLine,
                    fmt::format("--crop {} {} {} {} reaches beyond the {} x {} image", crop.x0, crop.x1,
                                crop.y0, crop.y1, camera.width, camera.height));
  }
}

// A camera that is fitted to a model needs to know the picture's shape before the scene is read.
ImportOptions import_options_of(const Settings& settings) {
  ImportOptions options = settings.import_options;
  if (settings.render.width > 0 && settings.render.height > 0)
    options.view.aspect = double(settings.render.width) / settings.render.height;
  const MemoryLimit limit = memory_limit(settings.render);
  options.room = MemoryRoom(limit.bytes, limit.source);
  return options;
}

SceneDescription view_of(const SceneDescription& scene) {
  SceneDescription view;
  view.location = scene.location;
  view.camera = scene.camera;
  view.film = scene.film, view.filter = scene.filter;
  view.options = scene.options;
  view.animation = scene.animation;
  return view;
}

// Forecasts what the job takes, and leaves the rest of the memory to photons. Whether pictures are denoised
// is decided later: without it they must fit, and photons get what is left with it.
void forecast(LoadFor use, Job* job) {
  render::RenderSettings& settings = job->settings.render;
  MemoryPlan& plan = job->memory;
  plan = plan_memory(job->scene, estimate_sides(job->scene.shapes), settings, false);
  if (use != LoadFor::kPictures) plan.film = plan.sums = 0;
  if (use != LoadFor::kDescription) check_memory(plan, settings.passes > 1);
  if (use == LoadFor::kPictures) forecast_film(job->scene, settings, true, &plan);
  set_photon_memory(plan, false, &settings);
}

}  // namespace

std::string grouped(uint64_t n) {
  if (n < 1000) return fmt::format("{}", n);
  return fmt::format("{},{:03}", grouped(n / 1000), n % 1000);
}

std::string counted(uint64_t n, std::string_view noun) {
  return fmt::format("{} {}{}", grouped(n), noun, n == 1 ? "" : "s");
}

std::string scene_summary(const Scene& scene) {
  uint64_t primitives = 0;
  for (const Shape& shape : scene.shapes) primitives += primitive_count(shape);
  return fmt::format("{}, {}, {}, {}", counted(scene.shapes.size(), "shape"),
                     counted(primitives, "primitive"), counted(scene.materials.size(), "material"),
                     counted(scene.lights.size(), "light"));
}

std::vector<NamedFile> files_of(const Job& job) {
  std::vector<NamedFile> files;
  for (const std::string& path : job.files) files.push_back({"the scene's file", path});
  return files;
}

Job load_job(const std::string& path, const SettingOverrides& overrides, const Console& console,
             LoadFor use) {
  const PhaseWatch watch;
  ImportOptions options = import_options_of(overrides.alone());
  options.texture_pixels = use != LoadFor::kDescription;
  Diagnostics diagnostics;
  std::optional<pbrt::LoadedScene> loaded = pbrt::load_scene(path, diagnostics, options);
  if (!loaded) report_broken_scene(path, options, diagnostics, console);
  const SceneSettings file = settings_from_scene(loaded->description, diagnostics);
  if (const std::string why = why_black(loaded->scene, loaded->description); !why.empty())
    diagnostics.warning(loaded->description.location, why);
  print_diagnostics(diagnostics, console);
  if (diagnostics.has_errors()) refuse_scene(path, diagnostics.error_count());

  Job job{.scene = std::move(loaded->scene),
          .settings = file.settings,
          .path = path,
          .content_hash = std::move(loaded->content_hash),
          .scene_output = file.output,
          .view = view_of(loaded->description),
          .fixed_screen_window = file.fixed_screen_window,
          .files = std::move(loaded->files)};
  overrides.apply(job.settings);
  resolve_size(file, job.settings.render, job.scene.camera);
  resolve_crop(file, overrides, job.scene.camera, job.settings.render, console);
  forecast(use, &job);
  job.settings.render.width = job.scene.camera.width;
  job.settings.render.height = job.scene.camera.height;
  if (const std::string why = why_wide(job.scene, job.settings.render); !why.empty()) console.warning(why);
  job.load_seconds = watch.end("load");
  console.note(fmt::format("{}: {}", path, scene_summary(job.scene)));
  for (const std::string& note : loaded->description.notes) console.note(note);
  for (const std::string& note : file.notes) console.note(note);
  return job;
}

}  // namespace kaustik::app
