#include "apps/report/sweep_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "apps/html/html.h"
#include "apps/import/common/scene_files.h"
#include "apps/session/stopping/stop_rules.h"
#include "apps/sweep/sweep_files.h"
#include "core/base64.h"
#include "report_assets.h"

namespace kaustik::app {

namespace {

std::string data_uri(const std::filesystem::path& path) {
  std::string error;
  const auto bytes = pbrt::read_bytes(ReadableFile::trusted(path), uint64_t{1} << 30, error);
  if (!bytes) throw std::runtime_error(fmt::format("{}: {}", path.string(), error));
  return "data:image/png;base64," + base64(*bytes);
}

Json pictures_json(const SweepResult& result, const std::filesystem::path& folder) {
  Json out = Json::object();
  const auto add = [&](const std::string& name) { out[name] = data_uri(folder / name); };
  add(result.reference.picture);
  for (const SweepCell& cell : result.cells) add(cell.picture), add(cell.error_map);
  return out;
}

// The advice as list items, with the options to type set as code.
std::string advice_html(const SweepResult& result) {
  std::string out;
  for (const Advice& advice : advice_of(result.cells)) {
    std::string text = html_escaped(advice.text);
    const std::string flags = html_escaped(result.cells[advice.named].flags);
    if (const size_t at = text.find(flags); at != std::string::npos)
      text.replace(at, flags.size(), "<code>" + flags + "</code>");
    out += fmt::format("<li{}>{}</li>\n", advice.cell ? "" : " class=\"missed\"", text);
  }
  return out;
}

std::string reference_text(const SweepReference& r) {
  std::string text = r.source;
  if (r.seconds > 0) text += fmt::format(", {:.0f} s", r.seconds);
  if (r.noise) text += fmt::format(", own noise {}", percent(std::sqrt(*r.noise)));
  return text;
}

std::string facts_html(const SweepResult& result) {
  std::string out;
  const auto add = [&](std::string_view name, const std::string& value) {
    out += fmt::format("<div><dt>{}</dt><dd>{}</dd></div>\n", name, html_escaped(value));
  };
  add("Picture", fmt::format("{} x {} pixels", result.width, result.height));
  add("Reference", reference_text(result.reference));
  add("Seeds", fmt::format("{} for each point", result.seeds));
  if (result.mask_bright)
    add("Not compared",
        fmt::format("reference pixels brighter than {} and 2 pixels around them", *result.mask_bright));
  const Json& cpu = result.machine.contains("cpu") ? result.machine["cpu"] : Json(nullptr);
  add("Machine",
      fmt::format("{}, {} thread{}", cpu.is_string() ? cpu.get<std::string>() : "unknown processor",
                  result.threads, result.threads == 1 ? "" : "s"));
  add("Program", fmt::format("kaustik {} ({})", result.version, result.build));
  return out;
}

std::string number_or_dash(const std::optional<double>& value) {
  return value ? fmt::format("{:.3g}", *value) : "-";
}

// A cell of the table for each size of blocks but single pixels.
std::string blocks_html(const SweepCell& cell) {
  std::string out;
  for (size_t i = 1; i < cell.relmse_of_blocks.size(); ++i)
    out += fmt::format("<td>{:.3g}</td>", cell.relmse_of_blocks[i]);
  return out;
}

std::string blocks_heads() {
  std::string out;
  for (size_t i = 1; i < render::kBlockSides.size(); ++i)
    out += fmt::format("<th scope=\"col\">{0} x {0}</th>", render::kBlockSides[i]);
  return out;
}

std::string table_html(const SweepResult& result) {
  const std::vector<size_t> front = pareto_front(result.cells);
  std::string out;
  for (size_t i = 0; i < result.cells.size(); ++i) {
    const SweepCell& cell = result.cells[i];
    const bool on_front = std::find(front.begin(), front.end(), i) != front.end();
    out += fmt::format(
        "<tr{}><th "
        "scope=\"row\"><code>{}</code></th><td>{}</td><td>{:.3g}</td>{}<td>{:.3f}</td><td>{}</td><td>{}</"
        "td><td>{}</td>"
        "<td>{:.3g}</td><td>{}</td></tr>\n",
        on_front ? " class=\"front\"" : "", html_escaped(cell.flags), percent(std::sqrt(cell.error.relmse)),
        cell.error.relmse, blocks_html(cell), cell.flip, number_or_dash(cell.error.bias2),
        number_or_dash(cell.error.variance),
        cell.point.reads_photons() ? fmt::format("{:.3g}", cell.r0()) : "-", cell.time(),
        on_front ? "yes" : "");
  }
  return out;
}

std::string settings_html(const SweepResult& result) {
  std::string out;
  for (const auto& [name, text] : result.settings.items())
    out += fmt::format("<code>--{} {}</code> ", html_escaped(name), html_escaped(text.get<std::string>()));
  return out;
}

}  // namespace

std::string sweep_report(const SweepResult& result, const std::string& folder) {
  Json data = sweep_json(result);
  data["pictures"] = pictures_json(result, folder);
  const std::string name = html_escaped(std::filesystem::path(result.scene).filename().string());
  return filled(assets::sweep_page, {{"title", name + " - kaustik sweep"},
                                     {"style", std::string(assets::style)},
                                     {"scene", name},
                                     {"facts", facts_html(result)},
                                     {"advice", advice_html(result)},
                                     {"blocks", blocks_heads()},
                                     {"table", table_html(result)},
                                     {"settings", settings_html(result)},
                                     {"data", script_json(data.dump())},
                                     {"chart_library", std::string(assets::chart_library)},
                                     {"chart_licence", html_escaped(assets::chart_licence)},
                                     {"charts", std::string(assets::charts)},
                                     {"script", std::string(assets::sweep_script)}});
}

}  // namespace kaustik::app
