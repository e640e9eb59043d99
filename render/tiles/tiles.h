#pragma once
// Renders the image in square tiles, in parallel. Every sample is a function of (seed, pixel, number) alone,
// so the result has the same bits for any number of threads.

#include <functional>

#include "render/camera/pixel_range.h"
#include "render/estimators/render_context.h"
#include "render/film/pass_film.h"
#include "render/plan/progress.h"

namespace kaustik::render {

// Pixels a side that a thread renders at a time. Tiles with glass take fifteen times as long as the mean:
// they are small, so that many threads do not wait for the last of them.
inline constexpr int kTileSize = 8;

// Returns how much work adaptive samples may add in all, as a multiple of that of the first samples. Asked
// before each round of them: `done` is what earlier rounds were allowed, `seconds` what the last round, or
// the first samples, took.
using AdaptiveWork = std::function<double(double done, double seconds)>;

// Adaptive samples come in rounds, which end at fixed multiples of the first samples' work, so that the same
// total gives the same bits: 0.75, 1.125, 1.5, 2.25, 3, ... A total below 0.75 comes in two rounds: the short
// one tells how long the rest takes, which a trial hardly knows.
inline constexpr double kFirstRound = 0.75, kShortRound = 0.1875;
inline double first_round(double total) {
  return total < kFirstRound ? kShortRound : kFirstRound;
}
// The end of the round after one that ends at `end`.
inline double next_round(double end) {
  if (end < kFirstRound) return kFirstRound;
  double doubled = kFirstRound;
  while (2 * doubled <= end) doubled *= 2;
  return end == doubled ? 1.5 * doubled : 2 * doubled;
}
// The number of rounds for this much work.
inline size_t rounds_of(double work) {
  if (!(work > 0)) return 0;
  size_t rounds = 1;
  for (double end = first_round(work); end < work; end = next_round(end)) ++rounds;
  return rounds;
}

// Follows the picture while it is rendered. Called by many threads at once, for ranges that do not overlap,
// after their samples have been added to `sums`. cell: the square of this many pixels a side in whose corner
// the range lies, which it stands for until more of it is known.
using PixelsCallback = std::function<void(const PixelRange& range, int cell, const FilmSums& sums)>;

// Adds the samples of ctx.pass to each pixel of the film's window, and their ray, gather, lecture and drop
// counts to statistics. False when the progress callback cancelled; then tiles are missing. The callback is
// called at the start, after each tile, and several times a second within long ones. If ctx allows adaptive
// samples, adaptive_work, if set, says how many; statistics says what it allowed. If on_pixels is set, blocks
// are rendered coarse to fine: first those in a wide grid, then those of ever finer grids between them.
bool render_tiles(const RenderContext& ctx, const ProgressCallback& progress, PassFilm* film,
                  RenderStatistics* statistics, const AdaptiveWork& adaptive_work = {},
                  const PixelsCallback& on_pixels = {});

}  // namespace kaustik::render
