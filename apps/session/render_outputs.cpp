#include "apps/session/render_outputs.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "apps/session/denoising.h"
#include "apps/session/files/file_writer.h"
#include "apps/session/files/output_files.h"
#include "apps/session/files/scene_loading.h"
#include "apps/session/stopping/stop_rules.h"
#include "apps/session/tone.h"
#include "apps/settings/settings_json.h"
#include "core/stopwatch.h"
#include "render/film/media_sums.h"
#include "render/picture/exposure.h"
#include "render/picture/image_io.h"

namespace kaustik::app {

namespace {

// Logs where the photons' flux went, as shares of the emitted flux. Those of flux that arrives somewhere can
// exceed 100 % together, by the noise of Russian roulette.
void report_energy(const render::RenderStatistics& s, const Console& console) {
  const photon::EnergyLedger& e = s.photons.energy;
  if (e.emitted == 0) return;
  const auto share = [&](int64_t units) { return 100 * double(units) / double(e.emitted); };
  const std::string in_media =
      e.in_media == 0 ? "" : fmt::format("{:.2f} % absorbed by media, ", share(e.in_media));
  console.note(fmt::format(
      "energy: {:.5g} W emitted (R + G + B); {:.2f} % absorbed, {}{:.2f} % escaped, {:.2f} % not traced "
      "further, as no map needs it or --max-bounces ends it; noise of Russian roulette, zero on average: "
      "{:+.2f} %",
      e.watts(e.emitted) / double(std::max<uint64_t>(1, s.passes)), share(e.absorbed), in_media,
      share(e.escaped), share(e.terminated), share(e.roulette)));
  if (e.unaccounted() != 0)
    console.warning(
        fmt::format("energy: {:.3g} % of the photons' flux is unaccounted for", share(e.unaccounted())));
}

// Logs the radius of each map that holds photons.
void report_radii(const render::RenderStatistics& s, const Console& console) {
  using photon::PhotonKind;
  const auto stored = [&](PhotonKind kind) {
    return s.photons.stored[size_t(kind)] + s.guided.stored[size_t(kind)] > 0;
  };
  std::vector<std::string> radii;
  if (stored(PhotonKind::kDirect) || stored(PhotonKind::kShadow))
    radii.push_back(fmt::format("direct {:.4g} m", s.direct_radius));
  if (stored(PhotonKind::kCaustic)) radii.push_back(fmt::format("caustic {:.4g} m", s.caustic_radius));
  if (stored(PhotonKind::kIndirect)) radii.push_back(fmt::format("indirect {:.4g} m", s.indirect_radius));
  if (stored(PhotonKind::kMediumCaustic))
    radii.push_back(fmt::format("medium-caustic {:.4g} m", s.medium_caustic_radius));
  if (stored(PhotonKind::kMediumIndirect))
    radii.push_back(fmt::format("medium-indirect {:.4g} m", s.medium_indirect_radius));
  if (!radii.empty())
    console.note(
        fmt::format("gather radius{}: {}", s.passes > 1 ? " of the first pass" : "", fmt::join(radii, ", ")));
}

// Warns where nearly all photons miss what is seen, and the few that are left tell indirect light at a
// handful of places only: each disc is then as wide as much of the scene, and the light in it has one tone.
void warn_of_starved_map(const render::RenderResult& result, const Console& console) {
  // A disc should hold 200 photons (docs/decisions/031-gather-radius.md), so these are 16 discs side by side.
  constexpr uint64_t kFew = 16 * 200;
  constexpr uint64_t kLost = 64;  // emitted photons for each that was stored
  const render::RenderStatistics& s = result.statistics;
  // Where light is divided, paths bring what few photons tell little about.
  if (result.plan.indirect != render::IndirectEstimator::kPhotons) return;
  const size_t kind = size_t(photon::PhotonKind::kIndirect);
  const uint64_t stored = s.photons.stored[kind] + s.guided.stored[kind];
  const uint64_t emitted = s.photons.emitted + s.guided.emitted;
  if (stored >= kFew || stored * kLost >= emitted) return;
  console.warning(
      fmt::format("only {} of {} photons bring indirect light to surfaces, too few to tell how it varies: "
                  "expect wide patches of one tone, or none of it. --method mc needs no photons; more "
                  "--photons help in proportion",
                  grouped(stored), grouped(emitted)));
}

// Logs the seconds of each phase, which add up to the total. That of a continued or merged render is the time
// of this process alone, while the phases contain those of the parts before.
void report_times(const render::RenderStatistics& s, const render::OuterTimes& t, const Console& console) {
  const double phases =
      t.load + t.bvh + t.trials + s.photon_trace_s + s.photon_build_s + s.render_s + t.denoise + t.write;
  const double other = t.total - phases;
  console.note(fmt::format(
      "seconds: load {:.2f}, bvh {:.2f}, trials {:.2f}, photon trace {:.2f}, photon build {:.2f}, render "
      "{:.2f}, denoise {:.2f}, write {:.2f}, {}",
      t.load, t.bvh, t.trials, s.photon_trace_s, s.photon_build_s, s.render_s, t.denoise, t.write,
      other < 0 ? fmt::format("this process {:.2f}", t.total)
                : fmt::format("other {:.2f}, total {:.2f}", other, t.total)));
}

std::string by_kind(const std::array<uint64_t, photon::kPhotonKinds>& counts) {
  std::string text;
  const size_t in_media = size_t(photon::PhotonKind::kMediumCaustic);
  for (size_t k = 0; k < counts.size(); ++k)
    if (k < in_media || counts[k] > 0)
      text += fmt::format("{}{} {}", k == 0 ? "" : ", ", photon::kPhotonKindNames[k], grouped(counts[k]));
  return text;
}

void report_photons(const render::RenderResult& result, const Console& console) {
  const render::RenderStatistics& s = result.statistics;
  if (!s.any_photons()) return;
  if (s.photons.emitted > 0)
    console.note(fmt::format("photons: {} emitted; stored: {}", grouped(s.photons.emitted),
                             by_kind(s.photons.stored)));
  if (s.guided.emitted > 0)
    console.note(fmt::format(
        "guided photons: {} emitted; stored: {}; guide learned from {} photons, of which {} were useful",
        grouped(s.guided.emitted), by_kind(s.guided.stored), grouped(s.guide_photons),
        grouped(s.guide_hits)));
  report_energy(s, console);
  report_radii(s, console);
  warn_of_starved_map(result, console);
  if (result.plan.direct == render::DirectEstimator::kLecture) {
    console.note(fmt::format(
        "lecture: {} points decided by photons ({} of them in a larger cell); shadow rays at {} points with "
        "too few "
        "photons, {} with shadow photons, {} near a cell's face",
        grouped(s.lecture.from_photons), grouped(s.lecture.climbed), grouped(s.lecture.fallback_few),
        grouped(s.lecture.fallback_shadow), grouped(s.lecture.fallback_face)));
  }
}

// The layers to write. Without the layers error and bias, and with a warning, if they are not known: the
// error needs two passes.
std::vector<render::Layer> layers_of(const Outcome& outcome, const Console& console) {
  const std::vector<std::string>& names = outcome.settings.render.aov;
  std::vector<render::Layer> layers = render::layers_from_names(names);
  const bool names_media = std::any_of(names.begin(), names.end(),
                                       [](const std::string& name) { return name.starts_with("media_"); });
  if (!outcome.manifest.needs.scattering && std::erase_if(layers, render::is_media_layer) > 0 && names_media)
    console.warning("the layers of media are left out: no medium of the scene scatters light");
  const bool bias_known =
      !outcome.result.statistics.any_photons() || outcome.settings.render.estimate_bias.value_or(false);
  if (!bias_known && std::erase(layers, render::Layer::kBias) > 0 && names_error_layer(names))
    console.warning("the layer bias is left out: these passes did not measure it");
  if (std::isfinite(outcome.result.error)) return layers;
  std::erase(layers, render::Layer::kError);
  std::erase(layers, render::Layer::kBias);
  if (names_error_layer(names))
    console.warning("the layers error and bias are left out: they need at least two passes");
  return layers;
}

// Logs the error estimate; a single pass has none.
void report_error(const render::RenderResult& result, const render::RenderSettings& settings,
                  const Console& console) {
  if (!std::isfinite(result.error)) return;
  console.note(fmt::format("error: {} of the radiance at 90 % confidence, mean over pixels; {}{}",
                           percent(result.error),
                           settings.estimate_bias.value_or(false) ? "noise and kernel bias" : "noise alone",
                           settings.denoise.value_or(false) ? ", before denoising" : ""));
}

// Writes the files of -o: pictures and partial results. Returns what turned radiance into PNG and JPEG files,
// if there are any.
std::optional<render::ToneSettings> write_pictures(const std::vector<std::string>& files,
                                                   const Outcome& outcome,
                                                   const std::optional<render::Image>& picture,
                                                   const nlohmann::ordered_json& settings, FileWriter& writer,
                                                   const Console& console) {
  const render::RenderResult& result = outcome.result;
  render::WriteOptions options;
  options.layers = layers_of(outcome, console);
  if (picture) options.picture = &*picture;
  if (render::names_denoising(outcome.settings.render.aov)) {
    if (result.halves.width() > 0)
      options.halves = &result.halves;
    else
      console.warning("the halves of samples are left out: the passes were rendered without --aov denoising");
  }
  options.metadata = render::metadata_of(result, outcome.settings.render, settings);
  if (const std::string& rule = outcome.manifest.stopped_by; !rule.empty())
    options.metadata.emplace_back("kaustik:stopped_by", rule);
  const bool tones = std::any_of(files.begin(), files.end(), shows_tones);
  if (tones) {
    std::optional<render::Image> of_film;
    const render::Image& shown = picture ? *picture : of_film.emplace(render::image_of(result.film));
    options.tone = tone_for(shown, render::lights_seen(result.film), outcome.settings.tone, console);
  }
  for (const std::string& path : files) {
    if (!render::is_partial_name(path))
      writer.write(path, [&] { render::write_film(path, result.film, options); });
    else if (!result.sums.passes.empty())
      writer.write(path, [&] { render::write_partial(path, outcome.manifest, result.sums); });
  }
  return tones ? std::optional(options.tone) : std::nullopt;
}

}  // namespace

void add_output_options(Command& command, OutputOptions& options, const std::string& by_default) {
  Option& output = command.add_list(
      "-o,--output", "FILE", options.files,
      "File to write: .exr (float, with layers), .png, .jpg, or .kpart (a partial result). Repeat the option "
      "for more files. Default: " +
          by_default);
  output.at_commas = false;  // file names may hold commas
  command.add_text("--stats", "FILE", options.statistics,
                   "Write counts, times and settings to this JSON file");
}

void check_outputs(const OutputOptions& options) {
  for (const std::string& path : options.files) {
    if (render::is_partial_name(path))
      check_writable(path);
    else
      check_image_output(path);
  }
  if (!options.statistics.empty()) check_writable(options.statistics);
}

void warn_of_layers(const OutputOptions& options, const std::vector<std::string>& layers,
                    const Console& console) {
  if (layers.empty() || !std::all_of(options.files.begin(), options.files.end(), shows_tones)) return;
  console.warning(fmt::format("no file holds the layer{} {}: only EXR files do, `-o FILE.exr`",
                              layers.size() == 1 ? "" : "s", fmt::join(layers, ", ")));
}

std::vector<NamedFile> named_files(const OutputOptions& options) {
  std::vector<NamedFile> files;
  for (const std::string& path : options.files) files.push_back({"-o", path});
  if (!options.statistics.empty()) files.push_back({"--stats", options.statistics});
  return files;
}

bool write_outputs(const OutputOptions& options, const Outcome& outcome, render::OuterTimes times,
                   const Console& console) {
  const render::RenderResult& result = outcome.result;
  const auto picture = denoised(result, outcome.settings.render, console, &times.denoise);
  times.total += times.denoise;
  if (outcome.live) outcome.live->picture.show(result.film, picture ? &*picture : nullptr);
  const Stopwatch watch;
  nlohmann::ordered_json settings = statistics_settings(outcome.settings, result.plan);
  FileWriter writer(console);
  if (const auto tone = write_pictures(options.files, outcome, picture, settings, writer, console)) {
    settings["exposure"] = tone->exposure;
    settings["tonemap"] = render::name_of(tone->tonemap);
  }
  times.write = watch.seconds();
  times.total += times.write;
  if (!options.statistics.empty())
    writer.write(options.statistics, [&] {
      write_text_file(options.statistics,
                      render::statistics_json(result, outcome.settings.render, settings,
                                              outcome.manifest.needs, times, outcome.memory));
    });
  report(result, times, console);
  report_error(result, outcome.settings.render, console);
  return writer.report();
}

void report(const render::RenderResult& result, const render::OuterTimes& times, const Console& console) {
  const render::RenderStatistics& s = result.statistics;
  report_photons(result, console);
  report_times(s, times, console);
  if (s.dropped_samples > 0) {
    console.warning(
        fmt::format("{} samples were negative or not finite and were dropped", s.dropped_samples));
    for (const render::DroppedSample& example : s.dropped_examples) console.note("  " + example.text());
  }
  if (s.clamped_sums > 0)
    console.warning(
        fmt::format("{} pixel sums of a pass were out of range and were clamped", s.clamped_sums));
}

}  // namespace kaustik::app
