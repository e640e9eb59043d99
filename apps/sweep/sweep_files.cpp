#include "apps/sweep/sweep_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string_view>

#include "apps/bench/bench_json.h"
#include "render/passes/json_numbers.h"
#include "render/settings/names.h"

namespace kaustik::app {

namespace {

constexpr int kFormat = 1;  // incremented when readers of the old format would misread the new one

// The columns of relMSE of blocks, and the sides of the blocks; `relmse` is that of single pixels.
constexpr std::array<std::pair<std::string_view, std::string_view>, 3> kBlockColumns = {
    {{"relmse_2", "2"}, {"relmse_4", "4"}, {"relmse_8", "8"}}};
static_assert(kBlockColumns.size() + 1 == render::kBlockSides.size());

Json or_null(const std::optional<double>& value) {
  return value ? Json(*value) : Json(nullptr);
}

std::optional<double> optional_number(const Json& in) {
  return in.is_null() ? std::nullopt : std::optional(in.get<double>());
}

float radius_from(const Json& radii, const char* key) {
  const Json& value = radii.at(key);
  const double radius = value.is_number() ? value.get<double>() : -1;
  if (!(radius >= 0 && radius <= std::numeric_limits<float>::max()))
    throw std::runtime_error(fmt::format("\"{}\": expected a radius in metres, 0 or more", key));
  return static_cast<float>(radius);
}

// The values by the sides of their blocks.
Json blocks_json(const std::array<double, render::kBlockSides.size()>& values) {
  Json out;
  for (size_t i = 0; i < values.size(); ++i) out[std::to_string(render::kBlockSides[i])] = values[i];
  return out;
}

Json error_json(const SweepCell& cell) {
  const render::ErrorParts& e = cell.error;
  return {{"relmse", e.relmse},
          {"relative_rmse", std::sqrt(e.relmse)},
          {"bias2", or_null(e.bias2)},
          {"variance", or_null(e.variance)},
          {"relmse_by_seed", cell.relmse_by_seed},
          {"relmse_of_blocks", blocks_json(cell.relmse_of_blocks)},
          {"flip", cell.flip},
          {"pixels", {{"compared", e.compared}, {"masked", e.masked}, {"not_finite", e.not_finite}}}};
}

Json radii_json(const SweepCell& cell) {
  if (!cell.point.reads_photons()) return nullptr;
  const auto exact = [](float radius) { return double(radius); };
  return {{"largest", cell.r0()},
          {"direct", exact(cell.radii.direct)},
          {"caustic", exact(cell.radii.caustic)},
          {"indirect", exact(cell.radii.indirect)}};
}

Json reference_json(const SweepReference& r) {
  return {{"source", r.source},
          {"noise_relmse", or_null(r.noise)},
          {"seconds", r.seconds},
          {"passes", r.passes},
          {"mean", r.mean},
          {"picture", r.picture},
          {"exposure", double(r.tone.exposure)},
          {"tonemap", render::name_of(r.tone.tonemap)}};
}

Json advice_json(const std::vector<SweepCell>& cells) {
  Json out = Json::array();
  for (const Advice& a : advice_of(cells))
    out.push_back({{"target", a.target}, {"cell", a.cell ? Json(*a.cell) : Json(nullptr)}, {"text", a.text}});
  return out;
}

}  // namespace

Json cell_json(const SweepCell& cell) {
  const bool photons = cell.point.reads_photons();
  Json out;
  out["method"] = render::name_of(cell.point.method);
  out["photons"] = photons ? Json(cell.point.photons) : Json(nullptr);
  out["radius"] = photons ? Json(cell.point.radius.text()) : Json(nullptr);
  out["spp"] = cell.point.spp;
  out["flags"] = cell.flags;
  out["seeds"] = cell.error.images;
  out["error"] = error_json(cell);
  out["r0"] = radii_json(cell);
  for (size_t i = 0; i < kPhases; ++i)
    out["seconds"][std::string(kPhaseNames[i])] = spread_json(cell.seconds[i]);
  out["picture"] = cell.picture;
  out["error_map"] = cell.error_map;
  return out;
}

SweepCell cell_from_json(const Json& in) {
  SweepCell cell;
  const Json& error = in.at("error");
  render::take_whole(in, "seeds", &cell.error.images);
  error.at("relmse").get_to(cell.error.relmse);
  cell.error.bias2 = optional_number(error.at("bias2"));
  cell.error.variance = optional_number(error.at("variance"));
  error.at("relmse_by_seed").get_to(cell.relmse_by_seed);
  for (size_t i = 0; i < render::kBlockSides.size(); ++i)
    error.at("relmse_of_blocks").at(std::to_string(render::kBlockSides[i])).get_to(cell.relmse_of_blocks[i]);
  error.at("flip").get_to(cell.flip);
  const Json& pixels = error.at("pixels");
  render::take_whole(pixels, "compared", &cell.error.compared);
  render::take_whole(pixels, "masked", &cell.error.masked);
  render::take_whole(pixels, "not_finite", &cell.error.not_finite);
  if (const Json& r = in.at("r0"); !r.is_null())
    cell.radii = {radius_from(r, "direct"), radius_from(r, "caustic"), radius_from(r, "indirect")};
  for (size_t i = 0; i < kPhases; ++i) cell.seconds[i] = read_spread(in.at("seconds"), kPhaseNames[i]);
  in.at("picture").get_to(cell.picture);
  in.at("error_map").get_to(cell.error_map);
  return cell;
}

Json sweep_json(const SweepResult& result) {
  Json out;
  out["kaustik_sweep"] = kFormat;
  out["version"] = result.version;
  out["build"] = result.build;
  out["scene"] = result.scene;
  out["machine"] = result.machine;
  out["threads"] = result.threads;
  out["width"] = result.width;
  out["height"] = result.height;
  out["settings"] = result.settings;
  out["seeds"] = result.seeds;
  out["mask_bright"] = result.mask_bright ? Json(*result.mask_bright) : Json(nullptr);
  out["reference"] = reference_json(result.reference);
  out["cells"] = Json::array();
  const std::vector<size_t> front = pareto_front(result.cells);
  for (size_t i = 0; i < result.cells.size(); ++i) {
    Json cell = cell_json(result.cells[i]);
    cell["pareto"] = std::find(front.begin(), front.end(), i) != front.end();
    out["cells"].push_back(std::move(cell));
  }
  out["advice"] = advice_json(result.cells);
  return out;
}

std::string sweep_csv(const SweepResult& result) {
  std::string csv = "method,photons,radius,spp,seeds,r0_m,relmse,relative_rmse,bias2,variance";
  for (const auto& [name, side] : kBlockColumns) csv += fmt::format(",{}", name);
  csv += ",flip,seconds";
  for (size_t i = 0; i + 1 < kPhases; ++i) csv += fmt::format(",seconds_{}", kPhaseNames[i]);
  csv += ",pareto\n";
  const Json json = sweep_json(result);
  for (const Json& cell : json["cells"]) {
    const auto add = [&](const Json& value, char before = ',') {
      csv += fmt::format("{}{}", before,
                         value.is_string() ? value.get<std::string>()
                         : value.is_null() ? ""
                                           : value.dump());
    };
    csv += cell["method"].get<std::string>();
    for (const char* key : {"photons", "radius", "spp", "seeds"}) add(cell[key]);
    add(cell["r0"].is_null() ? Json(nullptr) : cell["r0"]["largest"]);
    for (const char* key : {"relmse", "relative_rmse", "bias2", "variance"}) add(cell["error"][key]);
    for (const auto& [name, side] : kBlockColumns) add(cell["error"]["relmse_of_blocks"][std::string(side)]);
    add(cell["error"]["flip"]);
    add(cell["seconds"]["total"]["median"]);
    for (size_t i = 0; i + 1 < kPhases; ++i) add(cell["seconds"][std::string(kPhaseNames[i])]["median"]);
    add(cell["pareto"]);
    csv += '\n';
  }
  return csv;
}

}  // namespace kaustik::app
