#pragma once
// Finds the boundary edges near a point: by a linear walk in surface groups that have few edges (walls,
// tables), and by a tree of boxes in each of the others.

#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "core/geometry/boundary_edges.h"

namespace kaustik::accel {

class Bvh;

// Immutable after construction; const members may be called from any thread.
class EdgeIndex {
 public:
  // Sorts the edges by surface group, and by place within a group of many; those of others keep their order.
  explicit EdgeIndex(std::vector<BoundaryEdge> edges);
  ~EdgeIndex();
  EdgeIndex(EdgeIndex&&) noexcept;
  EdgeIndex& operator=(EdgeIndex&&) noexcept;

  // Finds the edges of the surface group that have a point within radius (metres, closed) of p. Writes their
  // indices in ascending order and returns their number, or out.size() + 1 when they do not all fit; the
  // contents of out are then unspecified. Which edges are found depends on distances alone, and scales with
  // the scene by powers of two.
  size_t find(const Point3& p, float radius, uint32_t surface_group, std::span<uint32_t> out) const;

  const BoundaryEdge& operator[](uint32_t i) const { return edges_[i]; }
  size_t size() const { return edges_.size(); }
  uint64_t memory_bytes() const;

 private:
  struct Tree;
  std::vector<BoundaryEdge> edges_;
  // The first edge of each surface group in edges_, and the end of the last one.
  std::vector<uint32_t> group_begin_;
  std::vector<std::unique_ptr<const Tree>> trees_;  // by surface group; null for groups with few edges
};

// Returns the edges that are true ends, in their order: drops those behind which the same surface group
// continues although no triangle shares them, as at T-junctions and between unwelded facets. From three
// points of each edge, moved outward by 1/1000 of the facet (more where coordinates round more coarsely), it
// looks for a facet within 60 degrees of the edge's normal and twice that distance away; two finds out of
// three drop the whole edge. Only edges with nothing beyond them are tested. Where many surfaces lie in one
// place this takes long: go_on, if it is not empty, is called now and then, and all edges stay if it returns
// false.
std::vector<BoundaryEdge> without_continued(std::vector<BoundaryEdge> edges, const Bvh& bvh,
                                            const std::function<bool()>& go_on = {});

}  // namespace kaustik::accel
