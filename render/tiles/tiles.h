#pragma once
// Renders the image in square tiles, in parallel. Every sample is a function of (seed, pixel, number) alone,
// so the result has the same bits for any number of threads.

#include "render/estimators/render_context.h"
#include "render/film/film.h"
#include "render/plan/progress.h"

namespace kaustik::render {

inline constexpr int kTileSize = 16;

// Adds the samples of ctx.pass to each pixel of the film's window, and their ray, gather, lecture and drop
// counts to statistics. False when the progress callback cancelled; then tiles are missing. The callback is
// called at the start, after each tile, and several times a second within long ones.
bool render_tiles(const RenderContext& ctx, const ProgressCallback& progress, FilmSums* film,
                  RenderStatistics* statistics);

}  // namespace kaustik::render
