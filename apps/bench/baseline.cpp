#include "apps/bench/baseline.h"

#include <fmt/format.h>

#include <stdexcept>

#include "apps/command_line/values.h"

namespace kaustik::app {

namespace {

const BenchPoint* same_point(const BenchResult& in, const BenchPoint& point) {
  for (const BenchPoint& other : in.points)
    if (other.photons == point.photons && other.threads == point.threads &&
        other.photons_per_thread == point.photons_per_thread)
      return &other;
  return nullptr;
}

// The first setting that differs, in words.
std::string difference(const Json& now, const Json& before) {
  for (const auto& [name, value] : now.items())
    if (!before.contains(name) || before[name] != value)
      return fmt::format("{} is {}, it was {}", name, value.dump(),
                         before.contains(name) ? before[name].dump() : "not there");
  return {};
}

std::string point_text(const BenchPoint& point) {
  return fmt::format("{} photons, {} thread{}", count_text(point.photons), point.threads,
                     point.threads == 1 ? "" : "s");
}

std::string ratio_cell(const Spread& now, const Spread& before) {
  if (!(now.min > 0) || !(before.min > 0)) return "-";
  return fmt::format("{:.2f} ({:.2f}..{:.2f})", now.median / before.median, now.min / before.max,
                     now.max / before.min);
}

// The phases in the order of the table.
constexpr std::pair<Phase, std::string_view> kCompared[] = {{Phase::kPhotonTrace, "photon trace"},
                                                            {Phase::kPhotonBuild, "photon map build"},
                                                            {Phase::kRender, "image"},
                                                            {Phase::kTotal, "total"}};

}  // namespace

std::string baseline_table(const BenchResult& now, const BenchResult& before) {
  if (const std::string why = difference(now.settings, before.settings); !why.empty())
    throw std::runtime_error("the baseline has other settings: " + why);
  std::string table =
      fmt::format("\ntime over that of the baseline, {} ({})\n  {:<26}", before.version, before.build, "");
  for (const auto& [phase, label] : kCompared) table += fmt::format("{:<22}", label);
  table += '\n';
  bool any = false;
  for (const BenchPoint& point : now.points) {
    const BenchPoint* const earlier = same_point(before, point);
    if (!earlier) continue;
    any = true;
    table += fmt::format("  {:<26}", point_text(point));
    for (const auto& [phase, label] : kCompared)
      table += fmt::format("{:<22}", ratio_cell(point[phase], (*earlier)[phase]));
    if (point.counters != earlier->counters) table += "other counts: not the same work";
    table += '\n';
  }
  if (!any) throw std::runtime_error("the baseline has no point with these photons and threads");
  if (now.machine.value("cpu", Json()) != before.machine.value("cpu", Json()))
    table += "  The baseline was measured on another processor.\n";
  return table;
}

std::string slow_down(const BenchResult& now, const BenchResult& before, double most) {
  for (const BenchPoint& point : now.points) {
    const BenchPoint* const earlier = same_point(before, point);
    if (!earlier) continue;
    const Spread &time = point[Phase::kTotal], &was = (*earlier)[Phase::kTotal];
    if (time.median > most * was.median && time.min > was.max)
      return fmt::format("{}: {:.3g} times as long as before", point_text(point), time.median / was.median);
  }
  return {};
}

}  // namespace kaustik::app
