#pragma once
// Renders the cells of a sweep.

#include <functional>
#include <optional>

#include "apps/session/files/scene_loading.h"
#include "apps/sweep/reference.h"
#include "apps/sweep/sweep_folder.h"
#include "apps/sweep/sweep_grid.h"

namespace kaustik::app {

// What all cells of a sweep share.
struct SweepJob {
  const Job& job;
  const SweepGrid& grid;
  const SettingOverrides& overrides;
  const Reference& reference;
  render::CompareOptions compare;
};

// Reports progress in photons plus camera samples; returning false cancels. Called from worker threads, one
// at a time.
using SweepProgress = std::function<bool(uint64_t done, uint64_t total)>;

struct RunCells {
  std::vector<SweepCell> cells;  // the finished cells in the grid's order
  size_t reused = 0;             // number of these that an earlier run finished
  bool cancelled = false;
};

// Takes finished cells from the folder and renders the others one after the other, each with all seeds. Each
// cell is stored in the folder when it is finished.
RunCells run_cells(const SweepJob& sweep, const std::vector<SweepPoint>& points, const SweepFolder& folder,
                   const SweepProgress& progress, const Console& console);

}  // namespace kaustik::app
