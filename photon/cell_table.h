#pragma once
// Where the cells of one depth of the octree begin among photons in Morton order: a search enters there
// instead of at the root. Cells of lesser depth are runs of these. At most a quarter of a byte per photon.

#include "photon/octree.h"

namespace kaustik::photon {

// Runs of photons, first to last, ascending and apart from each other.
struct CellRanges {
  uint32_t first[8], last[8];
  size_t size = 0;
};

class CellTable {
 public:
  CellTable() = default;
  // positions: those that the octree was made of.
  CellTable(const Octree& octree, const PhotonPositions& positions);

  // Every photon of `within` that is within radius of p, and others: at most eight cells, of the greatest
  // depth in the table at which so many do.
  CellRanges ranges_near(const Point3& p, float radius, PhotonRange within) const;

  uint64_t memory_bytes() const { return begin_.size() * sizeof(uint32_t); }

 private:
  MortonCube cube_;
  int depth_ = 0;
  UninitialisedArray<uint32_t> begin_;  // by Morton prefix, and the end
};

}  // namespace kaustik::photon
