// Writes and reads the manifest.

#include "render/passes/partial_manifest.h"

#include <fmt/format.h>

#include <bit>
#include <type_traits>

#include "render/passes/json_numbers.h"
#include "render/passes/manifest_values.h"

namespace kaustik::render {

namespace {

using Json = ManifestJson;

// Pixels are written as they are laid out in memory, without padding: the sums of the layers, two times three
// sums of squares, weight and passes.
static_assert(sizeof(PixelTotals) == 16 * (kSumChannels + 6) + 16);
static_assert(std::endian::native == std::endian::little);
static_assert(std::is_trivially_copyable_v<PixelTotals> && std::is_trivially_copyable_v<HalfTotals>);
static_assert(std::is_trivially_copyable_v<MediaTotals> && sizeof(MediaTotals) == 16 * kMediaChannels);
static_assert(sizeof(HalfTotals) == 16 * (kHalfChannels + kHalfMapChannels) + 16);

template <class Needs, class F>
void for_each_need(Needs& n, F&& f) {
  f("specular", n.specular), f("delta", n.delta), f("diffuse", n.diffuse);
  f("only_delta_lights", n.only_delta_lights), f("infinite_light", n.infinite_light);
  f("sky_alone", n.sky_alone), f("any_light", n.any_light);
}
// Those of effects that came later: files that do not name them have none.
template <class Needs, class F>
void for_each_later_need(Needs& n, F&& f) {
  f("glossy", n.glossy), f("media", n.media), f("scattering", n.scattering), f("dispersion", n.dispersion);
  f("emissive_media", n.emissive_media);
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
  take_whole(json, "width", &out->width), take_whole(json, "height", &out->height);
  take_whole(json, "x0", &out->x0), take_whole(json, "y0", &out->y0);
  take_whole(json, "full_width", &out->full_width), take_whole(json, "full_height", &out->full_height);
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
  out["radii"] = radii_json(sums.radii);
  out["window"] = window_json(sums.totals.pixels());
  out["halves"] = sums.totals.has_halves();
  out["media"] = sums.totals.has_media();
  const ExactUnits& units = sums.totals.units();
  out["unit_exponents"] = {{"radiance", units.radiance}, {"square", units.square}, {"depth", units.depth}};
  const auto write = [&](const std::string& name, const bool& need) { out["needs"][name] = need; };
  for_each_need(m.needs, write);
  for_each_later_need(m.needs, write);
  out["statistics"] = statistics_values(sums.statistics);
  return out;
}

}  // namespace

FilmTotals ReadManifest::empty_totals() const {
  FilmTotals totals(PixelWindow<PixelTotals>(width, height, x0, y0, full_width, full_height), units);
  if (halves) totals.keep_halves();
  if (media) totals.keep_media();
  return totals;
}

uint64_t ReadManifest::pixel_bytes() const {
  const uint64_t of_halves = halves ? sizeof(HalfTotals) : 0, of_media = media ? sizeof(MediaTotals) : 0;
  return uint64_t(width) * uint64_t(height) * (sizeof(PixelTotals) + of_halves + of_media);
}

std::array<std::span<std::byte>, 3> bytes_of(FilmTotals& totals) {
  return {std::as_writable_bytes(totals.pixels().all()), std::as_writable_bytes(totals.half_pixels().all()),
          std::as_writable_bytes(totals.media_pixels().all())};
}

std::array<std::span<const std::byte>, 3> bytes_of(const FilmTotals& totals) {
  return {std::as_bytes(totals.pixels().all()), std::as_bytes(totals.half_pixels().all()),
          std::as_bytes(totals.media_pixels().all())};
}

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
  constexpr const char* kShares = "passes_of_settings";
  sums.shares = whole_number<uint64_t>(json.at(kShares), kShares, 1, kMostPasses);
  sums.radii = radii_from(json.at("radii"));
  take_window(json.at("window"), &out);
  json.at("halves").get_to(out.halves);
  out.media = json.value("media", false);  // files of builds without these layers have none
  const Json& units = json.at("unit_exponents");
  out.units = {.radiance = exponent_from(units, "radiance"),
               .square = exponent_from(units, "square"),
               .depth = exponent_from(units, "depth")};
  for_each_need(m.needs,
                [&](const std::string& name, bool& need) { json.at("needs").at(name).get_to(need); });
  for_each_later_need(
      m.needs, [&](const std::string& name, bool& need) { need = json.at("needs").value(name, false); });
  sums.statistics = statistics_from(json.at("statistics"));
  sums.statistics.passes = sums.passes.count();
  if (sums.radii) note_radii(*sums.radii, &sums.statistics);
  return out;
}

}  // namespace kaustik::render
