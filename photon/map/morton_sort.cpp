// Parallel sort of photon records by Morton key: blocks are arranged by buckets, then buckets are sorted.

#include "photon/map/morton_sort.h"

#include <tbb/enumerable_thread_specific.h>

#include <algorithm>
#include <numeric>

#include "core/memory/memory_pages.h"
#include "core/memory/uninitialised_array.h"
#include "core/parallel/parallel.h"
#include "core/sampling/sampler.h"
#include "photon/map/key_buckets.h"
#include "photon/map/key_order.h"
#include "photon/map/morton_lanes.h"

namespace kaustik::photon {

namespace {

// Blocks and buckets are tasks. Their sizes depend on the number of records alone.
constexpr size_t kMostInBlock = size_t(1) << 16, kFewestInBlock = size_t(1) << 12, kWantedBlocks = 256;
// Photons of a bucket on average; with their keys they take most of a megabyte at most.
constexpr size_t kMostInBucket = size_t(1) << 14, kFewestInBucket = size_t(1) << 11, kWantedBuckets = 512;
// Upper bound of the wanted number, to keep the pieces of a block from getting too small.
constexpr size_t kMaxBuckets = 2048;
constexpr size_t kSamplesPerBucket = 16;

// Working memory of one thread; grows as needed.
struct Scratch {
  UninitialisedArray<PhotonRecord> records;
  UninitialisedArray<uint64_t> keys;
  KeyOrder order;

  void reserve(size_t size) {
    if (keys.size() >= size) return;
    records = UninitialisedArray<PhotonRecord>(size);
    keys = UninitialisedArray<uint64_t>(size);
  }
};

// Chooses buckets from a sample of records at hashed positions, so that no order of the records can bias it.
KeyBuckets find_buckets(std::span<const PhotonRecord> records, const MortonCube& cube) {
  const size_t each = std::clamp(records.size() / kWantedBuckets, kFewestInBucket, kMostInBucket);
  const size_t wanted = std::min(records.size() / each, kMaxBuckets);
  if (wanted < 2) return KeyBuckets({}, 1);
  std::vector<uint64_t> keys(wanted * kSamplesPerBucket), sample(keys.size());
  parallel::for_range(tbb::blocked_range<size_t>(0, keys.size(), 256), [&](const auto& range) {
    for (size_t i = range.begin(); i < range.end(); ++i) {
      const PhotonRecord& record = records[mix64(i) % records.size()];
      keys[i] = morton_key(cube.cell({record.x, record.y, record.z}));
    }
  });
  KeyOrder order;
  std::ranges::transform(order.sort(keys), sample.begin(), [&](uint64_t i) { return keys[uint32_t(i)]; });
  return KeyBuckets(sample, wanted);
}

class MortonSort {
 public:
  MortonSort(std::span<PhotonRecord> records, const MortonCube& cube, const RecordColumns& to)
      : records_(records),
        in_block_(std::clamp(records.size() / kWantedBlocks, kFewestInBlock, kMostInBlock)),
        cube_(cube),
        to_(to),
        buckets_(find_buckets(records, cube)) {}

  void arrange_blocks();
  void write_columns();

 private:
  size_t blocks() const { return (records_.size() + in_block_ - 1) / in_block_; }
  std::span<PhotonRecord> block(size_t b) const {
    return records_.subspan(b * in_block_, std::min(in_block_, records_.size() - b * in_block_));
  }
  // Positions in block b at which the buckets begin, followed by the end of the last one.
  std::span<uint32_t> offsets(size_t b) {
    return {offsets_.data() + b * (buckets_.size() + 1), buckets_.size() + 1};
  }
  // Records of buckets [begin, end) in block b.
  std::span<PhotonRecord> piece(size_t b, size_t begin, size_t end) {
    const std::span<const uint32_t> at = offsets(b);
    return block(b).subspan(at[begin], at[end] - at[begin]);
  }

  void arrange_block(size_t b, Scratch& scratch);
  std::vector<uint64_t> find_starts();
  std::span<const PhotonRecord> collect(size_t bucket, Scratch& scratch);
  void write_bucket(size_t bucket, uint64_t start, Scratch& scratch);
  void write_single_key(size_t bucket, uint64_t start);
  void write_buckets(size_t begin, size_t end, std::span<const uint64_t> starts);

  std::span<PhotonRecord> records_;
  size_t in_block_;
  MortonCube cube_;
  RecordColumns to_;
  KeyBuckets buckets_;
  UninitialisedArray<uint32_t> offsets_;
  tbb::enumerable_thread_specific<Scratch> scratch_;
};

void MortonSort::arrange_blocks() {
  offsets_ = UninitialisedArray<uint32_t>(blocks() * (buckets_.size() + 1));
  parallel::for_index(size_t(0), blocks(), [&](size_t b) {
    if (buckets_.size() > 1) return arrange_block(b, scratch_.local());
    offsets(b)[0] = 0;
    offsets(b)[1] = uint32_t(block(b).size());
  });
}

void MortonSort::arrange_block(size_t b, Scratch& scratch) {
  const std::span<PhotonRecord> records = block(b);
  scratch.reserve(records.size());
  const std::span<uint64_t> keys{scratch.keys.data(), records.size()};
  morton_keys(cube_, records.data(), keys);
  // place[bucket + 1] is first a count, then the position at which the bucket begins.
  std::vector<uint32_t> place(buckets_.size() + 1);
  for (uint64_t& key : keys) {
    key = buckets_.of(key);
    ++place[key + 1];
  }
  std::inclusive_scan(place.begin(), place.end(), place.begin());
  std::ranges::copy(place, offsets(b).begin());
  for (size_t i = 0; i < records.size(); ++i) scratch.records[place[keys[i]]++] = records[i];
  std::copy_n(scratch.records.data(), records.size(), records.data());
}

// Positions in the columns at which the buckets begin.
std::vector<uint64_t> MortonSort::find_starts() {
  std::vector<uint64_t> starts(buckets_.size() + 1);
  for (size_t b = 0; b < blocks(); ++b) {
    const std::span<const uint32_t> at = offsets(b);
    for (size_t i = 0; i < starts.size(); ++i) starts[i] += at[i];
  }
  return starts;
}

// Copies the bucket's records from all blocks, in the order of the blocks.
std::span<const PhotonRecord> MortonSort::collect(size_t bucket, Scratch& scratch) {
  // Pieces to prefetch ahead, since they are too short for the hardware prefetcher.
  constexpr size_t kAhead = 4;
  size_t count = 0;
  for (size_t b = 0; b < blocks(); ++b) count += piece(b, bucket, bucket + 1).size();
  scratch.reserve(count);
  PhotonRecord* to = scratch.records.data();
  for (size_t b = 0; b < blocks(); ++b) {
    if (b + kAhead < blocks()) {
      const auto next = std::as_bytes(piece(b + kAhead, bucket, bucket + 1));
      for (size_t i = 0; i < next.size(); i += 64) __builtin_prefetch(&next[i]);
    }
    to = std::ranges::copy(piece(b, bucket, bucket + 1), to).out;
  }
  return {scratch.records.data(), count};
}

void MortonSort::write_bucket(size_t bucket, uint64_t start, Scratch& scratch) {
  const std::span<const PhotonRecord> records = collect(bucket, scratch);
  const std::span<uint64_t> keys{scratch.keys.data(), records.size()};
  morton_keys(cube_, records.data(), keys);
  for (const uint64_t item : scratch.order.sort(keys)) to_.write(start++, records[uint32_t(item)]);
}

// Copies a bucket that covers a single key, which needs no sorting whatever its size.
void MortonSort::write_single_key(size_t bucket, uint64_t start) {
  std::vector<uint64_t> place(blocks() + 1, start);
  for (size_t b = 0; b < blocks(); ++b) place[b + 1] = place[b] + piece(b, bucket, bucket + 1).size();
  parallel::for_index(size_t(0), blocks(), [&](size_t b) {
    uint64_t at = place[b];
    for (const PhotonRecord& record : piece(b, bucket, bucket + 1)) to_.write(at++, record);
  });
}

void MortonSort::write_buckets(size_t begin, size_t end, std::span<const uint64_t> starts) {
  parallel::for_index(begin, end, [&](size_t bucket) {
    if (buckets_.single_key(bucket)) return write_single_key(bucket, starts[bucket]);
    write_bucket(bucket, starts[bucket], scratch_.local());
  });
}

// After the first part is written, the memory of its records is returned to the system. That is more than the
// sort itself needs, so that records, columns and scratch together stay below twice the records' size. One
// thread does it, since several would wait for each other.
void MortonSort::write_columns() {
  constexpr size_t kFirstPart = 8;
  const std::vector<uint64_t> starts = find_starts();
  const auto first = std::ranges::lower_bound(starts, records_.size() / kFirstPart) - starts.begin();
  const size_t middle = std::min(size_t(first), buckets_.size());
  write_buckets(0, middle, starts);
  for (size_t b = 0; b < blocks(); ++b) {
    const auto bytes = std::as_writable_bytes(piece(b, 0, middle));
    give_back_pages(bytes.data(), bytes.size());
  }
  write_buckets(middle, buckets_.size(), starts);
}

}  // namespace

void sort_into_columns(std::span<PhotonRecord> records, const MortonCube& cube, const RecordColumns& to) {
  MortonSort sort(records, cube, to);
  sort.arrange_blocks();
  sort.write_columns();
}

}  // namespace kaustik::photon
