#include "render/tiles.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <mutex>
#include <numeric>

#include "render/block_samples.h"
#include "render/sample_counts.h"

namespace kaustik::render {

namespace {

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

// fn(corner) for the blocks that a tile touches: the corner of the part that lies in it.
template <class Fn>
void for_each_block(const PixelRange& tile, const Fn& fn) {
  for (int y = tile.y0 - tile.y0 % kRayBlock; y < tile.y1; y += kRayBlock)
    for (int x = tile.x0 - tile.x0 % kRayBlock; x < tile.x1; x += kRayBlock)
      fn(tile.in_square(x, y, kRayBlock));
}

// A pass's samples of the film's window.
class TilePass {
 public:
  TilePass(const RenderContext& ctx, const ProgressCallback& progress, FilmSums* film)
      : ctx_(ctx),
        progress_(progress),
        film_(*film),
        window_{film->x0(), film->x0() + film->width(), film->y0(), film->y0() + film->height()},
        counts_(*film) {
    // Tiles are counted from the corner of the full image, as the blocks of rays are.
    for (int y = window_.y0 - window_.y0 % kTileSize; y < window_.y1; y += kTileSize)
      for (int x = window_.x0 - window_.x0 % kTileSize; x < window_.x1; x += kTileSize)
        tiles_.push_back(window_.in_square(x, y, kTileSize));
    to_do_ = tiles_.size() * (adapts() ? 2 : 1);
  }

  // False when progress cancelled.
  bool render() {
    if (!each_tile([this](const PixelRange& tile) { return first_samples(tile); })) return false;
    if (!adapts()) return true;
    counts_.share_out(samples(), 1 + ctx_.samples.further_work);
    sort_by_work();
    return each_tile([this](const PixelRange& tile) { return further_samples(tile); });
  }

  void fill(RenderStatistics* statistics) const { merged_.fill(statistics); }

 private:
  bool adapts() const { return ctx_.samples.further_work > 0; }
  uint64_t samples() const { return ctx_.samples.end - ctx_.samples.first; }  // of each pixel, at first

  TileResult first_samples(const PixelRange& tile) {
    TileResult result;
    photon::EstimateBatch batch;
    for_each_block(tile, [&](const PixelRange& block) {
      BlockMoments moments;
      batch.begin_block();
      render_block(ctx_, block, {BlockPart::kWhole, ctx_.samples.first, ctx_.samples.end}, &batch, &film_,
                   &moments, &result);
      if (!adapts()) return;
      for (int half = 0; half < kHalves; ++half)
        counts_.spread(block.x0, block.y0, half) = spread_of(moments, half);
    });
    return result;
  }

  TileResult further_samples(const PixelRange& tile) {
    TileResult result;
    photon::EstimateBatch batch;
    for_each_block(tile, [&](const PixelRange& block) {
      BlockMoments ignored;
      batch.begin_block();
      for (int half = 0; half < kHalves; ++half) {
        const uint64_t first = ctx_.samples.end;
        const uint64_t more = counts_.count(block.x0, block.y0, half) - samples();
        const SampleRange range{half == 0 ? BlockPart::kEven : BlockPart::kOdd, first, first + more};
        render_block(ctx_, block, range, &batch, &film_, &ignored, &result);
      }
    });
    return result;
  }

  // The longest tiles first, so that no thread is left with one at the end.
  void sort_by_work() {
    const auto counts = [&](const PixelRange& tile) {
      uint64_t sum = 0;
      for_each_block(tile, [&](const PixelRange& block) {
        for (int half = 0; half < kHalves; ++half) sum += counts_.count(block.x0, block.y0, half);
      });
      return sum;
    };
    std::ranges::stable_sort(tiles_, std::greater<>(), counts);
  }

  // render_tile(tile) for all. False when progress cancelled.
  template <class Fn>
  bool each_tile(const Fn& render_tile) {
    std::mutex mutex;
    std::atomic<size_t> next{0};
    tbb::parallel_for(
        size_t(0), tiles_.size(),
        [&](size_t) {
          if (cancelled_) return;
          const TileResult tile = render_tile(tiles_[next++]);
          const std::lock_guard lock(mutex);
          merged_.add(tile);
          ++done_;
          if (progress_ && !progress_({"render", done_, to_do_, ctx_.pass.pass, ctx_.pass.shares}))
            cancelled_ = true;
        },
        tbb::simple_partitioner());
    return done_ % tiles_.size() == 0 && (done_ == to_do_ || !cancelled_);
  }

  const RenderContext& ctx_;
  const ProgressCallback& progress_;
  FilmSums& film_;
  PixelRange window_;
  std::vector<PixelRange> tiles_;
  SampleCounts counts_;
  MergedTiles merged_;
  uint64_t done_ = 0, to_do_ = 0;
  std::atomic<bool> cancelled_{false};
};

}  // namespace

bool render_tiles(const RenderContext& ctx, const ProgressCallback& progress, FilmSums* film,
                  RenderStatistics* statistics) {
  TilePass pass(ctx, progress, film);
  const bool finished = pass.render();
  pass.fill(statistics);
  return finished;
}

}  // namespace kaustik::render
