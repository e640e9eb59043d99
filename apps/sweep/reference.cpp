#include "apps/sweep/reference.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "apps/bench/bench_json.h"
#include "apps/console/exit_error.h"
#include "apps/session/files/output_files.h"
#include "apps/session/files/partial_files.h"
#include "apps/session/render_job.h"
#include "apps/session/tone.h"
#include "apps/sweep/pictures.h"
#include "core/files/content_hash.h"
#include "core/stopwatch.h"
#include "render/camera/pixel_range.h"
#include "render/passes/json_numbers.h"
#include "render/picture/exposure.h"
#include "render/picture/image_io.h"
#include "render/renderer.h"
#include "render/settings/names.h"

namespace kaustik::app {

namespace fs = std::filesystem;

namespace {

// Photons of each pass, which also set its initial gather radius. With fewer photons and a smaller radius, a
// reference of few passes could be noisier than the renders measured against it.
constexpr uint64_t kPassPhotons = 1'000'000;
constexpr double kPassSamples = 1 << 20;       // camera samples of each pass over all pixels, approximately
constexpr uint64_t kSeedApart = 0x7265660000;  // added to the sweep's seed
constexpr double kLongest = 1e12;              // most seconds that the progress shows; avoids 64-bit overflow
constexpr const char *kPictureName = "reference.exr", *kAboutName = "reference.json";

Settings reference_settings(const Job& job, render::Method method) {
  const render::RenderSettings& own = job.settings.render;
  const auto [width, height] = picture_size(job);
  Settings settings;
  render::RenderSettings& s = settings.render;
  s.method = method;
  const double pixels = double(width) * double(height);
  s.photons = kPassPhotons;
  s.balance = render::Balance::kOff;
  s.passes = 1;
  s.spp = static_cast<int>(std::clamp(kPassSamples / pixels, 4.0, 64.0));
  s.alpha = 2.0f / 3;
  s.seed = own.seed + kSeedApart;
  s.max_bounces = own.max_bounces;
  s.threads = own.threads;
  s.width = own.width, s.height = own.height, s.crop = own.crop;
  s.photon_memory = own.photon_memory;
  settings.import_options = job.settings.import_options;
  return settings;
}

// Replaces a job's settings for the guard's lifetime.
class SettingsGuard {
 public:
  SettingsGuard(Job& job, Settings settings) : job_(job), previous_(std::move(job.settings)) {
    job_.settings = std::move(settings);
  }
  ~SettingsGuard() { job_.settings = std::move(previous_); }
  SettingsGuard(const SettingsGuard&) = delete;
  SettingsGuard& operator=(const SettingsGuard&) = delete;

 private:
  Job& job_;
  Settings previous_;
};

double mean_of(const render::Image& image) {
  double sum = 0;
  for (const Rgb& pixel : image.pixels) sum += double(pixel.x) + double(pixel.y) + double(pixel.z);
  return sum / (3.0 * double(image.pixels.size()));
}

// Reads a picture. Throws ImageError, also when its size is not the job's.
void read_picture(const std::string& path, const Job& job, Reference* reference) {
  render::Image& image = reference->image;
  image = render::read_image(path);
  const auto [width, height] = picture_size(job);
  if (image.width != width || image.height != height)
    throw render::ImageError(path, fmt::format("it has {} x {} pixels, but the scene's picture has {} x {}",
                                               image.width, image.height, width, height));
  if (!render::is_exr(path)) return;
  try {
    reference->lights = render::lights_seen(render::read_exr_file(path, render::kMostPixelsRead));
  } catch (const std::exception&) {
    // OpenImageIO reads some files that OpenEXR alone does not: their lights are not known
  }
}

Reference read_reference(const std::string& path, const Job& job) {
  Reference reference;
  try {
    read_picture(path, job, &reference);
  } catch (const render::ImageError& error) {
    throw ExitError(kBadCommandLine, fmt::format("--reference: {}", error.what()));
  }
  reference.about.source = utf8(path);
  return reference;
}

// Reads the reference that an earlier run finished. Throws an exception that names the problem if it is
// unusable.
Reference kept_reference(const Job& job, const SweepFolder& folder) {
  const std::optional<Json> about = folder.read(kAboutName);
  if (!about) throw std::runtime_error(folder.path(kAboutName) + ": it is not valid JSON");
  Reference reference;
  read_picture(folder.path(kPictureName), job, &reference);
  if (about->at("hash") != picture_hash(reference.image))
    throw std::runtime_error(
        fmt::format("{}: it is not the picture that {} describes", folder.path(kPictureName), kAboutName));
  about->at("source").get_to(reference.about.source);
  about->at("seconds").get_to(reference.about.seconds);
  render::take_whole(*about, "passes", &reference.about.passes);
  if (const Json& noise = about->at("noise_relmse"); !noise.is_null())
    reference.about.noise = noise.get<double>();
  return reference;
}

std::optional<Reference> find_reference(const Job& job, const SweepFolder& folder, const Console& console) {
  if (!fs::exists(folder.path(kAboutName)) || !fs::exists(folder.path(kPictureName))) return std::nullopt;
  const auto warn = [&](const std::string& what) {
    console.warning(fmt::format("{}; the reference is rendered again", what));
    return std::nullopt;
  };
  try {
    return kept_reference(job, folder);
  } catch (const Json::exception&) {
    return warn(folder.path(kAboutName) + ": a value is missing or has the wrong type");
  } catch (const std::exception& error) {
    return warn(error.what());
  }
}

double seconds_in(const render::PassSums& sums) {
  const render::RenderStatistics& s = sums.statistics;
  return s.photon_trace_s + s.photon_build_s + s.render_s;
}

// The passes of an interrupted run. Scene, build and settings need no check: SweepFolder has done it.
render::PassSums begun_passes(const std::string& path, const Console& console) {
  if (!fs::exists(path)) return {};
  try {
    return render::read_partial(path).sums;
  } catch (const render::PartialError& error) {
    console.warning(fmt::format("{}; the reference is rendered from the start", error.what()));
    return {};
  }
}

void keep_reference(const Reference& reference, const render::Film& film, const SweepFolder& folder) {
  // The layers tell which pixels show lights.
  render::write_film(folder.path(kPictureName), film,
                     {{render::Layer::kEmitted, render::Layer::kDenoisingEmitted}, {}, {}});
  const SweepReference& about = reference.about;
  const Json json = {{"hash", picture_hash(reference.image)},
                     {"source", about.source},
                     {"seconds", about.seconds},
                     {"passes", about.passes},
                     {"noise_relmse", about.noise ? Json(*about.noise) : Json(nullptr)}};
  write_text_file(folder.path(kAboutName), json.dump(2) + "\n");
  std::error_code ignored;
  fs::remove(folder.path("reference.kpart"), ignored);
}

std::optional<Reference> render_reference(const ReferenceChoice& choice, render::Method method, Job& job,
                                          const SweepFolder& folder, const ReferenceProgress& progress,
                                          const Console& console) {
  const SettingsGuard guard(job, reference_settings(job, method));
  const std::string part = folder.path("reference.kpart");
  render::RenderTask task{.passes = render::PassSet(0, render::kMostPasses),
                          .done = begun_passes(part, console)};
  uint64_t passes = task.done.passes.count();
  task.after_pass = [&](const render::PassSums& sums) {
    passes = sums.passes.count();
    return true;
  };
  const double before = seconds_in(task.done);
  const Stopwatch watch;
  bool interrupted = false;
  const auto go_on = [&](const render::Progress&) {
    const double spent = before + watch.seconds();
    const auto ms = [](double seconds) { return static_cast<uint64_t>(1e3 * std::min(seconds, kLongest)); };
    interrupted = interrupted || !progress(std::min(ms(spent), ms(choice.seconds)), ms(choice.seconds));
    return !interrupted && (passes < 2 || spent < choice.seconds);
  };
  const render::RenderResult result =
      render_job(job.scene, job.settings.render, go_on, std::move(task)).result;
  if (interrupted) {
    if (!result.sums.passes.empty())
      render::write_partial(part, manifest_of(job, {}, {}, result.sums), result.sums);
    return std::nullopt;
  }
  Reference reference;
  reference.image = render::image_of(result.film);
  reference.lights = render::lights_seen(result.film);
  reference.about = {.source = fmt::format("method {}, {} passes", render::name_of(method), passes),
                     .noise = render::relative_noise(result.sums.totals),
                     .seconds = before + watch.seconds(),
                     .passes = passes,
                     .picture = {},
                     .tone = {}};
  keep_reference(reference, result.film, folder);
  return reference;
}

}  // namespace

std::pair<int, int> picture_size(const Job& job) {
  const render::PixelRange range = render::rendered_range(job.settings.render.crop, job.scene.camera);
  return {range.width(), range.height()};
}

std::string picture_hash(const render::Image& image) {
  ContentHash hash;
  hash.add(fmt::format("{} x {}", image.width, image.height));
  hash.add(image.pixels.data(), image.pixels.size() * sizeof(Rgb));
  return hash.text();
}

render::Method reference_method(const SceneNeeds& needs) {
  return needs.specular ? render::Method::kAuto : render::Method::kMc;
}

std::optional<Reference> make_reference(const ReferenceChoice& choice, Job& job, const SweepFolder& folder,
                                        const ReferenceProgress& progress, const Console& console) {
  std::optional<Reference> reference;
  if (!choice.file.empty())
    reference = read_reference(choice.file, job);
  else
    reference = find_reference(job, folder, console);
  if (!reference) {
    const render::Method method = choice.method.value_or(reference_method(job.scene.needs));
    reference = render_reference(choice, method, job, folder, progress, console);
  }
  if (!reference) return std::nullopt;
  reference->hash = picture_hash(reference->image);
  reference->about.mean = mean_of(reference->image);
  reference->about.picture = "reference.png";
  reference->about.tone = tone_for(reference->image, reference->lights, job.settings.tone, console);
  write_picture(folder.path(reference->about.picture), reference->image, reference->about.tone);
  return reference;
}

}  // namespace kaustik::app
