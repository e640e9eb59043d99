#pragma once
// Camera samples of one block of neighbouring pixels, rendered together.

#include <array>
#include <vector>

#include "photon/estimate/estimate_batch.h"
#include "render/adaptive/sample_spread.h"
#include "render/camera/camera_rays.h"
#include "render/camera/pixel_range.h"
#include "render/film/film.h"
#include "render/render_context.h"

namespace kaustik::render {

// What the samples of a tile leave besides the film.
struct TileResult {
  TileCounters counters;
  uint64_t dropped = 0;
  std::vector<DroppedSample> examples;
};

// Numbers of samples of each pixel of a part of a block, and what they bring.
struct SampleRange {
  BlockPart part;
  uint64_t first, end;
  SampleLight light = SampleLight::kAll;
};

// Adds samples of pixels of one block of rays to film and tile, and to moments if there are any. pixels: of
// the full image. batch.begin_block() comes first.
void render_block(const RenderContext& ctx, const PixelRange& pixels, const SampleRange& samples,
                  photon::EstimateBatch* batch, FilmSums* film, BlockMoments* moments, TileResult* tile);

}  // namespace kaustik::render
