#include "apps/bench/bench_table.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "apps/bench/span.h"
#include "apps/command_line/values.h"
#include "apps/session/files/scene_loading.h"

namespace kaustik::app {

namespace {

constexpr size_t kLabelWidth = 24, kCellWidth = 26;
constexpr size_t kColumns = 4;  // columns per block; more threads start another block below

struct Unit {
  double size = 1;
  std::string_view name;
};

constexpr Unit kSeconds[] = {{1, "s"}, {1e-3, "ms"}, {1e-6, "us"}};
constexpr Unit kCounts[] = {{1e9, "G"}, {1e6, "M"}, {1e3, "k"}, {1, ""}};
constexpr Unit kBytes[] = {{1e9, "GB"}, {1e6, "MB"}, {1e3, "kB"}};

// The largest unit in which the value is at least 1, else the smallest unit.
template <size_t N>
Unit unit_for(double value, const Unit (&units)[N]) {
  const auto fits = [&](const Unit& unit) { return value >= unit.size; };
  const Unit* found = std::find_if(units, units + N, fits);
  return found != units + N ? *found : units[N - 1];
}

std::string three_digits(double value) {
  return fmt::format("{:.{}f}", value, value < 9.995 ? 2 : value < 99.95 ? 1 : 0);
}

template <size_t N>
std::string cell(const Spread& s, const Unit (&units)[N]) {
  const Unit unit = unit_for(s.median, units);
  const auto number = [&](double value) { return three_digits(value / unit.size); };
  return fmt::format("{}{}{} ({}..{})", number(s.median), unit.name.empty() ? "" : " ", unit.name,
                     number(s.min), number(s.max));
}

using Points = std::vector<const BenchPoint*>;

// Adds a row, unless all its cells are empty.
template <class Cell>
void add_row(std::string& table, std::string_view label, const Points& points, Cell&& text_of) {
  std::string line = fmt::format("  {:<{}}", label, kLabelWidth);
  bool any = false;
  for (const BenchPoint* point : points) {
    const std::string text = text_of(*point);
    any |= !text.empty();
    line += fmt::format("{:<{}}", text, kCellWidth);
  }
  if (!any) return;
  line.erase(line.find_last_not_of(' ') + 1);
  table += line + '\n';
}

constexpr std::pair<Rate, std::string_view> kRateRows[] = {{Rate::kPhotons, "photons/s"},
                                                           {Rate::kPhotonRays, "photon rays/s"},
                                                           {Rate::kPhotonShadowRays, "photon shadow rays/s"},
                                                           {Rate::kCameraRays, "camera rays/s"},
                                                           {Rate::kSpecularRays, "specular rays/s"},
                                                           {Rate::kShadowRays, "shadow rays/s"},
                                                           {Rate::kBounceRays, "bounce rays/s"},
                                                           {Rate::kGatherQueries, "gathers/s"},
                                                           {Rate::kGatherCandidates, "photons tested/s"}};

constexpr std::pair<Phase, std::string_view> kPhaseRows[] = {{Phase::kBvh, "BVH build"},
                                                             {Phase::kPhotonTrace, "photon trace"},
                                                             {Phase::kPhotonBuild, "photon map build"},
                                                             {Phase::kRender, "image"},
                                                             {Phase::kTotal, "total"}};

std::string speed_up_cell(const BenchResult& result, const BenchPoint& point, Phase phase) {
  const std::optional<Spread> gain = speed_up(result, point, phase);
  if (!gain) return {};
  return fmt::format("{:.2f} x, {:.0f} %", gain->median, 100 * efficiency(result, point, phase).value());
}

void add_columns(std::string& table, const BenchResult& result, const Points& points) {
  add_row(table, "threads", points, [](const BenchPoint& p) { return fmt::format("{}", p.threads); });
  for (const auto& [rate, label] : kRateRows) {
    add_row(table, label, points, [rate = rate](const BenchPoint& p) {
      return p[rate].median > 0 ? cell(p[rate], kCounts) : std::string();
    });
  }
  for (const auto& [phase, label] : kPhaseRows) {
    add_row(table, label, points, [phase = phase](const BenchPoint& p) {
      return p[phase].median > 0 ? cell(p[phase], kSeconds) : std::string();
    });
  }
  add_row(table, "cores busy", points, [](const BenchPoint& p) { return cell(p.busy_cores, kCounts); });
  add_row(table, "waited for cores", points, [](const BenchPoint& p) {
    return p.waiting ? fmt::format("{:.1f} % ({:.1f}..{:.1f})", 100 * p.waiting->median, 100 * p.waiting->min,
                                   100 * p.waiting->max)
                     : "not available";
  });
  add_row(table, "energy/1M photons", points, [](const BenchPoint& p) {
    return p.joules ? fmt::format("{:.3g} J", p.joules->median * 1e6 / double(p.photons)) : "not available";
  });
  add_row(table, "peak memory", points,
          [](const BenchPoint& p) { return cell(p.peak_memory_bytes, kBytes); });
  table += "  speed-up, efficiency\n";
  for (const auto& [phase, label] : kPhaseRows) {
    add_row(table, fmt::format("  {}", label), points,
            [&, phase = phase](const BenchPoint& p) { return speed_up_cell(result, p, phase); });
  }
}

// Writes nested counters with dotted names: {"stored": {"direct": 5}} becomes "stored.direct 5". Omits zeros.
void flatten(const Json& value, const std::string& name, std::vector<std::string>& out) {
  if (value.is_object()) {
    for (const auto& [key, inner] : value.items()) flatten(inner, name.empty() ? key : name + "." + key, out);
  } else if (value.is_number_unsigned()) {
    if (value.get<uint64_t>() > 0) out.push_back(fmt::format("{} {}", name, grouped(value.get<uint64_t>())));
  }
}

void add_counters(std::string& table, const Json& counters) {
  table += "  exact counts, the same on any number of threads\n";
  for (const auto& [key, value] : counters.items()) {
    std::vector<std::string> texts;
    flatten(value, value.is_object() ? "" : key, texts);
    if (!texts.empty()) table += fmt::format("    {:<{}}{}\n", key, kLabelWidth - 2, fmt::join(texts, ", "));
  }
}

// Photons that grow with the threads: how many times as many are traced and stored in the same time.
std::string weak_table(const BenchResult& result, const BenchPoint& first) {
  constexpr std::pair<Phase, std::string_view> kGrowing[] = {{Phase::kPhotonTrace, "photon trace"},
                                                             {Phase::kPhotonBuild, "photon map build"}};
  std::string table = fmt::format("\n{} photons per thread\n  threads", count_text(first.photons_per_thread));
  for (const auto& [phase, label] : kGrowing)
    table += fmt::format("   {:<24}{:<20}", label, "times the photons");
  table.erase(table.find_last_not_of(' ') + 1);
  table += '\n';
  for (const BenchPoint& point : result.points) {
    if (&baseline_of(result, point) != &first) continue;
    table += fmt::format("  {:>7}", point.threads);
    for (const auto& [phase, label] : kGrowing)
      table += fmt::format("   {:<24}{:<20}", point[phase].median > 0 ? cell(point[phase], kSeconds) : "-",
                           speed_up_cell(result, point, phase));
    table.erase(table.find_last_not_of(' ') + 1);
    table += '\n';
  }
  return table;
}

}  // namespace

std::string machine_line(const BenchResult& result) {
  const auto text = [](const Json& object, const char* key) -> std::string {
    const auto found = object.is_object() ? object.find(key) : object.end();
    if (found == object.end() || found->is_null() || found->is_structured()) return "?";
    return found->is_string() ? found->get<std::string>() : found->dump();
  };
  const std::string usable = text(result.machine.value("cores", Json::object()), "usable");
  return fmt::format("{}, {}, {} usable core{}", text(result.machine, "cpu"), text(result.machine, "isa"),
                     usable, usable == "1" ? "" : "s");
}

std::string bench_table(const BenchResult& result) {
  std::string table = fmt::format("{}\n{}; kaustik {} ({})\nmedian (min..max) of {}\n", result.scene,
                                  machine_line(result), result.version, result.build,
                                  result.repeat == 1 ? "1 run" : fmt::format("{} runs", result.repeat));
  for (const BenchPoint& point : result.points) {
    if (&baseline_of(result, point) != &point || point.photons_per_thread > 0) continue;
    table += fmt::format("\n{} photons\n", count_text(point.photons));
    Points same;
    for (const BenchPoint& p : result.points)
      if (&baseline_of(result, p) == &point) same.push_back(&p);
    for (size_t i = 0; i < same.size(); i += kColumns) {
      if (i > 0) table += '\n';
      add_columns(
          table, result,
          Points(same.begin() + ptrdiff_t(i), same.begin() + ptrdiff_t(std::min(same.size(), i + kColumns))));
    }
    if (const auto share = fitted_serial_share(result, point, Phase::kTotal))
      table += fmt::format("  in one thread, by the curve  {:.1f} % of the total\n", 100 * *share);
    add_counters(table, point.counters);
  }
  if (is_disturbed(result))
    table += fmt::format(
        "\nOther programs ran: threads waited for cores for more than {:.0f} % of their time. The times are "
        "those "
        "of the machine, not of kaustik.\n",
        100 * kMostWaiting);
  for (const BenchPoint& point : result.points)
    if (point.photons_per_thread > 0 && &baseline_of(result, point) == &point)
      table += weak_table(result, point);
  for (const SpanPoint& span : result.spans) table += span_table(span);
  return table;
}

}  // namespace kaustik::app
