#pragma once
// Makes the figures of `kaustik bench --plot`.

#include <utility>

#include "apps/bench/bench_result.h"
#include "apps/bench/chart.h"

namespace kaustik::app {

struct Figure {
  std::string file_name;
  Chart chart;
};

// The figures of a result. speed-up-<photons>.svg, one per photon count, shows speed-ups over threads by
// phase. photons-per-second.svg shows photons traced per second over threads by photon count, if there are
// photons. seconds-over-photons.svg shows times over photon counts by phase for the largest number of
// threads, if there are several photon counts. Phases that take less than 1 % of the total are omitted.
std::vector<Figure> scaling_figures(const BenchResult& result);

}  // namespace kaustik::app
