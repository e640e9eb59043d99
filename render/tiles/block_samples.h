#pragma once
// Renders the camera samples of one block of neighbouring pixels together.

#include <array>
#include <functional>
#include <vector>

#include "photon/estimate/estimate_batch.h"
#include "render/adaptive/sample_spread.h"
#include "render/camera/camera_rays.h"
#include "render/camera/pixel_range.h"
#include "render/estimators/render_context.h"
#include "render/film/pass_film.h"

namespace kaustik::render {

// Results of a tile's samples besides the film.
struct TileResult {
  TileCounters counters;
  uint64_t dropped = 0;
  std::vector<DroppedSample> examples;
};

// Sample numbers [first, end) of each pixel in one part of a block, and which light they compute.
struct SampleRange {
  BlockPart part;
  uint64_t first, end;
  SampleLight light = SampleLight::kAll;
};

// Where the samples of a block go.
struct BlockSums {
  PassFilm* film;
  BlockMoments* moments;  // may be null
  TileResult* tile;
};

// Renders the samples of the pixels in one block of rays, and adds them to sums. pixels: in coordinates of
// the full image, within one block. batch.begin_block() must have been called for this block. go_on() is
// asked after each packet of rays; false, with samples missing, if it says no.
bool render_block(const RenderContext& ctx, const PixelRange& pixels, const SampleRange& samples,
                  photon::EstimateBatch* batch, const BlockSums& sums, const std::function<bool()>& go_on);

}  // namespace kaustik::render
