#pragma once
// Octree over photons sorted by Morton key. A node is a range of keys, so photons need not be rearranged.
// Only nodes of many photons are stored, 16 bytes each, and a table of where the cells of one depth begin:
// searches enter there and continue with the boxes of photon/map/box_tree.h.

#include <bit>
#include <cstdint>
#include <span>
#include <vector>

#include "core/memory/shared_array.h"
#include "photon/map/morton.h"
#include "photon/record/photon_columns.h"

namespace kaustik::photon {

// The children of a node are stored consecutively, in octant order.
struct OctreeNode {
  uint32_t begin, end;   // range of photons
  uint32_t first_child;  // index of the first child
  // Bit o: octant o is not empty; bits from 8 + 3 o: number of non-empty octants before it.
  uint32_t children;

  bool leaf() const { return children == 0; }
  PhotonRange range() const { return {begin, end}; }
  bool has_child(uint32_t octant) const { return children >> octant & 1; }
  uint32_t child_offset(uint32_t octant) const { return children >> (8 + 3 * octant) & 7; }
  uint32_t child(uint32_t octant) const { return first_child + child_offset(octant); }
};
static_assert(sizeof(OctreeNode) == 16);

// A cell of any depth, whether or not its node is stored.
struct OctreeCell {
  PhotonRange range;
  MortonCell corner{};  // lowest coordinates at level kMortonBits
  int depth = 0;
  int climbed = 0;  // levels between the leaf and this cell
  Bounds3 bounds;   // metres
};

// Up to eight ranges of photons, each with its first and last index.
struct CellRanges {
  uint32_t first[8], last[8];
  size_t size = 0;
};

// Positions of the sorted photons, from which keys are recomputed for cells below a stored leaf.
struct PhotonPositions {
  const float *x = nullptr, *y = nullptr, *z = nullptr;
  Point3 operator[](uint64_t i) const { return {x[i], y[i], z[i]}; }
};

class Octree {
 public:
  // Most photons of a stored leaf, unless they all lie in one cell of the deepest level.
  static constexpr uint64_t kLeafPhotons = 256;

  Octree() = default;
  // positions: of `size` photons in ascending order of keys, fewer than 2^32. The result does not depend on
  // the number of threads.
  Octree(const MortonCube& cube, const PhotonPositions& positions, uint64_t size);
  // The octree over `size` photons that has these nodes() and entries(). Throws std::invalid_argument where a
  // search would leave the arrays.
  Octree(const MortonCube& cube, uint64_t size, SharedArray<OctreeNode> nodes, SharedArray<uint32_t> entries);

  const MortonCube& cube() const { return cube_; }
  uint64_t size() const { return size_; }  // photons
  const SharedArray<OctreeNode>& nodes() const { return nodes_; }
  // Index of the first photon of each cell at one depth, followed by the number of photons. At most a quarter
  // of a byte per photon.
  const SharedArray<uint32_t>& entries() const { return entries_; }
  uint64_t memory_bytes() const { return nodes_.bytes() + entries_.bytes(); }

  // Ranges, in ascending order, that contain every photon of `within` that is within radius of p, and others:
  // the photons of all cells that the sphere meets, where cells are as wide as the sphere or wider.
  CellRanges ranges_near(const Point3& p, float radius, PhotonRange within) const;

  // Estimates the radius, in metres, of a disc that holds somewhat more than `photons` photons, by assuming
  // that those of the smallest node around p with at least twice as many are spread evenly over one plane
  // through it.
  float guess_radius(const Point3& p, uint64_t photons) const;

  // Finds the photons of the cells that contain the key: ranges[d] is that of depth d. Stops after the first
  // depth at which stop(depth, range) is true, or at the deepest level; returns that depth.
  template <class Stop>
  int descend(const PhotonPositions& positions, uint64_t key, PhotonRange (&ranges)[kMortonBits + 1],
              Stop&& stop) const;

  // The lecture's leaf lookup (TNCG15): starting at the root, a cell is split while it holds more than
  // node_photons (N0) and its children can still hold a sphere of `radius` (r0); then ancestors are taken
  // while p is nearer than r0 to a face of the cell. Faces of the root do not count, since there is nothing
  // beyond them.
  OctreeCell find_cell(const PhotonPositions& positions, const Point3& p, uint32_t node_photons,
                       float radius) const;

  // The rules of find_cell(), shared with the shadow classifier. This one: whether cells at depth + 1 can
  // hold the sphere.
  bool children_hold(float radius, int depth) const;
  // Whether p is at least `radius` away from every face of its cell at this depth that is inside the root.
  bool keeps_from_faces(const Point3& p, float radius, int depth) const;
  OctreeCell make_cell(const Point3& p, PhotonRange range, int depth, int climbed) const;

 private:
  PhotonRange child_range(const PhotonPositions& positions, PhotonRange range, uint64_t key, int depth) const;

  // Depth of the cells that entries() lists for `size` photons, and how many entries that are.
  static int entry_depth(uint64_t size);
  static size_t entries_of(int depth) { return (size_t(1) << (3 * depth)) + 1; }
  void make_entries(const PhotonPositions& positions);
  void check() const;

  MortonCube cube_;
  SharedArray<OctreeNode> nodes_;
  SharedArray<uint32_t> entries_;
  int entry_depth_ = 0;  // of the cells of entries_
  uint64_t size_ = 0;
};

}  // namespace kaustik::photon

#include "photon/map/octree-inl.h"
