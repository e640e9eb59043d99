#include "apps/sweep/sweep_result.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "apps/session/stopping/stop_rules.h"

namespace kaustik::app {

std::vector<size_t> pareto_front(const std::vector<SweepCell>& cells) {
  std::vector<size_t> order(cells.size());
  for (size_t i = 0; i < order.size(); ++i) order[i] = i;
  std::stable_sort(order.begin(), order.end(), [&](size_t a, size_t b) {
    if (cells[a].time() != cells[b].time()) return cells[a].time() < cells[b].time();
    return cells[a].error.relmse < cells[b].error.relmse;
  });
  std::vector<size_t> front;
  for (const size_t i : order)
    if (front.empty() || cells[i].error.relmse < cells[front.back()].error.relmse) front.push_back(i);
  return front;
}

namespace {

std::string seconds_text(double seconds) {
  return seconds < 10 ? fmt::format("{:.2g} s", seconds) : fmt::format("{:.0f} s", seconds);
}

// The fastest cell whose relative error is at most `target`.
std::optional<size_t> cheapest(const std::vector<SweepCell>& cells, const std::vector<size_t>& front,
                               double target) {
  for (const size_t i : front)
    if (std::sqrt(cells[i].error.relmse) <= target) return i;
  return std::nullopt;
}

}  // namespace

std::vector<Advice> advice_of(const std::vector<SweepCell>& cells) {
  std::vector<Advice> advice;
  const std::vector<size_t> front = pareto_front(cells);
  if (front.empty()) return advice;
  for (const double target : {0.2, 0.1, 0.05, 0.02, 0.01}) {
    const std::optional<size_t> found = cheapest(cells, front, target);
    if (!found) {
      const SweepCell& best = cells[front.back()];
      advice.push_back(
          {target, std::nullopt, front.back(),
           fmt::format("No point of this grid reaches {}. The best is {} with {}, {}.", percent(target),
                       percent(std::sqrt(best.error.relmse)), best.flags, seconds_text(best.time()))});
      break;
    }
    // If one cell is the fastest for several targets, keep only the smallest target.
    if (!advice.empty() && advice.back().cell == found) advice.pop_back();
    advice.push_back({target, found, *found,
                      fmt::format("For {} on this scene: {}, {}.", percent(target), cells[*found].flags,
                                  seconds_text(cells[*found].time()))});
  }
  return advice;
}

}  // namespace kaustik::app
