#include "apps/report/bench_report.h"

#include <fmt/format.h>

#include <filesystem>

#include "apps/bench/bench_json.h"
#include "apps/bench/bench_table.h"
#include "apps/html/html.h"
#include "report_assets.h"

namespace kaustik::app {

namespace {

std::string facts_html(const BenchResult& result) {
  std::string out;
  const auto add = [&](std::string_view name, const std::string& value) {
    out += fmt::format("<div><dt>{}</dt><dd>{}</dd></div>\n", name, html_escaped(value));
  };
  add("Machine", machine_line(result));
  add("Runs of each point", fmt::format("{}", result.repeat));
  add("Program", fmt::format("kaustik {} ({})", result.version, result.build));
  return out;
}

}  // namespace

std::string bench_report(const BenchResult& result) {
  const std::string name = html_escaped(std::filesystem::path(result.scene).filename().string());
  return filled(assets::bench_page, {{"title", name + " - kaustik bench"},
                                     {"style", std::string(assets::style)},
                                     {"scene", name},
                                     {"facts", facts_html(result)},
                                     {"table", html_escaped(bench_table(result))},
                                     {"data", script_json(bench_json(result))},
                                     {"chart_library", std::string(assets::chart_library)},
                                     {"chart_licence", html_escaped(assets::chart_licence)},
                                     {"charts", std::string(assets::charts)},
                                     {"script", std::string(assets::bench_script)}});
}

}  // namespace kaustik::app
