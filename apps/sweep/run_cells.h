#pragma once
// The renders of a sweep.

#include <functional>
#include <optional>

#include "apps/session/scene_loading.h"
#include "apps/sweep/reference.h"
#include "apps/sweep/sweep_folder.h"
#include "apps/sweep/sweep_grid.h"

namespace kaustik::app {

// What all cells share.
struct SweepJob {
  const Job& job;
  const SweepGrid& grid;
  const SettingOverrides& overrides;
  const Reference& reference;
  render::CompareOptions compare;
};

// Work done and in all, in photons and samples; false cancels. From worker threads, one at a time.
using SweepProgress = std::function<bool(uint64_t done, uint64_t total)>;

struct RunCells {
  std::vector<SweepCell> cells;  // all that are finished, in the grid's order
  size_t reused = 0;             // of them, those that an earlier run had finished
  bool cancelled = false;
};

// Takes what is finished from the folder and renders the rest, one cell after the other, each with all seeds;
// keeps each cell when it is finished.
RunCells run_cells(const SweepJob& sweep, const std::vector<SweepPoint>& points, const SweepFolder& folder,
                   const SweepProgress& progress, const Console& console);

}  // namespace kaustik::app
