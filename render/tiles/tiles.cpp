// Renders tiles in parallel, first with even and then with adaptive samples, and merges their counts.

#include "render/tiles/tiles.h"

#include <algorithm>
#include <atomic>
#include <functional>
#include <mutex>
#include <optional>

#include "core/parallel/parallel.h"
#include "core/stopwatch.h"
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

constexpr double kSecondsBetweenReports = 0.1;

// Blocks of a square that one thread renders, 4 x 4 of them or fewer.
struct Tile {
  PixelRange pixels;        // the part of the square in the film's window
  int x, y;                 // the square's corner
  int stride = 1;           // blocks from one of the 4 x 4 to the next
  bool every_block = true;  // otherwise without those that a tile of twice this stride has
  bool counted = true;      // in the progress: of a tile that is rendered in parts, one is

  // Calls fn(block) for the blocks' parts in the film's window.
  template <class Fn>
  void for_each_block(const Fn& fn) const {
    const int step = kRayBlock * stride;
    for (int j = 0; j < kTileSize / kRayBlock; ++j)
      for (int i = 0; i < kTileSize / kRayBlock; ++i) {
        if (!every_block && i % 2 == 0 && j % 2 == 0) continue;
        const PixelRange block = pixels.in_square(x + i * step, y + j * step, kRayBlock);
        if (block.width() > 0 && block.height() > 0) fn(block);
      }
  }
};

// The sums of a tile before it is rendered, to which a cancelled tile returns: the finished tiles alone
// count.
class TileCopy {
 public:
  // has_samples: false before a pass's first samples, when all sums are zero and nothing is copied.
  TileCopy(const PassFilm& film, const Tile& tile, bool has_samples) : tile_(tile) {
    if (!has_samples) return;
    copy(film.sums, &sums_);
    if (film.halved()) copy(film.half, &half_);
    if (film.has_media()) copy(film.media, &media_);
  }

  void restore(PassFilm* film) const {
    put_back(sums_, &film->sums);
    if (film->halved()) put_back(half_, &film->half);
    if (film->has_media()) put_back(media_, &film->media);
  }

 private:
  template <class Fn>
  void for_each_pixel(const Fn& fn) const {
    tile_.for_each_block([&](const PixelRange& block) {
      for (int y = block.y0; y < block.y1; ++y)
        for (int x = block.x0; x < block.x1; ++x) fn(x, y);
    });
  }
  template <class Sum>
  void copy(const PixelWindow<Sum>& film, std::vector<Sum>* sums) const {
    sums->reserve(kTileSize * kTileSize);
    for_each_pixel([&](int x, int y) { sums->push_back(film.at(x - film.x0(), y - film.y0())); });
  }
  template <class Sum>
  void put_back(const std::vector<Sum>& sums, PixelWindow<Sum>* film) const {
    size_t i = 0;
    for_each_pixel(
        [&](int x, int y) { film->at(x - film->x0(), y - film->y0()) = sums.empty() ? Sum{} : sums[i++]; });
  }

  Tile tile_;
  std::vector<PixelSum> sums_;
  std::vector<HalfSum> half_;
  std::vector<MediaSum> media_;
};

// What a tile has counted so far, and whether it shall go on.
struct TileWork {
  TileResult result;
  std::function<bool()> go_on;
};

std::vector<Tile> tiles_of(const PixelRange& window) {
  std::vector<Tile> tiles;
  window.for_each_square(kTileSize, [&](const PixelRange& pixels) {
    tiles.push_back({pixels, pixels.x0 - pixels.x0 % kTileSize, pixels.y0 - pixels.y0 % kTileSize});
  });
  return tiles;
}

// All blocks of the window, those of a wide grid first, then those of ever finer grids between them. Grids
// begin at the window's first block, so that each of their cells has its corner in the window. samples: of
// each pixel.
std::vector<Tile> tiles_coarse_to_fine(const PixelRange& window, uint64_t samples) {
  constexpr double kFirstSamples = 1 << 16;  // in the widest grid: some tenths of a second
  constexpr int kUsualStride = 16, kWidestStride = 256;
  const double all = double(window.pixels()) * double(samples);
  int stride = kUsualStride;
  while (stride < kWidestStride && all / stride / stride > kFirstSamples) stride *= 2;
  const int x0 = window.x0 - window.x0 % kRayBlock, y0 = window.y0 - window.y0 % kRayBlock;
  std::vector<Tile> tiles;
  for (bool widest = true; stride >= 1; stride /= 2, widest = false) {
    const int side = kTileSize * stride;
    for (int y = y0; y < window.y1; y += side)
      for (int x = x0; x < window.x1; x += side)
        tiles.push_back({window.in_square(x, y, side), x, y, stride, widest});
  }
  return tiles;
}

// The largest total, in units of the first samples' work, that AdaptiveWork may reach after a short round:
// below kFirstRound, since a greater total, given as a number, begins with a long round.
constexpr double kMostAfterShort = double(0.74f);

// Renders one pass's samples of all pixels in the film's window.
class TilePass {
 public:
  TilePass(const RenderContext& ctx, const ProgressCallback& progress, const PixelsCallback& on_pixels,
           PassFilm* film)
      : ctx_(ctx), progress_(progress), on_pixels_(on_pixels), film_(*film) {
    const FilmSums& sums = film->sums;
    const PixelRange window{sums.x0(), sums.x0() + sums.width(), sums.y0(), sums.y0() + sums.height()};
    tiles_ = tiles_of(window);
    if (on_pixels) coarse_to_fine_ = tiles_coarse_to_fine(window, samples());
    if (ctx.samples.adaptive_work > 0) counts_.emplace(sums);
    to_do_ = first_tiles().size() + tiles_.size() * rounds_of(ctx.samples.adaptive_work);
  }

  // False when the progress callback cancelled.
  bool render(const AdaptiveWork& adaptive_work) {
    if (!report()) return false;  // where there is one tile, its end is too late to cancel
    const Stopwatch watch;
    if (!each_tile(first_tiles(), &TilePass::first_samples)) return false;
    if (!counts_) return true;
    adaptive_ = true;
    return adaptive_rounds(watch.seconds(), adaptive_work);
  }

  void fill(RenderStatistics* statistics) const {
    merged_.fill(statistics);
    statistics->adaptive_work = work_;
  }

 private:
  uint64_t samples() const { return ctx_.samples.end - ctx_.samples.first; }  // first samples of each pixel
  const std::vector<Tile>& first_tiles() const { return on_pixels_ ? coarse_to_fine_ : tiles_; }

  bool first_samples(const PixelRange& block, photon::EstimateBatch* batch, TileWork* work) {
    const SampleRange range{BlockPart::kWhole, ctx_.samples.first, ctx_.samples.end};
    BlockMoments moments;
    const BlockSums sums{&film_, counts_ ? &moments : nullptr, &work->result};
    if (!render_block(ctx_, block, range, batch, sums, work->go_on)) return false;
    for (int half = 0; counts_ && half < kHalves; ++half)
      counts_->spread(block.x0, block.y0, half) = spread_of(moments, half);
    return true;
  }

  bool adaptive_samples(const PixelRange& block, photon::EstimateBatch* batch, TileWork* work) {
    const uint64_t first = ctx_.samples.first;
    for (int half = 0; half < kHalves; ++half) {
      const SampleRange range{half == 0 ? BlockPart::kEven : BlockPart::kOdd,
                              first + counts_->count_before(block.x0, block.y0, half),
                              first + counts_->count(block.x0, block.y0, half),
                              counts_->light(block.x0, block.y0, half)};
      if (!render_block(ctx_, block, range, batch, {&film_, nullptr, &work->result}, work->go_on))
        return false;
    }
    return true;
  }

  // Renders adaptive samples in rounds. seconds: what the first samples took.
  bool adaptive_rounds(double seconds, const AdaptiveWork& adaptive_work) {
    for (double end = 0;;) {
      double all = adaptive_work ? adaptive_work(work_, seconds) : ctx_.samples.adaptive_work;
      end = end > 0 ? next_round(end) : first_round(all);
      if (adaptive_work && work_ > 0 && work_ < kFirstRound) all = std::min(all, kMostAfterShort);
      if (!(std::min(end, all) > work_)) return true;
      work_ = std::min(end, all);
      counts_->choose_counts(samples(), work_);
      const std::vector<Tile> tiles = tiles_by_work();
      to_do_ = std::max(to_do_, done_ + tiles_.size());
      const Stopwatch watch;
      if (!each_tile(tiles, &TilePass::adaptive_samples)) return false;
      if (work_ < end) return true;  // a further round would not begin where it should
      seconds = watch.seconds();
    }
  }

  uint64_t adaptive_samples_of(const Tile& tile) const {
    uint64_t sum = 0;
    tile.for_each_block([&](const PixelRange& block) {
      for (int half = 0; half < kHalves; ++half) sum += counts_->count(block.x0, block.y0, half);
    });
    return sum;
  }

  // The tiles in the order of their adaptive samples, most first, and block by block where there are many, so
  // that no thread is left with a long one at the end.
  std::vector<Tile> tiles_by_work() const {
    constexpr uint64_t kMany = 2;  // times the mean
    std::vector<std::pair<uint64_t, Tile>> found;
    uint64_t all = 0;
    for (const Tile& tile : tiles_) {
      found.emplace_back(adaptive_samples_of(tile), tile);
      all += found.back().first;
    }
    for (size_t i = 0; i < tiles_.size(); ++i) {
      if (found[i].first * tiles_.size() <= kMany * all) continue;
      // Its blocks take its place, and an empty tile is counted for them.
      const Tile& tile = tiles_[i];
      found[i] = {0, {{tile.x, tile.x, tile.y, tile.y}, tile.x, tile.y}};
      tile.for_each_block([&](const PixelRange& block) {
        Tile part{block, tile.x, tile.y};
        part.counted = false;
        found.emplace_back(adaptive_samples_of(part), part);
      });
    }
    std::ranges::stable_sort(found, [](const auto& a, const auto& b) { return a.first > b.first; });
    std::vector<Tile> tiles;
    for (const auto& [samples, tile] : found) tiles.push_back(tile);
    return tiles;
  }

  using BlockRenderer = bool (TilePass::*)(const PixelRange&, photon::EstimateBatch*, TileWork*);

  // Tells how many tiles are done. False when the progress callback cancels.
  bool report() {
    if (progress_ && !progress_({"render", done_, to_do_, ctx_.pass.pass, ctx_.pass.shares}))
      cancelled_ = true;
    return !cancelled_;
  }

  // Whether a tile that is being rendered shall go on. The callback takes a lock, so it is asked from time to
  // time only.
  bool goes_on(Stopwatch* since_asked) {
    if (since_asked->seconds() < kSecondsBetweenReports) return true;
    *since_asked = {};
    const std::lock_guard lock(mutex_);
    return !cancelled_ && report();
  }

  // Nothing when cancelled; the film is then as it was before the tile.
  std::optional<TileResult> render_tile(const Tile& tile, BlockRenderer add_samples) {
    const TileCopy before(film_, tile, adaptive_);
    Stopwatch since_asked;
    TileWork work{{}, [&] { return goes_on(&since_asked); }};
    photon::EstimateBatch batch;
    bool whole = true;
    tile.for_each_block([&](const PixelRange& block) {
      if (!whole) return;
      batch.begin_block();
      whole = (this->*add_samples)(block, &batch, &work);
      if (whole && on_pixels_) on_pixels_(block, kRayBlock * tile.stride, film_.sums);
    });
    if (whole) return std::move(work.result);
    before.restore(&film_);
    return std::nullopt;
  }

  // Renders tiles in parallel. False when the progress callback cancelled.
  bool each_tile(const std::vector<Tile>& tiles, BlockRenderer add_samples) {
    std::atomic<size_t> next{0};
    size_t finished = 0;
    parallel::for_index(
        size_t(0), tiles.size(),
        [&](size_t) {
          if (cancelled_) return;
          const Tile& tile = tiles[next++];
          const std::optional<TileResult> result = render_tile(tile, add_samples);
          if (!result) return;
          const std::lock_guard lock(mutex_);
          merged_.add(*result);
          ++finished;
          done_ += tile.counted;
          report();
        },
        parallel::Division::kEach);
    return finished == tiles.size() && (done_ == to_do_ || !cancelled_);
  }

  const RenderContext& ctx_;
  const ProgressCallback& progress_;
  const PixelsCallback& on_pixels_;
  PassFilm& film_;
  std::vector<Tile> tiles_, coarse_to_fine_;
  std::optional<SampleCounts> counts_;  // set if adaptive samples follow
  MergedTiles merged_;
  std::mutex mutex_;  // guards merged_, the callback, and done_ while tiles are rendered
  uint64_t done_ = 0, to_do_ = 0;
  bool adaptive_ = false;  // adaptive samples are being added
  double work_ = 0;        // that adaptive samples were allowed so far
  std::atomic<bool> cancelled_{false};
};

}  // namespace

bool render_tiles(const RenderContext& ctx, const ProgressCallback& progress, PassFilm* film,
                  RenderStatistics* statistics, const AdaptiveWork& adaptive_work,
                  const PixelsCallback& on_pixels) {
  TilePass pass(ctx, progress, on_pixels, film);
  const bool finished = pass.render(adaptive_work);
  pass.fill(statistics);
  return finished;
}

}  // namespace kaustik::render
