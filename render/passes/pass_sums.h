#pragma once
// What complete passes of a render add up to: all that a picture needs, and all that going on needs.

#include <optional>

#include "render/film/film_totals.h"
#include "render/passes/pass_set.h"
#include "render/passes/passes.h"
#include "render/statistics.h"

namespace kaustik::render {

struct PassSums {
  PassSet passes;       // that are complete
  uint64_t shares = 1;  // passes that the settings' photons and samples are shared out over
  FilmTotals totals;
  std::optional<GatherRadii> radii;  // r0 of the first pass, once settled
  RenderStatistics statistics;

  // Adds other passes of the same render: any order, any split gives the same bits (save seconds). Throws
  // std::invalid_argument when a pass is in both, or shares, window, units or radii differ; then nothing is
  // changed.
  void add(const PassSums& other);
};

}  // namespace kaustik::render
