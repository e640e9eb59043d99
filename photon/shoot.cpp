#include "photon/shoot.h"

#include <tbb/parallel_pipeline.h>
#include <tbb/task_arena.h>

#include <atomic>

#include "photon/memory_pages.h"
#include "photon/record_sink.h"

namespace kaustik::photon {

namespace {

struct Block {
  uint64_t first = 0, end = 0;  // photon indices
  RecordsByKind records;
  TraceCounters counters;
};

void trace_block(const Scene& scene, const SurfaceTable& surfaces, const accel::Bvh& bvh,
                 const TraceSettings& settings, float flux_unit, Block& block) {
  for (auto& records : block.records) records.clear();
  TraceCounters counters;
  RecordSink sink(flux_unit, block.records);
  trace_photons(scene, surfaces, bvh, settings, block.first, block.end, sink, counters);
  sink.flush();
  block.counters = counters;
}

// Room for what is still to come, as the photons so far foretell, so that the array is hardly ever moved: a
// move would hold it twice. Memory that is reserved and never written costs nothing.
void append(std::vector<PhotonRecord>& all, const std::vector<PhotonRecord>& more, double done_share) {
  const size_t size = all.size() + more.size();
  if (size > all.capacity()) {
    const double expected = static_cast<double>(size) / done_share;
    all.reserve(std::max(size, static_cast<size_t>(1.03 * expected + 5 * std::sqrt(expected))));
    prefer_large_pages(all.data(), all.capacity() * sizeof(PhotonRecord));
  }
  all.insert(all.end(), more.begin(), more.end());
}

void join(ShootResult& result, const Block& block, uint64_t total) {
  const double done_share = static_cast<double>(block.end) / static_cast<double>(total);
  for (size_t k = 0; k < kPhotonKinds; ++k) {
    append(result.buffers[k].records, block.records[k], done_share);
  }
  result.counters += block.counters;
}

}  // namespace

float flux_unit_of(const Scene& scene, uint64_t photons) {
  Rgb total(0);
  for (const Light& light : scene.lights) total += power(light);
  const double mean =
      static_cast<double>(max_component(total)) / static_cast<double>(std::max<uint64_t>(1, photons));
  if (!(mean > 0) || !std::isfinite(mean)) return 1;
  // The ends leave room for the shared exponents within float's range.
  return std::ldexp(1.0f, std::clamp(std::ilogb(mean), -100, 100));
}

ShootResult shoot(const Scene& scene, const accel::Bvh& bvh, const TraceSettings& settings,
                  const ShootProgress& progress) {
  ShootResult result;
  const float flux_unit = flux_unit_of(scene, settings.photons);
  for (PhotonBuffer& buffer : result.buffers) buffer.flux_unit = flux_unit;
  if (!settings.kinds.any()) return result;

  const SurfaceTable surfaces(scene);
  // At most slots.size() blocks are under way and they retire in order, so block b may use slot b modulo
  // that.
  std::vector<Block> slots(4 * static_cast<size_t>(std::max(1, tbb::this_task_arena::max_concurrency())));
  uint64_t next = 0;
  std::atomic<bool> cancelled{false};
  const auto start = [&](tbb::flow_control& control) -> Block* {
    if (next >= settings.photons || cancelled) {
      control.stop();
      return nullptr;
    }
    Block& block = slots[(next / kShootBlock) % slots.size()];
    block.first = next;
    block.end = next = std::min(settings.photons, next + kShootBlock);
    return &block;
  };
  const auto trace = [&](Block* block) {
    trace_block(scene, surfaces, bvh, settings, flux_unit, *block);
    return block;
  };
  const auto finish = [&](const Block* block) {
    if (cancelled) return;
    join(result, *block, settings.photons);
    if (progress && !progress(block->end, settings.photons)) cancelled = true;
  };
  using tbb::filter_mode;
  tbb::parallel_pipeline(slots.size(),
                         tbb::make_filter<void, Block*>(filter_mode::serial_in_order, start) &
                             tbb::make_filter<Block*, Block*>(filter_mode::parallel, trace) &
                             tbb::make_filter<Block*, void>(filter_mode::serial_in_order, finish));
  return result;
}

}  // namespace kaustik::photon
