#pragma once
// Sums over complete passes of a render: all that is needed for the picture and for rendering further passes.

#include <optional>

#include "render/film/film_totals.h"
#include "render/maps/gather_radii.h"
#include "render/passes/pass_set.h"
#include "render/statistics/statistics.h"

namespace kaustik::render {

struct PassSums {
  PassSet passes;       // the complete passes
  uint64_t shares = 1;  // number of passes among which the settings' photons and samples are divided
  FilmTotals totals;    // may be without pixels if there is no pass
  std::optional<GatherRadii> radii;  // r0 of the first pass, once known
  RenderStatistics statistics;

  // Adds other passes of the same render. Any order and any split give the same bits, except for the seconds.
  // Throws std::invalid_argument if a pass is in both, or if shares, window, units or radii differ; then
  // nothing is changed.
  void add(const PassSums& other);
  // Makes them the sums of no pass; keeps the memory of the pixels.
  void clear();
};

}  // namespace kaustik::render
