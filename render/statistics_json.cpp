// The JSON document of `--stats`, and image metadata.

#include "render/statistics_json.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "core/memory/process_memory.h"
#include "core/version.h"
#include "render/settings/names.h"

namespace kaustik::render {

namespace {

using Json = nlohmann::ordered_json;

uint64_t stored(const RenderStatistics& s, int kind) {
  return s.photons.stored[size_t(kind)] + s.guided.stored[size_t(kind)];
}

// Counts of guided shoots: photons emitted, and the photons, hits and boxes of the guide that they used.
Json guided_json(const RenderStatistics& s) {
  return {{"emitted", s.guided.emitted},
          {"learned_from", s.guide_photons},
          {"hits", s.guide_hits},
          {"boxes", s.guide_boxes}};
}

Json photons_json(const RenderStatistics& s) {
  Json of_kind;
  for (int k = 0; k < photon::kPhotonKinds; ++k)
    of_kind[std::string(photon::kPhotonKindNames[size_t(k)])] = stored(s, k);
  return {{"emitted", s.photons.emitted},
          {"guided", guided_json(s)},
          {"stored", of_kind},
          {"dropped_invalid", s.photons.dropped_invalid + s.guided.dropped_invalid},
          {"bytes", s.photon_bytes},
          {"octree_nodes", s.octree_nodes},
          {"passes", s.passes}};
}

// Mean watts per pass, summed over the three channels.
Json energy_json(const RenderStatistics& s) {
  const photon::EnergyLedger& e = s.photons.energy;
  const double passes = static_cast<double>(std::max<uint64_t>(1, s.passes));
  const auto watts = [&](int64_t units) { return e.watts(units) / passes; };
  return {{"emitted", watts(e.emitted)}, {"absorbed", watts(e.absorbed)},     {"in_media", watts(e.in_media)},
          {"escaped", watts(e.escaped)}, {"terminated", watts(e.terminated)}, {"roulette", watts(e.roulette)},
          {"invalid", watts(e.invalid)}, {"unaccounted", e.unaccounted()},    {"unit", e.watts(1)}};
}

Json rays_json(const RenderStatistics& s) {
  return {{"camera", s.rays.camera},
          {"specular", s.rays.specular},
          {"shadow", s.rays.shadow},
          {"bounce", s.rays.bounce},
          {"photon", s.photons.rays + s.guided.rays},
          {"photon_shadow", s.photons.shadow_rays}};
}

Json lecture_json(const LectureCounters& l) {
  return {{"from_photons", l.from_photons},
          {"climbed", l.climbed},
          {"fallback_few", l.fallback_few},
          {"fallback_shadow", l.fallback_shadow},
          {"fallback_face", l.fallback_face}};
}

Json seconds_json(const RenderStatistics& s, const OuterTimes& t) {
  return {{"load", t.load},
          {"bvh", t.bvh},
          {"trials", t.trials},
          {"photon_trace", s.photon_trace_s},
          {"photon_build", s.photon_build_s},
          {"render", s.render_s},
          {"denoise", t.denoise},
          {"write", t.write},
          {"total", t.total}};
}

}  // namespace

Json needs_json(const SceneNeeds& needs) {
  return {{"specular", needs.specular},
          {"delta", needs.delta},
          {"diffuse", needs.diffuse},
          {"only_delta_lights", needs.only_delta_lights},
          {"infinite_light", needs.infinite_light},
          {"sky_alone", needs.sky_alone},
          {"any_light", needs.any_light},
          {"media", needs.media},
          {"scattering", needs.scattering},
          {"emissive_media", needs.emissive_media},
          {"dispersion", needs.dispersion},
          {"left_out", needs.left_out()}};
}

uint64_t peak_memory_bytes() {
  return status_bytes("VmHWM:");
}

// The estimated error, or null where it is unknown.
Json error_json(const RenderResult& result, const RenderSettings& settings) {
  if (!std::isfinite(result.error)) return nullptr;
  return {{"relative", result.error},
          {"holds_bias", settings.estimate_bias.value_or(false)},
          {"before_denoising", settings.denoise.value_or(false)}};
}

Json counters_json(const RenderStatistics& s) {
  return {
      {"photons", photons_json(s)},
      {"rays", rays_json(s)},
      {"gather",
       {{"queries", s.gather_queries}, {"candidates", s.gather_candidates}, {"accepted", s.gather_accepted}}},
      {"fallbacks", lecture_json(s.lecture)},
      {"dropped_samples", s.dropped_samples},
      {"clamped_sums", s.clamped_sums}};
}

std::string statistics_json(const RenderResult& result, const RenderSettings& settings, const Json& shown,
                            const SceneNeeds& needs, const OuterTimes& times, const Json& memory) {
  const RenderStatistics& s = result.statistics;
  Json out;
  out["version"] = version();
  out["build"] = build_id();
  out["seed"] = settings.seed;
  out["width"] = result.film.width();
  out["height"] = result.film.height();
  out["cancelled"] = result.cancelled;
  out["pass_ranges"] = result.sums.passes.text();
  out["passes_of_settings"] = result.sums.shares;
  out["settings"] = shown;
  out.update(counters_json(s));
  out["error"] = error_json(result, settings);
  out["energy"] = energy_json(s);
  out["radius"] = s.radius;
  out["radii"] = {{"direct", s.direct_radius},
                  {"caustic", s.caustic_radius},
                  {"indirect", s.indirect_radius},
                  {"medium_caustic", s.medium_caustic_radius},
                  {"medium_indirect", s.medium_indirect_radius}};
  out["seconds"] = seconds_json(s, times);
  out["peak_memory_bytes"] = peak_memory_bytes();
  out["memory"] = memory;
  out["dropped_examples"] = Json::array();
  for (const DroppedSample& d : s.dropped_examples) out["dropped_examples"].push_back(d.text());
  out["needs"] = needs_json(needs);
  out["left_out"] = result.plan.notes;
  return out.dump(2) + "\n";
}

Metadata metadata_of(const RenderResult& result, const RenderSettings& settings, const Json& shown) {
  Metadata out = {{"Software", fmt::format("kaustik {} ({})", version(), build_id())}};
  for (const auto& [key, value] : shown.items())
    out.emplace_back("kaustik:" + key, value.is_string() ? value.get<std::string>() : value.dump());
  const RenderStatistics& s = result.statistics;
  out.emplace_back("kaustik:passes", fmt::format("{}", s.passes));
  out.emplace_back("kaustik:pass_ranges", result.sums.passes.text());
  out.emplace_back("kaustik:passes_of_settings", fmt::format("{}", result.sums.shares));
  out.emplace_back("kaustik:radius_used", fmt::format("{}", s.radius));
  out.emplace_back("kaustik:photons_emitted", fmt::format("{}", s.photons.emitted));
  out.emplace_back("kaustik:photons_guided", fmt::format("{}", s.guided.emitted));
  for (int k = 0; k < photon::kPhotonKinds; ++k)
    out.emplace_back(fmt::format("kaustik:photons_stored_{}", photon::kPhotonKindNames[size_t(k)]),
                     fmt::format("{}", stored(s, k)));
  if (std::isfinite(result.error)) {
    out.emplace_back("kaustik:error", fmt::format("{:.6g}", result.error));
    out.emplace_back("kaustik:error_holds",
                     settings.estimate_bias.value_or(false) ? "noise and kernel bias" : "noise");
    if (settings.denoise.value_or(false))
      out.emplace_back("kaustik:error_of", "the picture before denoising");
  }
  out.emplace_back("kaustik:dropped_samples", fmt::format("{}", s.dropped_samples));
  return out;
}

}  // namespace kaustik::render
