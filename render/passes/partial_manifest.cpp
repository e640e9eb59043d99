// Writes and reads the manifest; each group of values has one list of names for both directions.

#include "render/passes/partial_manifest.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

namespace kaustik::render {

namespace {

using Json = nlohmann::ordered_json;

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
  f("emitted", e.emitted), f("absorbed", e.absorbed), f("escaped", e.escaped);
  f("terminated", e.terminated), f("roulette", e.roulette), f("invalid", e.invalid);
}

template <class Statistics, class F>
void for_each_time(Statistics& s, F&& f) {
  f("photon_trace", s.photon_trace_s), f("photon_build", s.photon_build_s), f("render", s.render_s);
}

template <class Needs, class F>
void for_each_need(Needs& n, F&& f) {
  f("specular", n.specular), f("delta", n.delta), f("diffuse", n.diffuse);
  f("only_delta_lights", n.only_delta_lights), f("infinite_light", n.infinite_light);
  f("sky_alone", n.sky_alone), f("any_light", n.any_light);
}

// Exact text of a float, in C's hexadecimal notation.
std::string hex(float value) {
  return fmt::format("{:a}", value);
}

float from_hex(const Json& json) {
  const std::string text = json.get<std::string>();
  char* end = nullptr;
  const float value = std::strtof(text.c_str(), &end);
  if (text.empty() || *end != '\0' || !(value >= 0) || !std::isfinite(value))
    throw std::runtime_error(fmt::format("`{}` is not a radius", text));
  return value;
}

// Accepts only exponents whose powers of two are representable as doubles.
int exponent_from(const Json& json) {
  const int exponent = json.get<int>();
  if (exponent < -1000 || exponent > 1000)
    throw std::runtime_error(fmt::format("2^{} is not a valid unit", exponent));
  return exponent;
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

Json statistics_part(const RenderStatistics& s) {
  Json counts, seconds, energy, examples = Json::array();
  for_each_count(s, [&](const std::string& name, const uint64_t& n) { counts[name] = n; });
  for_each_time(s, [&](const std::string& name, const double& t) { seconds[name] = t; });
  for_each_energy(s.photons.energy, [&](const std::string& name, const int64_t& n) { energy[name] = n; });
  energy["unit_exponent"] = s.photons.energy.unit_exponent;
  for (const DroppedSample& d : s.dropped_examples) examples.push_back({d.y, d.x, d.sample});
  return {{"counts", counts}, {"seconds", seconds}, {"energy", energy}, {"dropped_examples", examples}};
}

RenderStatistics statistics_from(const Json& json, const PassSums& sums) {
  RenderStatistics s;
  for_each_count(s, [&](const std::string& name, uint64_t& n) { json.at("counts").at(name).get_to(n); });
  for_each_time(s, [&](const std::string& name, double& t) { json.at("seconds").at(name).get_to(t); });
  photon::EnergyLedger& e = s.photons.energy;
  for_each_energy(e, [&](const std::string& name, int64_t& n) { json.at("energy").at(name).get_to(n); });
  e.unit_exponent = exponent_from(json.at("energy").at("unit_exponent"));
  for (const Json& d : json.at("dropped_examples"))
    s.dropped_examples.push_back({d.at(0).get<int>(), d.at(1).get<int>(), d.at(2).get<uint64_t>()});
  s.passes = sums.passes.count();
  if (sums.radii) {
    s.direct_radius = sums.radii->direct, s.caustic_radius = sums.radii->caustic;
    s.indirect_radius = sums.radii->indirect;
    s.radius = std::max({s.direct_radius, s.caustic_radius, s.indirect_radius});
  }
  return s;
}

PassSet passes_from(const Json& json) {
  const std::string text = json.get<std::string>();
  const auto passes = PassSet::parse(text);
  if (!passes && text != "none") throw std::runtime_error(fmt::format("`{}` is not a list of passes", text));
  return passes.value_or(PassSet());
}

Json window_json(const PixelWindow<PixelTotals>& p) {
  return {{"width", p.width()}, {"height", p.height()},         {"x0", p.x0()},
          {"y0", p.y0()},       {"full_width", p.full_width()}, {"full_height", p.full_height()}};
}

void take_window(const Json& json, ReadManifest* out) {
  json.at("width").get_to(out->width), json.at("height").get_to(out->height);
  json.at("x0").get_to(out->x0), json.at("y0").get_to(out->y0);
  json.at("full_width").get_to(out->full_width), json.at("full_height").get_to(out->full_height);
  constexpr int kMost = 65535;
  const auto inside = [](int first, int size, int full) {
    return first >= 0 && size >= 1 && full <= kMost && size <= full && first <= full - size;
  };
  if (!inside(out->x0, out->width, out->full_width) || !inside(out->y0, out->height, out->full_height))
    throw std::runtime_error("the window lies outside the image");
}

Json manifest_json(const PartialManifest& m, const PassSums& sums) {
  Json out;
  out["build"] = m.build;
  out["isa"] = m.isa;
  out["scene"] = {{"path", m.scene_path}, {"hash", m.scene_hash}};
  out["settings"] = settings_json(m.settings);
  out["presentation"] = settings_json(m.presentation);
  out["outputs"] = m.outputs;
  out["passes"] = sums.passes.text();
  out["goal"] = m.goal.text();
  out["stopped_by"] = m.stopped_by;
  out["passes_of_settings"] = sums.shares;
  out["radii"] = nullptr;
  if (const auto& r = sums.radii)
    out["radii"] = {{"direct", hex(r->direct)},
                    {"caustic", hex(r->caustic)},
                    {"indirect", hex(r->indirect)},
                    {"caustic_nearest", r->caustic_nearest},
                    {"direct_nearest", r->direct_nearest}};
  out["window"] = window_json(sums.totals.pixels());
  out["halves"] = sums.totals.has_halves();
  const ExactUnits& units = sums.totals.units();
  out["unit_exponents"] = {{"radiance", units.radiance}, {"square", units.square}, {"depth", units.depth}};
  for_each_need(m.needs, [&](const std::string& name, const bool& need) { out["needs"][name] = need; });
  out["statistics"] = statistics_part(sums.statistics);
  return out;
}

}  // namespace

std::string manifest_text(const PartialManifest& manifest, const PassSums& sums) {
  try {
    return manifest_json(manifest, sums).dump(1);
  } catch (const Json::exception&) {
    throw std::runtime_error("the name of the scene or of an output is not UTF-8");
  }
}

ReadManifest manifest_from_text(std::string_view text) {
  const Json json = Json::parse(text);
  ReadManifest out;
  PartialManifest& m = out.result.manifest;
  PassSums& sums = out.result.sums;
  json.at("build").get_to(m.build);
  json.at("isa").get_to(m.isa);
  json.at("scene").at("path").get_to(m.scene_path);
  json.at("scene").at("hash").get_to(m.scene_hash);
  m.settings = settings_from(json.at("settings"));
  m.presentation = settings_from(json.at("presentation"));
  json.at("outputs").get_to(m.outputs);
  sums.passes = passes_from(json.at("passes"));
  m.goal = passes_from(json.at("goal"));
  json.at("stopped_by").get_to(m.stopped_by);
  json.at("passes_of_settings").get_to(sums.shares);
  if (sums.shares < 1 || sums.shares > kMostPasses)
    throw std::runtime_error("the number of passes is out of range");
  if (const Json& r = json.at("radii"); !r.is_null())
    sums.radii = {from_hex(r.at("direct")), from_hex(r.at("caustic")), from_hex(r.at("indirect")),
                  r.at("caustic_nearest").get<uint32_t>(), r.at("direct_nearest").get<uint32_t>()};
  take_window(json.at("window"), &out);
  json.at("halves").get_to(out.halves);
  const Json& units = json.at("unit_exponents");
  out.units = {.radiance = exponent_from(units.at("radiance")),
               .square = exponent_from(units.at("square")),
               .depth = exponent_from(units.at("depth"))};
  for_each_need(m.needs,
                [&](const std::string& name, bool& need) { json.at("needs").at(name).get_to(need); });
  sums.statistics = statistics_from(json.at("statistics"), sums);
  return out;
}

}  // namespace kaustik::render
