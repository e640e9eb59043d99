#pragma once
// The image in square tiles, rendered in parallel. Every pixel is a function of (seed, pass, pixel) alone, so
// the same bits come out for any number of threads.

#include "render/render_context.h"

namespace kaustik::render {

inline constexpr int kTileSize = 16;

// Renders settings.spp samples of each pixel of the film's window into the film, and adds to the ray, gather,
// lecture and drop counts of statistics. False when progress cancelled; then tiles are missing.
bool render_tiles(const RenderContext& ctx, uint64_t pass, const ProgressCallback& progress, Film* film,
                  RenderStatistics* statistics);

}  // namespace kaustik::render
