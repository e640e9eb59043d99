#include "apps/bench/span.h"

#include <fmt/format.h>

#include <algorithm>

#include "apps/command_line/values.h"
#include "apps/machine/thread_limit.h"
#include "apps/session/render_job.h"

namespace kaustik::app {

namespace {

// In the order of a render.
constexpr std::pair<std::string_view, std::string_view> kSpanPhases[] = {{"load", "load"},
                                                                         {"photon_trace", "photon trace"},
                                                                         {"photon_build", "photon map build"},
                                                                         {"render", "image"}};

void add(const PhaseSpan& phase, PhaseSpan* sum) {
  sum->seconds += phase.seconds;
  for (const auto& [name, place] : phase.places) {
    SpanPlace& to = sum->places[name];
    to.serial += place.serial, to.work += place.work, to.span += place.span, to.tasks += place.tasks;
  }
}

std::string row(std::string_view label, const PhaseSpan& phase) {
  std::string text = fmt::format("  {:<20}{:>10}{:>12.2f} %{:>12.2f} %", label,
                                 fmt::format("{:.3f} s", phase.seconds), 100 * phase.serial() / phase.seconds,
                                 100 * (phase.span() - phase.serial()) / phase.seconds);
  for (const int cores : kSpanCores) text += fmt::format("{:>8.1f}", phase.speed_up(cores));
  return text + '\n';
}

// What holds the render up most on many cores, the largest first.
std::string limits(const SpanPoint& point) {
  constexpr size_t kMost = 8;
  constexpr double kLeast = 5e-4;  // of the total
  struct Limit {
    double seconds;
    std::string text;
  };
  std::vector<Limit> found;
  const double total = total_of(point).seconds;
  for (const auto& [key, label] : kSpanPhases) {
    const auto phase = point.phases.find(std::string(key));
    if (phase == point.phases.end()) continue;
    for (const auto& [name, place] : phase->second.places) {
      found.push_back({place.serial, fmt::format("{}: in one thread before {}", label, name)});
      found.push_back(
          {place.span, fmt::format("{}: the longest of {} tasks of {}", label, place.tasks, name)});
    }
  }
  std::ranges::sort(found, std::greater<>(), &Limit::seconds);
  std::string text;
  for (size_t i = 0; i < std::min(kMost, found.size()) && found[i].seconds > kLeast * total; ++i)
    text += fmt::format("  {:>8.2f} %  {}\n", 100 * found[i].seconds / total, found[i].text);
  return text;
}

}  // namespace

PhaseSpan total_of(const SpanPoint& point) {
  PhaseSpan total;
  for (const auto& [key, label] : kSpanPhases)
    if (const auto phase = point.phases.find(std::string(key)); phase != point.phases.end())
      add(phase->second, &total);
  return total;
}

std::optional<SpanPoint> measure_span(const std::string& scene, const SettingOverrides& overrides,
                                      uint64_t photons, const Console& console,
                                      const std::function<bool()>& go_on) {
  SpanPoint point{photons, {}};
  bool complete = false;
  with_thread_limit(1, [&] {
    const WorkSpanRecorder recorder;
    Job job = load_job(scene, overrides, console);
    job.settings.render.photons = photons;
    job.settings.render.balance = render::Balance::kOff;
    job.settings.render.threads = 1;
    const RenderOutcome outcome =
        render_job(job.scene, job.settings.render, [&](const render::Progress&) { return go_on(); },
                   {.keep_sums = false});
    complete = !outcome.result.cancelled;
    point.phases = recorder.phases();
  });
  return complete ? std::optional(std::move(point)) : std::nullopt;
}

std::string span_table(const SpanPoint& point) {
  std::string table = fmt::format(
      "\nwork and span of {} photons, from a run in one thread\n"
      "  {:<20}{:>10}{:>14}{:>14}   speed-up on{}\n",
      count_text(point.photons), "", "work", "one thread", "longest task", "");
  std::string cores = fmt::format("  {:<58}", "");
  for (const int n : kSpanCores) cores += fmt::format("{:>8}", n);
  table += cores + '\n';
  for (const auto& [key, label] : kSpanPhases)
    if (const auto phase = point.phases.find(std::string(key));
        phase != point.phases.end() && phase->second.seconds > 0)
      table += row(label, phase->second);
  table += row("total, without BVH", total_of(point));
  return table + "  what holds it up, of the total:\n" + limits(point);
}

}  // namespace kaustik::app
