#pragma once
// The curves of `kaustik bench --plot`.

#include <utility>

#include "apps/bench/bench_result.h"
#include "apps/bench/chart.h"

namespace kaustik::app {

struct Figure {
  std::string file_name;
  Chart chart;
};

// speed-up-<photons>.svg for each photon count: speed-up over threads, by phase. photons-per-second.svg:
// photons traced per second over threads, by photon count; without photons there is none.
// seconds-over-photons.svg, for two photon counts and more: time by phase on the most threads. Phases of less
// than 1 % of the total are left out.
std::vector<Figure> scaling_figures(const BenchResult& result);

}  // namespace kaustik::app
