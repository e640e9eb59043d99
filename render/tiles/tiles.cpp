// Renders tiles in parallel, first with even and then with adaptive samples, and merges their counts.

#include "render/tiles/tiles.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <functional>
#include <mutex>
#include <optional>

#include "render/adaptive/sample_counts.h"
#include "render/tiles/block_samples.h"

namespace kaustik::render {

namespace {

// Merges tiles by integer sums and a sorted list, so that the order in which they finish does not matter.
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

// Renders one pass's samples of all pixels in the film's window.
class TilePass {
 public:
  TilePass(const RenderContext& ctx, const ProgressCallback& progress, FilmSums* film)
      : ctx_(ctx), progress_(progress), film_(*film) {
    const PixelRange window{film->x0(), film->x0() + film->width(), film->y0(), film->y0() + film->height()};
    window.for_each_square(kTileSize, [this](const PixelRange& tile) { tiles_.push_back(tile); });
    if (ctx.samples.further_work > 0) counts_.emplace(*film);
    to_do_ = tiles_.size() * (counts_ ? 2 : 1);
  }

  // False when the progress callback cancelled.
  bool render() {
    if (!each_tile(&TilePass::first_samples)) return false;
    if (!counts_) return true;
    counts_->choose_counts(samples(), ctx_.samples.further_work);
    sort_by_work();
    return each_tile(&TilePass::further_samples);
  }

  void fill(RenderStatistics* statistics) const { merged_.fill(statistics); }

 private:
  uint64_t samples() const { return ctx_.samples.end - ctx_.samples.first; }  // first samples of each pixel

  void first_samples(const PixelRange& block, photon::EstimateBatch* batch, TileResult* tile) {
    const SampleRange range{BlockPart::kWhole, ctx_.samples.first, ctx_.samples.end};
    if (!counts_) return render_block(ctx_, block, range, batch, &film_, nullptr, tile);
    BlockMoments moments;
    render_block(ctx_, block, range, batch, &film_, &moments, tile);
    for (int half = 0; half < kHalves; ++half)
      counts_->spread(block.x0, block.y0, half) = spread_of(moments, half);
  }

  void further_samples(const PixelRange& block, photon::EstimateBatch* batch, TileResult* tile) {
    const uint64_t first = ctx_.samples.end;
    for (int half = 0; half < kHalves; ++half) {
      const uint64_t more = counts_->count(block.x0, block.y0, half) - samples();
      const SampleRange range{half == 0 ? BlockPart::kEven : BlockPart::kOdd, first, first + more,
                              counts_->light(block.x0, block.y0, half)};
      render_block(ctx_, block, range, batch, &film_, nullptr, tile);
    }
  }

  // Starts with the tiles that take most samples, so that no thread is left with a long one at the end.
  void sort_by_work() {
    const auto counts = [&](const PixelRange& tile) {
      uint64_t sum = 0;
      tile.for_each_square(kRayBlock, [&](const PixelRange& block) {
        for (int half = 0; half < kHalves; ++half) sum += counts_->count(block.x0, block.y0, half);
      });
      return sum;
    };
    std::ranges::stable_sort(tiles_, std::greater<>(), counts);
  }

  using BlockRenderer = void (TilePass::*)(const PixelRange&, photon::EstimateBatch*, TileResult*);

  TileResult render_tile(const PixelRange& tile, BlockRenderer add_samples) {
    TileResult result;
    photon::EstimateBatch batch;
    tile.for_each_square(kRayBlock, [&](const PixelRange& block) {
      batch.begin_block();
      (this->*add_samples)(block, &batch, &result);
    });
    return result;
  }

  // Renders all tiles in parallel. False when the progress callback cancelled.
  bool each_tile(BlockRenderer add_samples) {
    std::mutex mutex;
    std::atomic<size_t> next{0};
    tbb::parallel_for(
        size_t(0), tiles_.size(),
        [&](size_t) {
          if (cancelled_) return;
          const TileResult tile = render_tile(tiles_[next++], add_samples);
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
  std::vector<PixelRange> tiles_;
  std::optional<SampleCounts> counts_;  // set if adaptive samples follow
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
