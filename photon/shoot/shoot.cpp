// The parallel shoot as a pipeline: blocks are handed out, traced, given their place in order, and copied
// there.

#include "photon/shoot/shoot.h"

#include <tbb/concurrent_queue.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <atomic>
#include <mutex>
#include <shared_mutex>

#include "core/memory/memory_pages.h"
#include "core/parallel/parallel.h"
#include "photon/trace/record_sink.h"

namespace kaustik::photon {

namespace {

FluxColours colours_of(const Scene& scene) {
  return scene.needs.dispersion ? FluxColours::kXyz : FluxColours::kRgb;
}

struct Block {
  uint64_t first = 0, end = 0;  // photon indices
  RecordsByKind records;
  TraceCounters counters;
  std::array<size_t, kPhotonKinds> place{};  // where its records go in the result, by kind
  bool placed = false;
};

void trace_block(const Scene& scene, const SurfaceTable& surfaces, const accel::Bvh& bvh,
                 const TraceSettings& settings, float flux_unit, Block& block) {
  for (auto& records : block.records) records.clear();
  TraceCounters counters;
  RecordSink sink(flux_unit, block.records, colours_of(scene));
  trace_photons(scene, surfaces, bvh, settings, block.first, block.end, sink, counters);
  sink.flush();
  block.counters = counters;
  block.placed = false;
}

// Hands out blocks of photon indices in order, and reuses their buffers.
class BlockSource {
 public:
  explicit BlockSource(uint64_t photons) : photons_(photons), blocks_(blocks_in_flight()) {
    for (Block& block : blocks_) free_.push(&block);
  }

  // Number of blocks that may be in flight.
  size_t most() const { return blocks_.size(); }
  // Next block; null when all photons are handed out. Calls must not overlap.
  Block* next() {
    Block* block = nullptr;
    if (first_ >= photons_ || !free_.try_pop(block)) return nullptr;
    block->first = first_;
    block->end = first_ = std::min(photons_, first_ + kShootBlock);
    return block;
  }
  void give_back(Block* block) { free_.push(block); }
  // Frees the blocks. The C library would keep their memory beside the maps: a hundred megabytes with a
  // hundred threads.
  void free() {
    constexpr uint64_t kMany = 1u << 20;
    blocks_.clear();
    if (photons_ >= kMany) give_back_freed();
  }

 private:
  // One for each thread, and some that wait for their place. Each takes some 100 kB.
  static size_t blocks_in_flight() {
    constexpr size_t kMostWaiting = 64;
    const auto threads = size_t(std::max(1, tbb::this_task_arena::max_concurrency()));
    return threads + std::min(3 * threads, kMostWaiting);
  }

  uint64_t photons_, first_ = 0;
  std::vector<Block> blocks_;
  tbb::concurrent_queue<Block*> free_;
};

// Joins the blocks: place() assigns positions in block order, then any thread copies a block there.
class Join {
 public:
  Join(ShootResult& result, uint64_t photons) : result_(result), photons_(photons) {}

  // Must be called for one block at a time, in order.
  void place(Block& block) {
    for (size_t k = 0; k < kPhotonKinds; ++k) {
      PhotonRecords& all = result_.buffers[k].records;
      block.place[k] = all.size();
      make_room(all, all.size() + block.records[k].size(), double(block.end) / double(photons_));
      all.resize(all.size() + block.records[k].size());
    }
    result_.counters += block.counters;
    block.placed = true;
  }

  // May be called by any thread, at any time after place().
  void copy(const Block& block) {
    const std::shared_lock lock(moving_);
    for (size_t k = 0; k < kPhotonKinds; ++k)
      std::ranges::copy(block.records[k], result_.buffers[k].records.data() + block.place[k]);
  }

 private:
  // Reserves room for all photons still to come, as extrapolated from those so far, so that the array hardly
  // ever moves: a move would hold it twice. Memory that is reserved and never written costs nothing.
  void make_room(PhotonRecords& all, size_t size, double done_share) {
    if (size <= all.capacity()) return;
    const std::unique_lock lock(moving_);
    const double expected = double(size) / done_share;
    all.reserve(std::max(size, size_t(1.03 * expected + 5 * std::sqrt(expected))));
    prefer_large_pages(all.data(), all.capacity() * sizeof(PhotonRecord));
  }

  ShootResult& result_;
  uint64_t photons_;
  std::shared_mutex moving_;  // exclusive while arrays move
};

}  // namespace

float flux_unit_of(const Scene& scene, uint64_t photons) {
  Rgb total(0);
  for (const Light& light : scene.lights) total += power(light);
  const double mean =
      static_cast<double>(max_component(total)) / static_cast<double>(std::max<uint64_t>(1, photons));
  if (!(mean > 0) || !std::isfinite(mean)) return 1;
  // The limits leave room for the shared exponents within the range of float.
  return std::ldexp(1.0f, std::clamp(std::ilogb(mean), -100, 100));
}

ShootResult shoot(const Scene& scene, const accel::Bvh& bvh, const TraceSettings& settings,
                  const ShootProgress& progress) {
  ShootResult result;
  const float flux_unit = std::ldexp(flux_unit_of(scene, settings.photons),
                                     settings.guide ? settings.guide->middle_exponent() : 0);
  for (PhotonBuffer& buffer : result.buffers)
    buffer.flux_unit = flux_unit, buffer.colours = colours_of(scene);
  if (!settings.kinds.any()) return result;

  const SurfaceTable surfaces(scene);
  BlockSource source(settings.photons);
  std::atomic<bool> cancelled{false};
  const auto start = [&]() -> Block* { return cancelled ? nullptr : source.next(); };
  const auto trace = [&](Block* block) { trace_block(scene, surfaces, bvh, settings, flux_unit, *block); };
  Join join(result, settings.photons);
  const auto place = [&](Block* block) {
    if (cancelled) return;
    join.place(*block);
    if (progress && !progress(block->end, settings.photons)) cancelled = true;
  };
  const auto copy = [&](Block* block) {
    if (block->placed) join.copy(*block);
    source.give_back(block);
  };
  parallel::pipeline<Block>(source.most(), start, trace, place, copy);
  source.free();
  return result;
}

}  // namespace kaustik::photon
