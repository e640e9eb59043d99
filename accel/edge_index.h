#pragma once
// Finds the boundary edges near a point: a walk over the edges of a surface group with few of them (walls,
// tables), Embree's point query over the boxes of all for the others.

#include <memory>
#include <span>
#include <vector>

#include "core/geometry/boundary_edges.h"

namespace kaustik::accel {

class Bvh;

// Immutable after construction; const members may be called from any thread.
class EdgeIndex {
 public:
  // Sorts the edges by surface group and keeps their order within one.
  explicit EdgeIndex(std::vector<BoundaryEdge> edges);
  ~EdgeIndex();
  EdgeIndex(EdgeIndex&&) noexcept;
  EdgeIndex& operator=(EdgeIndex&&) noexcept;

  // Edges of the surface group with a point within radius (metres, closed) of p. Writes their indices in
  // ascending order and returns how many there are; out.size() + 1 when there are more than fit, and then out
  // holds nothing of use. The result does not depend on the tree, and scales with the scene by powers of two.
  size_t find(const Point3& p, float radius, uint32_t surface_group, std::span<uint32_t> out) const;

  const BoundaryEdge& operator[](uint32_t i) const { return edges_[i]; }
  size_t size() const { return edges_.size(); }
  uint64_t memory_bytes() const;

 private:
  struct Impl;
  std::vector<BoundaryEdge> edges_;
  std::vector<uint32_t> group_begin_;  // into edges_, by surface group; one more entry than groups with edges
  std::unique_ptr<Impl> impl_;         // null without edges
};

// The edges but those behind which the same surface group goes on although no triangle shares them: at
// T-junctions and between unwelded facets. Looks from three points of the edge, moved outward by 1/1000 of
// the facet (more where coordinates round more coarsely), for a facet within 60 degrees and twice that
// distance; two finds of three drop the whole edge. Only edges with nothing behind them are looked at. Keeps
// the order.
std::vector<BoundaryEdge> without_continued(std::vector<BoundaryEdge> edges, const Bvh& bvh);

}  // namespace kaustik::accel
