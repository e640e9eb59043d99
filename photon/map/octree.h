#pragma once
// Octree over photons sorted by Morton key. Implicit: a node is a range of keys, and the photons are not
// touched. Stored are the nodes of many photons, 16 bytes each, and where the cells of one depth begin:
// searches enter there, and go on with the boxes of photon/map/box_tree.h.

#include <bit>
#include <cstdint>
#include <span>
#include <vector>

#include "core/memory/uninitialised_array.h"
#include "photon/map/morton.h"
#include "photon/record/photon_columns.h"

namespace kaustik::photon {

// The children of a node lie next to each other, in octant order.
struct OctreeNode {
  uint32_t begin, end;   // photons
  uint32_t first_child;  // index of the node
  uint32_t children;     // bit o: octant o is not empty; bits 8 + 3 o up: how many come before it

  bool leaf() const { return children == 0; }
  PhotonRange range() const { return {begin, end}; }
  bool has_child(uint32_t octant) const { return children >> octant & 1; }
  uint32_t child_offset(uint32_t octant) const { return children >> (8 + 3 * octant) & 7; }
  uint32_t child(uint32_t octant) const { return first_child + child_offset(octant); }
};
static_assert(sizeof(OctreeNode) == 16);

// A cell of any depth, whether or not a node of its own is stored.
struct OctreeCell {
  PhotonRange range;
  MortonCell corner{};  // lowest coordinates at level kMortonBits
  int depth = 0;
  int climbed = 0;  // levels climbed from the leaf
  Bounds3 bounds;   // metres
};

// Runs of photons, from the first to the last.
struct CellRanges {
  uint32_t first[8], last[8];
  size_t size = 0;
};

// The sorted photons' columns, from which keys are computed again where a cell lies below a stored leaf.
struct PhotonPositions {
  const float *x = nullptr, *y = nullptr, *z = nullptr;
  Point3 operator[](uint64_t i) const { return {x[i], y[i], z[i]}; }
};

class Octree {
 public:
  // Stored leaves hold at most so many photons, unless they lie in one cell of the deepest level.
  static constexpr uint64_t kLeafPhotons = 256;

  Octree() = default;
  // positions: of `size` photons by ascending key, fewer than 2^32. The result does not depend on the number
  // of threads.
  Octree(const MortonCube& cube, const PhotonPositions& positions, uint64_t size);

  const MortonCube& cube() const { return cube_; }
  uint64_t size() const { return size_; }  // photons
  std::span<const OctreeNode> nodes() const { return {nodes_.data(), nodes_.size()}; }
  uint64_t memory_bytes() const {
    return nodes_.size() * sizeof(OctreeNode) + entries_.size() * sizeof(uint32_t);
  }

  // Every photon of `within` that is within radius of p, and others, ascending: those of the cells that the
  // sphere meets, as wide as it or wider.
  CellRanges ranges_near(const Point3& p, float radius, PhotonRange within) const;

  // Radius in metres of a disc that holds so many photons, and some more, if those of the smallest node
  // around p with twice as many are spread evenly over one cut through it: a guess.
  float guess_radius(const Point3& p, uint64_t photons) const;

  // Photons of the ancestor cells of key: ranges[d] is that of depth d. Stops after the first depth at which
  // stop(depth, range) is true, or at the deepest level; returns that depth.
  template <class Stop>
  int descend(const PhotonPositions& positions, uint64_t key, PhotonRange (&ranges)[kMortonBits + 1],
              Stop&& stop) const;

  // The lecture's leaf lookup (TNCG15): from the root, a cell splits while it holds more than node_photons
  // (N0) and its children can still hold a sphere of `radius` (r0); then the parent is taken while p is
  // nearer than r0 to a face. Faces of the root do not count: there is nothing beyond them.
  OctreeCell find_cell(const PhotonPositions& positions, const Point3& p, uint32_t node_photons,
                       float radius) const;

  // The rules of find_cell, shared with the shadow classifier. Children at depth + 1 can hold the sphere.
  bool children_hold(float radius, int depth) const;
  // p, of the cell of depth, is at least radius away from every face of that cell that is inside the root.
  bool keeps_from_faces(const Point3& p, float radius, int depth) const;
  OctreeCell make_cell(const Point3& p, PhotonRange range, int depth, int climbed) const;

 private:
  PhotonRange child_range(const PhotonPositions& positions, PhotonRange range, uint64_t key, int depth) const;

  void make_entries(const PhotonPositions& positions);

  MortonCube cube_;
  UninitialisedArray<OctreeNode> nodes_;
  // Where the photons of each cell of entry_depth_ begin, and the end: at most a quarter of a byte per
  // photon.
  UninitialisedArray<uint32_t> entries_;
  int entry_depth_ = 0;
  uint64_t size_ = 0;
};

}  // namespace kaustik::photon

#include "photon/map/octree-inl.h"
