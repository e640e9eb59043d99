#pragma once
// The visible points in the cells that their discs meet: a hash table (Teschner et al. 2003) of linked lists,
// filled by all threads at once.

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_reduce.h>

#include "benchmarks/sppm_rival/pixels.h"
#include "core/math/bounds.h"

namespace kaustik::benchmarks::sppm {

class PointGrid {
 public:
  // Builds the grid anew, with cells as wide as the largest radius.
  void build(Pixel* pixels, uint32_t count) {
    pixels_ = pixels;
    measure(count);
    if (heads_.size() != count) heads_ = std::vector<std::atomic<uint32_t>>(count);
    if (nodes_size_ > nodes_reserved_) {
      nodes_reserved_ = nodes_size_ + nodes_size_ / 8;
      nodes_ = std::make_unique_for_overwrite<Node[]>(nodes_reserved_);
    }
    used_ = 0;
    const tbb::blocked_range<uint32_t> all(0, count, 4096);
    tbb::parallel_for(all, [&](const auto& range) {
      for (uint32_t i = range.begin(); i < range.end(); ++i)
        heads_[i].store(kNone, std::memory_order_relaxed);
    });
    tbb::parallel_for(all, [&](const auto& range) { insert(range.begin(), range.end()); });
  }

  // Calls fn(pixel) for each visible point that has p within its radius.
  template <class Fn>
  void for_each(const Point3& p, Fn&& fn) const {
    if (heads_.empty() || glm::any(glm::lessThan(p, lowest_)) || glm::any(glm::greaterThan(p, highest_)))
      return;
    const Cell cell = cell_of(p);
    const uint32_t key = key_of(cell);
    for (uint32_t n = heads_[bucket_of(cell)].load(std::memory_order_relaxed); n != kNone;
         n = nodes_[n].next) {
      if (nodes_[n].key != key) continue;  // a node of another cell in the same bucket
      Pixel& pixel = pixels_[nodes_[n].pixel];
      if (length_squared(p - pixel.p) <= pixel.radius * pixel.radius) fn(pixel);
    }
  }

 private:
  using Cell = glm::ivec3;
  static constexpr uint32_t kNone = kNoIndex;
  struct Node {
    uint32_t pixel, key, next;
  };
  struct Extent {
    Point3 low{kInfinity}, high{-kInfinity};
    float radius = 0;
  };

  // Finds the bounds, the cell width and the number of nodes.
  void measure(uint32_t count) {
    const tbb::blocked_range<uint32_t> all(0, count, 4096);
    const Extent extent = tbb::parallel_reduce(
        all, Extent{},
        [&](const auto& range, Extent e) {
          for (uint32_t i = range.begin(); i < range.end(); ++i) {
            const Pixel& pixel = pixels_[i];
            if (!pixel.visible) continue;
            e = joined(e, {pixel.p - pixel.radius, pixel.p + pixel.radius, pixel.radius});
          }
          return e;
        },
        joined);
    lowest_ = extent.low, highest_ = extent.high;
    cells_per_metre_ = extent.radius > 0 ? 1 / extent.radius : 0;
    if (extent.radius > 0) size_ = glm::uvec3(cell_of(highest_)) + 1u;
    nodes_size_ = tbb::parallel_reduce(
        all, size_t{0},
        [&](const auto& range, size_t sum) {
          for (uint32_t i = range.begin(); i < range.end(); ++i) sum += cells(pixels_[i]);
          return sum;
        },
        std::plus<size_t>());
  }

  static Extent joined(const Extent& a, const Extent& b) {
    return {glm::min(a.low, b.low), glm::max(a.high, b.high), std::max(a.radius, b.radius)};
  }

  size_t cells(const Pixel& pixel) const {
    if (!pixel.visible) return 0;
    const Cell sides = cell_of(pixel.p + pixel.radius) - cell_of(pixel.p - pixel.radius) + 1;
    return size_t(sides.x) * size_t(sides.y) * size_t(sides.z);
  }

  void insert(uint32_t begin, uint32_t end) {
    size_t count = 0;
    for (uint32_t i = begin; i < end; ++i) count += cells(pixels_[i]);
    uint32_t next = used_.fetch_add(uint32_t(count));
    for (uint32_t i = begin; i < end; ++i) {
      const Pixel& pixel = pixels_[i];
      if (!pixel.visible) continue;
      const Cell low = cell_of(pixel.p - pixel.radius), high = cell_of(pixel.p + pixel.radius);
      for (int z = low.z; z <= high.z; ++z)
        for (int y = low.y; y <= high.y; ++y)
          for (int x = low.x; x <= high.x; ++x) push(next++, i, {x, y, z});
    }
  }

  void push(uint32_t node, uint32_t pixel, const Cell& cell) {
    std::atomic<uint32_t>& head = heads_[bucket_of(cell)];
    nodes_[node] = {pixel, key_of(cell), head.exchange(node, std::memory_order_relaxed)};
  }

  Cell cell_of(const Point3& p) const { return Cell((p - lowest_) * cells_per_metre_); }
  // Unique to a cell in a grid of fewer than 2^32 cells.
  uint32_t key_of(const Cell& c) const {
    return (uint32_t(c.z) * size_.y + uint32_t(c.y)) * size_.x + uint32_t(c.x);
  }
  size_t bucket_of(const Cell& c) const {
    return (uint32_t(c.x) * 73856093u ^ uint32_t(c.y) * 19349663u ^ uint32_t(c.z) * 83492791u) %
           uint32_t(heads_.size());
  }

  Pixel* pixels_ = nullptr;
  Point3 lowest_{0}, highest_{0};
  float cells_per_metre_ = 0;
  glm::uvec3 size_{1};
  std::vector<std::atomic<uint32_t>> heads_;
  std::unique_ptr<Node[]> nodes_;
  size_t nodes_size_ = 0, nodes_reserved_ = 0;
  std::atomic<uint32_t> used_{0};
};

}  // namespace kaustik::benchmarks::sppm
