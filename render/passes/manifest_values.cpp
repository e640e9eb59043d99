// Each group of values has one list of names for both directions.

#include "render/passes/manifest_values.h"

#include <fmt/format.h>

#include <cmath>
#include <cstdlib>
#include <stdexcept>

#include "render/passes/json_numbers.h"

namespace kaustik::render {

using Json = ManifestJson;

namespace {

// Calls f(name, count) for every count; used both for writing and for reading.
template <class Statistics, class F>
void for_each_count(Statistics& s, F&& f) {
  f("emitted", s.photons.emitted);
  for (size_t k = 0; k < photon::kPhotonKinds; ++k)
    f(fmt::format("stored_{}", photon::kPhotonKindNames[k]), s.photons.stored[k]);
  f("photon_rays", s.photons.rays), f("photon_shadow_rays", s.photons.shadow_rays);
  f("dropped_photons", s.photons.dropped_invalid);
  f("guided_emitted", s.guided.emitted);
  for (size_t k = 0; k < photon::kPhotonKinds; ++k)
    f(fmt::format("guided_stored_{}", photon::kPhotonKindNames[k]), s.guided.stored[k]);
  f("guided_rays", s.guided.rays), f("guided_dropped", s.guided.dropped_invalid);
  f("guide_photons", s.guide_photons), f("guide_hits", s.guide_hits), f("guide_boxes", s.guide_boxes);
  f("camera_rays", s.rays.camera), f("specular_rays", s.rays.specular);
  f("shadow_rays", s.rays.shadow), f("bounce_rays", s.rays.bounce);
  f("lecture_from_photons", s.lecture.from_photons), f("lecture_climbed", s.lecture.climbed);
  f("lecture_few", s.lecture.fallback_few), f("lecture_shadow", s.lecture.fallback_shadow);
  f("lecture_face", s.lecture.fallback_face);
  f("gather_queries", s.gather_queries), f("gather_candidates", s.gather_candidates);
  f("gather_accepted", s.gather_accepted);
  f("dropped_samples", s.dropped_samples), f("clamped_sums", s.clamped_sums);
  f("photon_bytes", s.photon_bytes), f("octree_nodes", s.octree_nodes);
}

template <class Ledger, class F>
void for_each_energy(Ledger& e, F&& f) {
  f("emitted", e.emitted), f("absorbed", e.absorbed), f("in_media", e.in_media);
  f("escaped", e.escaped), f("terminated", e.terminated);
  f("roulette", e.roulette), f("invalid", e.invalid);
}

template <class Statistics, class F>
void for_each_time(Statistics& s, F&& f) {
  f("photon_trace", s.photon_trace_s), f("photon_build", s.photon_build_s), f("render", s.render_s);
}

}  // namespace

std::string hex_text(float value) {
  return fmt::format("{:a}", value);
}

float finite_from_hex(const Json& json) {
  const std::string text = json.get<std::string>();
  char* end = nullptr;
  const float value = std::strtof(text.c_str(), &end);
  if (text.empty() || *end != '\0' || !std::isfinite(value))
    throw std::runtime_error(fmt::format("`{}` is not a number", text));
  return value;
}

int exponent_from(const Json& object, const char* key) {
  return whole_number(object.at(key), key, -1000, 1000);
}

Json settings_json(const SettingTexts& settings) {
  Json out = Json::object();
  for (const auto& [name, texts] : settings) out[name] = texts;
  return out;
}

SettingTexts settings_from(const Json& json) {
  SettingTexts out;
  for (const auto& [name, texts] : json.items())
    out.emplace_back(name, texts.get<std::vector<std::string>>());
  return out;
}

Json radii_json(const std::optional<GatherRadii>& radii) {
  if (!radii) return nullptr;
  return {{"direct", hex_text(radii->direct)},
          {"caustic", hex_text(radii->caustic)},
          {"indirect", hex_text(radii->indirect)},
          {"caustic_nearest", radii->caustic_nearest},
          {"direct_nearest", radii->direct_nearest},
          {"medium_caustic", hex_text(radii->medium_caustic)},
          {"medium_indirect", hex_text(radii->medium_indirect)},
          {"medium_caustic_nearest", radii->medium_caustic_nearest},
          {"medium_indirect_nearest", radii->medium_indirect_nearest},
          {"indirect_widest", radii->indirect_widest}};
}

std::optional<GatherRadii> radii_from(const Json& json) {
  if (json.is_null()) return std::nullopt;
  const auto radius = [&](const char* name) {
    const float r = finite_from_hex(json.at(name));
    if (!(r >= 0)) throw std::runtime_error(fmt::format("`{}` is not a radius", r));
    return r;
  };
  GatherRadii radii{radius("direct"), radius("caustic"), radius("indirect")};
  take_whole(json, "caustic_nearest", &radii.caustic_nearest);
  take_whole(json, "direct_nearest", &radii.direct_nearest);
  if (json.contains("indirect_widest")) take_whole(json, "indirect_widest", &radii.indirect_widest);
  if (!json.contains("medium_caustic")) return radii;  // from before there were photons in media
  take_whole(json, "medium_caustic_nearest", &radii.medium_caustic_nearest);
  take_whole(json, "medium_indirect_nearest", &radii.medium_indirect_nearest);
  radii.medium_caustic = radius("medium_caustic");
  radii.medium_indirect = radius("medium_indirect");
  return radii;
}

Json statistics_values(const RenderStatistics& s) {
  Json counts, seconds, energy, examples = Json::array();
  for_each_count(s, [&](const std::string& name, const uint64_t& n) { counts[name] = n; });
  for_each_time(s, [&](const std::string& name, const double& t) { seconds[name] = t; });
  for_each_energy(s.photons.energy, [&](const std::string& name, const int64_t& n) { energy[name] = n; });
  energy["unit_exponent"] = s.photons.energy.unit_exponent;
  for (const DroppedSample& d : s.dropped_examples) examples.push_back({d.y, d.x, d.sample});
  return {{"counts", counts}, {"seconds", seconds}, {"energy", energy}, {"dropped_examples", examples}};
}

RenderStatistics statistics_from(const Json& json) {
  RenderStatistics s;
  const Json &counts = json.at("counts"), &energy = json.at("energy");
  for_each_count(s, [&](const std::string& name, uint64_t& n) {
    // Files from before there were photons in media are read, too.
    if (counts.contains(name) || name.find("_medium-") == name.npos) take_whole(counts, name, &n);
  });
  for_each_time(s, [&](const std::string& name, double& t) { json.at("seconds").at(name).get_to(t); });
  photon::EnergyLedger& e = s.photons.energy;
  for_each_energy(e, [&](const std::string& name, int64_t& n) { take_whole(energy, name, &n); });
  e.unit_exponent = exponent_from(energy, "unit_exponent");
  const char* const key = "dropped_examples";
  for (const Json& d : json.at(key))
    s.dropped_examples.push_back({whole_number<int>(d.at(0), key), whole_number<int>(d.at(1), key),
                                  whole_number<uint64_t>(d.at(2), key)});
  return s;
}

}  // namespace kaustik::render
