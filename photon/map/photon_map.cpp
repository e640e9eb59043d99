// Builds the columns of a map, its octree and its boxes.

#include "photon/map/photon_map.h"

#include <tbb/blocked_range.h>

#include <algorithm>
#include <span>
#include <stdexcept>
#include <utility>

#include "core/memory/memory_pages.h"
#include "core/parallel/parallel.h"

namespace kaustik::photon {

namespace {

using IndexBlock = tbb::blocked_range<size_t>;
constexpr size_t kGrain = 1 << 14;

// The result is deterministic, since minima and maxima do not depend on the order in which they are combined.
Bounds3 bounds_of(std::span<const PhotonRecord> records) {
  return parallel::reduce(
      IndexBlock(0, records.size(), kGrain), Bounds3{},
      [&](const IndexBlock& block, Bounds3 bounds) {
        for (size_t i = block.begin(); i < block.end(); ++i) {
          bounds.add(Point3(records[i].x, records[i].y, records[i].z));
        }
        return bounds;
      },
      [](Bounds3 a, const Bounds3& b) {
        a.add(b);
        return a;
      });
}

void check_size(uint64_t size) {
  if (size > std::numeric_limits<uint32_t>::max()) {
    throw std::length_error("a photon map holds at most 2^32 - 1 photons: shoot fewer per pass");
  }
}

}  // namespace

RecordColumns PhotonMap::allocate(uint64_t size) {
  const uint64_t lines = lines_of(size);
  size_ = size;
  UninitialisedArray<ColumnLine> storage(lines * kColumns);
  prefer_large_pages(storage.data(), storage.size() * sizeof(ColumnLine));
  const auto words = [&](uint64_t c) { return storage[c * lines].words; };
  const auto floats = [&](uint64_t c) { return reinterpret_cast<float*>(words(c)); };
  // In parallel, as each touches the first large page of a column.
  parallel::for_index(
      uint64_t{0}, kColumns,
      [&](uint64_t c) {
        std::fill(words(c) + size, words(c) + lines * BoxTree::kBlockPhotons, c == 0 ? ~0u : 0u);
      },
      parallel::Division::kEach);
  const RecordColumns to{floats(0), floats(1), floats(2), words(3), words(5), words(4)};
  storage_ = SharedArray(std::move(storage));
  find_columns();
  return to;
}

void PhotonMap::find_columns() {
  const auto words = [&](uint64_t c) { return storage_[c * lines_of(size_)].words; };
  const auto floats = [&](uint64_t c) { return reinterpret_cast<const float*>(words(c)); };
  columns_ = {floats(0), floats(1), floats(2), words(3), words(4), words(5)};
}

PhotonMap::PhotonMap(PhotonMapParts parts)
    : octree_(parts.cube, parts.size, std::move(parts.nodes), std::move(parts.entries)),
      boxes_(parts.size, std::move(parts.boxes), std::move(parts.surfaces)),
      storage_(std::move(parts.columns)),
      size_(parts.size),
      flux_unit_(parts.flux_unit),
      colours_(parts.colours) {
  if (storage_.size() != kColumns * lines_of(size_))
    throw std::invalid_argument("these are not the columns of so many photons");
  find_columns();
}

PhotonMapParts PhotonMap::parts() const {
  return {size_,           flux_unit_,        colours_,       octree_.cube(),   storage_,
          octree_.nodes(), octree_.entries(), boxes_.nodes(), boxes_.surfaces()};
}

PhotonMap PhotonMap::build(PhotonBuffer&& buffer, const MapSettings& settings) {
  check_size(buffer.records.size());
  PhotonBuffer taken = std::exchange(buffer, {});
  PhotonMap map;
  map.flux_unit_ = taken.flux_unit;
  map.colours_ = taken.colours;
  const MortonCube cube = MortonCube::around(settings.bounds ? *settings.bounds : bounds_of(taken.records));
  sort_into_columns(taken.records, cube, map.allocate(taken.records.size()));
  parallel::invoke([&] { map.octree_ = Octree(cube, map.positions(), map.size_); },
                   [&] { map.boxes_ = BoxTree(map.columns_, map.size_); },
                   [&] { PhotonRecords().swap(taken.records); });
  return map;
}

uint64_t PhotonMap::memory_bytes() const {
  return storage_.bytes() + octree_.memory_bytes() + boxes_.memory_bytes();
}

}  // namespace kaustik::photon
