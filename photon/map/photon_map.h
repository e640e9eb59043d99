#pragma once
// Photons of one kind in Morton order, with the octree and the boxes that find those near a point. Searches
// are in photon/gather.

#include <cstdint>
#include <optional>

#include "photon/map/box_tree.h"
#include "photon/map/morton_sort.h"
#include "photon/map/octree.h"
#include "photon/record/photon_record.h"

namespace kaustik::photon {

struct MapSettings {
  // Maps with the same bounds share one cube, so that a cell is a range of keys in each of them. Unset: the
  // photons' own bounds. Photons outside are kept in the nearest cells.
  std::optional<Bounds3> bounds;
};

// A cache line of a column: one block of photons.
struct alignas(64) ColumnLine {
  uint32_t words[BoxTree::kBlockPhotons];
};

// All that a map consists of, for files.
struct PhotonMapParts {
  uint64_t size = 0;
  float flux_unit = 1;
  FluxColours colours = FluxColours::kRgb;
  MortonCube cube{};
  SharedArray<ColumnLine> columns{};  // x, y, z, direction, surface, power, consecutively
  SharedArray<OctreeNode> nodes{};
  SharedArray<uint32_t> entries{};
  SharedArray<BoxNode> boxes{};
  SharedArray<BoxTree::Surfaces> surfaces{};
};

// Immutable after construction; const members may be called from any thread. Structure of arrays, 24 bytes
// per photon plus at most a tenth of that for octree and boxes.
class PhotonMap {
 public:
  PhotonMap() = default;

  // Builds the map; takes the buffer's memory and frees it. The result does not depend on the number of
  // threads. Peak memory: 51 bytes per photon including the buffer, plus a few megabytes per thread. At most
  // 2^32 - 1 photons (std::length_error beyond).
  static PhotonMap build(PhotonBuffer&& buffer, const MapSettings& settings = {});

  // The map that has these parts; they may lie in a mapped file. Throws std::invalid_argument for parts of no
  // map, with which a search would leave the arrays.
  explicit PhotonMap(PhotonMapParts parts);
  PhotonMapParts parts() const;

  uint64_t size() const { return size_; }
  bool empty() const { return size_ == 0; }
  float flux_unit() const { return flux_unit_; }
  FluxColours colours() const { return colours_; }
  const MortonCube& cube() const { return octree_.cube(); }
  const Octree& octree() const { return octree_; }
  const BoxTree& boxes() const { return boxes_; }
  uint64_t memory_bytes() const;

  // Decodes photon i of the Morton order.
  Photon photon(uint64_t i) const;

  // The lecture's cell of p, see Octree::find_cell().
  OctreeCell find_cell(const Point3& p, uint32_t node_photons, float radius) const {
    return octree_.find_cell(positions(), p, node_photons, radius);
  }

  const PhotonColumns& columns() const { return columns_; }
  PhotonPositions positions() const { return {columns_.x, columns_.y, columns_.z}; }

 private:
  static constexpr uint64_t kColumns = 6;
  // Number of lines of one column.
  static uint64_t lines_of(uint64_t size) { return (size + kColumnPadding) / BoxTree::kBlockPhotons + 1; }
  // Allocates the columns and returns where to write them.
  RecordColumns allocate(uint64_t size);
  // Sets columns_ to those of storage_.
  void find_columns();

  Octree octree_;
  BoxTree boxes_;
  SharedArray<ColumnLine> storage_;  // all columns, consecutively
  PhotonColumns columns_;
  uint64_t size_ = 0;
  float flux_unit_ = 1;
  FluxColours colours_ = FluxColours::kRgb;
};

inline Photon PhotonMap::photon(uint64_t i) const {
  const PhotonColumns& c = columns_;
  return unpack({c.x[i], c.y[i], c.z[i], c.direction[i], c.power[i], c.surface[i]}, flux_unit_, colours_);
}

}  // namespace kaustik::photon
