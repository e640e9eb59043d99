#include "render/tiles.h"

#include <tbb/parallel_for.h>

#include <atomic>
#include <mutex>

#include "core/sampling/sampler.h"
#include "render/photon_integrator.h"

namespace kaustik::render {

namespace {

constexpr uint64_t kCameraStream = 0xca3e;  // keeps the image's random numbers apart from the photons'

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

// Adds the pass's samples of pixel (x, y) of the full image. The box filter is uniform over the pixel.
void render_pixel(const RenderContext& ctx, int x, int y, PixelSum* sum, TileResult* tile) {
  const uint64_t pixel = uint64_t(y) * uint64_t(ctx.scene.camera.width) + uint64_t(x);
  const uint64_t stream = hash_combine(hash_combine(ctx.settings.seed, kCameraStream), pixel);
  for (uint64_t i = ctx.pass.first_sample; i < ctx.pass.end_sample; ++i) {
    Sampler sampler(stream, i);
    const Point2 u = sampler.next_2d();
    const Ray ray = ctx.scene.camera.generate_ray({float(x) + u.x, float(y) + u.y});
    // Once a pass: most of its noise is that of the photons, which all samples share.
    const bool with_bias = ctx.settings.estimate_bias.value_or(false) && i == ctx.pass.first_sample;
    const PixelResult sample = trace_camera_ray(ctx, ray, sampler, tile->counters, with_bias);
    if (valid_radiance(sample, ctx.plan.direct)) {
      sum->add(sample);
      continue;
    }
    ++tile->dropped;
    if (tile->examples.size() < kDropExamples) tile->examples.push_back({y, x, i});
  }
}

TileResult render_tile(const RenderContext& ctx, int tile_x, int tile_y, FilmSums* film) {
  TileResult tile;
  const int x1 = std::min(film->width(), (tile_x + 1) * kTileSize);
  const int y1 = std::min(film->height(), (tile_y + 1) * kTileSize);
  for (int y = tile_y * kTileSize; y < y1; ++y)
    for (int x = tile_x * kTileSize; x < x1; ++x)
      render_pixel(ctx, film->x0() + x, film->y0() + y, &film->at(x, y), &tile);
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
  const int columns = (film->width() + kTileSize - 1) / kTileSize;
  const int rows = (film->height() + kTileSize - 1) / kTileSize;
  const int tiles = columns * rows;
  std::mutex mutex;
  std::atomic<bool> cancelled{false};
  MergedTiles merged;
  uint64_t done = 0;
  tbb::parallel_for(
      tbb::blocked_range<int>(0, tiles, 1),
      [&](const tbb::blocked_range<int>& range) {
        for (int i = range.begin(); i < range.end() && !cancelled; ++i) {
          const TileResult tile = render_tile(ctx, i % columns, i / columns, film);
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
