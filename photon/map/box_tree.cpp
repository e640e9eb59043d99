#include "photon/map/box_tree.h"

#include <tbb/blocked_range.h>

#include <algorithm>
#include <bit>
#include <limits>
#include <stdexcept>

#include "core/parallel/parallel.h"

namespace kaustik::photon {

namespace {

constexpr uint32_t kBoxes = BoxNode::kBoxes, kBlock = BoxTree::kBlockPhotons;
constexpr float kNone = std::numeric_limits<float>::infinity();

// Smallest interval that holds a block's coordinates along one axis. Eight partial intervals side by side let
// the compiler use vectors.
void find_interval(const float* column, uint64_t photons, float* lo, float* hi) {
  constexpr uint32_t kSide = 8;
  float low[kSide], high[kSide];
  std::fill_n(low, kSide, kNone);
  std::fill_n(high, kSide, -kNone);
  const auto add = [&](uint64_t i, uint32_t s) {
    low[s] = column[i] < low[s] ? column[i] : low[s];
    high[s] = column[i] > high[s] ? column[i] : high[s];
  };
  if (photons == kBlock) {
    for (uint32_t i = 0; i < kBlock; i += kSide)
      for (uint32_t s = 0; s < kSide; ++s) add(i + s, s);
  } else {
    for (uint64_t i = 0; i < photons; ++i) add(i, 0);
  }
  *lo = *std::min_element(low, low + kSide);
  *hi = *std::max_element(high, high + kSide);
}

// Intervals of all blocks of a node along one axis; column[0] is the node's first photon.
void find_intervals(const float* column, uint64_t photons, float* lo, float* hi) {
  for (uint64_t b = 0; b < kBoxes; ++b) {
    const uint64_t first = std::min(photons, b * kBlock);
    find_interval(column + first, std::min<uint64_t>(kBlock, photons - first), lo + b, hi + b);
  }
}

// Intervals along one axis that enclose all boxes of each child.
void join_intervals(std::span<const BoxNode> children, int axis, BoxNode& node) {
  std::fill_n(node.lo[axis], kBoxes, kNone);
  std::fill_n(node.hi[axis], kBoxes, -kNone);
  for (size_t b = 0; b < children.size(); ++b) {
    node.lo[axis][b] = *std::min_element(children[b].lo[axis], children[b].lo[axis] + kBoxes);
    node.hi[axis][b] = *std::max_element(children[b].hi[axis], children[b].hi[axis] + kBoxes);
  }
}

uint32_t common_surface(const uint32_t* surface, uint64_t photons) {
  uint32_t differ = 0;
  for (uint64_t i = 1; i < photons; ++i) differ |= surface[i] ^ surface[0];
  if (differ == 0) return surface[0];
  return differ >> 16 == 0 ? surface[0] | BoxTree::kAnyNormal : BoxTree::kAnySurface;
}

template <class Fn>
void for_each_index(size_t size, const Fn& fn) {
  constexpr size_t kGrain = 64;
  using Indices = tbb::blocked_range<size_t>;
  parallel::for_range(Indices(0, size, kGrain), [&](const Indices& indices) {
    for (size_t i = indices.begin(); i < indices.end(); ++i) fn(i);
  });
}

}  // namespace

void BoxTree::set_levels(uint64_t size) {
  for (uint64_t boxes = (size + kBlock - 1) / kBlock; boxes > 1 || (boxes == 1 && levels_ == 0); ++levels_) {
    boxes = (boxes + kBoxes - 1) / kBoxes;  // number of nodes at the level above
    first_[levels_ + 1] = first_[levels_] + boxes;
  }
}

BoxTree::BoxTree(uint64_t size, SharedArray<BoxNode> nodes, SharedArray<Surfaces> surfaces)
    : nodes_(std::move(nodes)), surfaces_(std::move(surfaces)) {
  set_levels(size);
  if (nodes_.size() != first_[levels_] || surfaces_.size() != first_[1])
    throw std::invalid_argument("these are not the boxes of so many photons");
}

BoxTree::BoxTree(const PhotonColumns& columns, uint64_t size) {
  set_levels(size);
  if (levels_ == 0) return;
  UninitialisedArray<BoxNode> nodes(first_[levels_]);
  UninitialisedArray<Surfaces> surfaces(first_[1]);
  for_each_index(first_[1], [&](size_t i) {
    const uint64_t begin = i * kNodePhotons, photons = std::min<uint64_t>(kNodePhotons, size - begin);
    const float* const axes[] = {columns.x + begin, columns.y + begin, columns.z + begin};
    for (int axis = 0; axis < 3; ++axis)
      find_intervals(axes[axis], photons, nodes[i].lo[axis], nodes[i].hi[axis]);
    for (uint64_t b = 0; b < kBoxes; ++b) {
      const uint64_t first = std::min(photons, b * kBlock);
      surfaces[i].of_block[b] =
          common_surface(columns.surface + begin + first, std::min<uint64_t>(kBlock, photons - first));
    }
  });
  for (int l = 1; l < levels_; ++l) {
    const std::span<const BoxNode> below(nodes.data() + first_[l - 1], first_[l] - first_[l - 1]);
    for_each_index(first_[l + 1] - first_[l], [&](size_t i) {
      const size_t count = std::min<size_t>(kBoxes, below.size() - i * kBoxes);
      for (int axis = 0; axis < 3; ++axis)
        join_intervals(below.subspan(i * kBoxes, count), axis, nodes[first_[l] + i]);
    });
  }
  nodes_ = SharedArray(std::move(nodes));
  surfaces_ = SharedArray(std::move(surfaces));
}

bool BoxTree::Start::list(const CellRanges& ranges, int shift) {
  size_t listed = 0;  // counts a node once per range, although several ranges may share it
  uint32_t next = 0;
  size = 0;
  for (size_t r = 0; r < ranges.size; ++r) {
    const uint32_t begin = ranges.first[r] >> shift, end = (ranges.last[r] >> shift) + 1;
    if ((listed += end - begin) > kMost) return false;
    // Usually none, one or two nodes are new. Branchless, since a branch on that would be mispredicted.
    const uint32_t first = std::max(next, begin);
    nodes[size] = first;
    size += first < end;
    nodes[size] = first + 1;
    size += first + 1 < end;
    for (uint32_t node = first + 2; node < end; ++node) nodes[size++] = node;
    next = std::max(next, end);
  }
  return true;
}

BoxTree::Start BoxTree::start_at(const CellRanges& ranges) const {
  Start start;
  int shift = std::bit_width(kNodePhotons) - 1;
  for (; !start.list(ranges, shift); ++start.level) shift += std::bit_width(BoxNode::kBoxes) - 1;
  return start;
}

}  // namespace kaustik::photon
