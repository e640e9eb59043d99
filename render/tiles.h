#pragma once
// The image in square tiles, rendered in parallel. Every sample is a function of (seed, pixel, number) alone,
// so the same bits come out for any number of threads.

#include "render/render_context.h"

namespace kaustik::render {

inline constexpr int kTileSize = 16;

// Adds the samples of ctx.pass to each pixel of the film's window, and to the ray, gather, lecture and drop
// counts of statistics. False when progress cancelled; then tiles are missing.
bool render_tiles(const RenderContext& ctx, const ProgressCallback& progress, FilmSums* film,
                  RenderStatistics* statistics);

}  // namespace kaustik::render
