#include "render/tiles.h"

#include <tbb/parallel_for.h>

#include <array>
#include <atomic>
#include <mutex>

#include "render/camera_rays.h"
#include "render/photon_integrator.h"

namespace kaustik::render {

namespace {

struct TileResult {
  TileCounters counters;
  uint64_t dropped = 0;
  std::vector<DroppedSample> examples;
};

bool valid(const Rgb& c, bool signed_light) {
  return is_finite(c) && (signed_light || (c.x >= 0 && c.y >= 0 && c.z >= 0));
}

// Estimates that subtract may fall below zero, and are right on average only if they may.
bool valid_radiance(const PixelResult& s, DirectEstimator direct) {
  const bool predicted = direct == DirectEstimator::kPredicted;
  return valid(s.emitted, false) && valid(s.direct, predicted || direct == DirectEstimator::kSigned) &&
         valid(s.caustic, false) && valid(s.indirect, predicted) && is_finite(s.bias);
}

void expose(const Sensor& sensor, PixelResult* s) {
  if (sensor.neutral) return;
  for (Rgb* light : {&s->emitted, &s->direct, &s->caustic, &s->indirect, &s->bias}) *light = sensor(*light);
}

// Pixels [x0, x1) x [y0, y1) of the full image.
struct PixelRange {
  int x0, x1, y0, y1;

  // Its part within `side` pixels of the full image.
  PixelRange in_square(int x, int y, int side) const {
    return {std::max(x0, x), std::min(x1, x + side), std::max(y0, y), std::min(y1, y + side)};
  }
};

// Samples [first, end) of the pixels of one block of rays, pixel by pixel: neighbours in a block see much the
// same photons.
class BlockSamples {
 public:
  BlockSamples(const RenderContext& ctx, const PixelRange& pixels, uint64_t first, uint64_t end)
      : ctx_(ctx), pixels_(pixels), first_(first), end_(end) {
    rays_.trace(ctx.bvh, ctx.settings.seed, pixels.x0, pixels.y0, first, end - first);
  }

  void shade(photon::EstimateBatch* batch, TileCounters& counters) {
    for_each([&](int x, int y, uint64_t i, PixelResult& result) {
      batch->begin_pixel(pixel_of_block(x, y));
      const uint64_t stream = pixel_stream(ctx_.settings.seed, ctx_.scene.camera, x, y);
      Sampler sampler(stream, i, ray_dimensions(ctx_.scene.camera));
      // Once a pass: most of its noise is that of the photons, which all samples share.
      const bool with_bias = ctx_.settings.estimate_bias.value_or(false) && i == ctx_.pass.first_sample;
      const CameraSample sample{rays_.ray(x, y, i), rays_.hit(x, y, i), with_bias, batch};
      trace_camera_ray(ctx_, sample, sampler, counters, &result);
    });
    batch->flush(counters.gather);
  }

  void add_to(FilmSums* film, TileResult* tile) {
    for_each([&](int x, int y, uint64_t i, PixelResult& result) {
      if (valid_radiance(result, ctx_.plan.direct)) {
        expose(ctx_.scene.sensor, &result);
        film->at(x - film->x0(), y - film->y0()).add(result, rays_.weight(x, y, i));
        return;
      }
      ++tile->dropped;
      add_examples({{y, x, i}}, &tile->examples);
    });
  }

 private:
  template <class Fn>
  void for_each(const Fn& fn) {
    PixelResult* result = results_.data();
    for (int y = pixels_.y0; y < pixels_.y1; ++y)
      for (int x = pixels_.x0; x < pixels_.x1; ++x)
        for (uint64_t i = first_; i < end_; ++i) fn(x, y, i, *result++);
  }

  static uint32_t pixel_of_block(int x, int y) {
    static_assert(kRayBlock * kRayBlock <= photon::EstimateBatch::kPixels);
    return uint32_t(y % kRayBlock * kRayBlock + x % kRayBlock);
  }

  const RenderContext& ctx_;
  PixelRange pixels_;
  uint64_t first_, end_;
  CameraRays rays_;
  std::array<PixelResult, accel::kRayLanes> results_;
};

// Adds the pass's samples of pixels of one block of rays.
void render_block(const RenderContext& ctx, const PixelRange& pixels, FilmSums* film,
                  photon::EstimateBatch* batch, TileResult* tile) {
  const PassShare& pass = ctx.pass;
  batch->begin_block();
  for (uint64_t first = pass.first_sample; first < pass.end_sample; first += CameraRays::kSamples) {
    BlockSamples samples(ctx, pixels, first, std::min(pass.end_sample, first + CameraRays::kSamples));
    samples.shade(batch, tile->counters);
    samples.add_to(film, tile);
  }
}

TileResult render_tile(const RenderContext& ctx, const PixelRange& pixels, FilmSums* film) {
  TileResult tile;
  photon::EstimateBatch batch;
  for (int y = pixels.y0 - pixels.y0 % kRayBlock; y < pixels.y1; y += kRayBlock)
    for (int x = pixels.x0 - pixels.x0 % kRayBlock; x < pixels.x1; x += kRayBlock)
      render_block(ctx, pixels.in_square(x, y, kRayBlock), film, &batch, &tile);
  return tile;
}

// Integer sums and a sorted list: the order in which tiles finish leaves no trace.
struct MergedTiles {
  TileResult total;

  void add(const TileResult& tile) {
    total.counters.rays += tile.counters.rays;
    total.counters.lecture += tile.counters.lecture;
    total.counters.gather += tile.counters.gather;
    total.dropped += tile.dropped;
    add_examples(tile.examples, &total.examples);
  }

  void fill(RenderStatistics* s) const {
    s->rays += total.counters.rays;
    s->lecture += total.counters.lecture;
    s->gather_queries += total.counters.gather.queries;
    s->gather_candidates += total.counters.gather.candidates;
    s->gather_accepted += total.counters.gather.accepted;
    s->dropped_samples += total.dropped;
    add_examples(total.examples, &s->dropped_examples);
  }
};

}  // namespace

bool render_tiles(const RenderContext& ctx, const ProgressCallback& progress, FilmSums* film,
                  RenderStatistics* statistics) {
  const PixelRange window{film->x0(), film->x0() + film->width(), film->y0(), film->y0() + film->height()};
  // Tiles are counted from the corner of the full image, as the blocks of rays are.
  const int first_column = window.x0 / kTileSize, first_row = window.y0 / kTileSize;
  const int columns = (window.x1 - 1) / kTileSize + 1 - first_column;
  const int tiles = columns * ((window.y1 - 1) / kTileSize + 1 - first_row);
  std::mutex mutex;
  std::atomic<bool> cancelled{false};
  MergedTiles merged;
  uint64_t done = 0;
  tbb::parallel_for(
      tbb::blocked_range<int>(0, tiles, 1),
      [&](const tbb::blocked_range<int>& range) {
        for (int i = range.begin(); i < range.end() && !cancelled; ++i) {
          const int x = (first_column + i % columns) * kTileSize, y = (first_row + i / columns) * kTileSize;
          const TileResult tile = render_tile(ctx, window.in_square(x, y, kTileSize), film);
          const std::lock_guard lock(mutex);
          merged.add(tile);
          ++done;
          if (progress && !progress({"render", done, uint64_t(tiles), ctx.pass.pass, ctx.pass.shares}))
            cancelled = true;
        }
      },
      tbb::simple_partitioner());
  merged.fill(statistics);
  return done == uint64_t(tiles);
}

}  // namespace kaustik::render
