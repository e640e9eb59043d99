// One tree of boxes for each surface group that has more than a few edges. A tree of all groups would visit
// the edges of every object near the point: in a room of fine objects that took most of a render. Boxes and
// distances are exact in double precision, so that the results are the same at every scale.

#include "accel/edge_index.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <numeric>

namespace kaustik::accel {

namespace {

constexpr uint32_t kFewEdges = 16;  // up to this many, a linear walk is no slower than a descent of the tree
constexpr uint32_t kEdgesOfLeaf = 4;  // at most
constexpr int kDeepest = 64;          // halving 2^32 edges takes 32 levels

bool reaches(const BoundaryEdge& edge, const glm::dvec3& p, double radius) {
  const glm::dvec3 a = glm::dvec3(edge.a) - p, along = glm::dvec3(edge.b) - glm::dvec3(edge.a);
  const double t = std::clamp(-glm::dot(a, along) / glm::dot(along, along), 0.0, 1.0);
  const glm::dvec3 nearest = a + t * along;
  return glm::dot(nearest, nearest) <= radius * radius;
}

glm::dvec3 doubled_middle(const BoundaryEdge& edge) {
  return glm::dvec3(edge.a) + glm::dvec3(edge.b);
}

}  // namespace

// Nodes in preorder: the first child follows its parent.
struct EdgeIndex::Tree {
  struct Node {
    Point3 low, high;
    uint32_t begin, end;        // of order
    uint32_t second_child = 0;  // 0: a leaf
  };
  std::vector<Node> nodes;
  std::vector<uint32_t> order;  // indices of edges

  Tree(const std::vector<BoundaryEdge>& edges, uint32_t begin, uint32_t end) : order(end - begin) {
    std::iota(order.begin(), order.end(), begin);
    build(edges, 0, end - begin);
  }

  template <class Visit>
  bool visit_near(const Point3& p, float radius, size_t most, const Visit& visit) const;

 private:
  void build(const std::vector<BoundaryEdge>& edges, uint32_t begin, uint32_t end);
};

void EdgeIndex::Tree::build(const std::vector<BoundaryEdge>& edges, uint32_t begin, uint32_t end) {
  Node node{Point3(kInfinity), Point3(-kInfinity), begin, end};
  glm::dvec3 low(HUGE_VAL), high(-HUGE_VAL);  // of the middles
  for (uint32_t i = begin; i < end; ++i) {
    const BoundaryEdge& edge = edges[order[i]];
    node.low = glm::min(node.low, glm::min(edge.a, edge.b));
    node.high = glm::max(node.high, glm::max(edge.a, edge.b));
    low = glm::min(low, doubled_middle(edge));
    high = glm::max(high, doubled_middle(edge));
  }
  const size_t at = nodes.size();
  nodes.push_back(node);
  if (end - begin <= kEdgesOfLeaf) return;
  const glm::dvec3 size = high - low;
  const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
  const uint32_t middle = begin + (end - begin) / 2;
  std::nth_element(order.begin() + begin, order.begin() + middle, order.begin() + end,
                   [&](uint32_t a, uint32_t b) {
                     const double x = doubled_middle(edges[a])[axis], y = doubled_middle(edges[b])[axis];
                     return x != y ? x < y : a < b;
                   });
  build(edges, begin, middle);
  nodes[at].second_child = static_cast<uint32_t>(nodes.size());
  build(edges, middle, end);
}

// Calls visit(edge) for the edges of all leaves whose boxes come within radius of p, until it returns false.
// False if a node with more than `most` edges lies within the radius as a whole.
template <class Visit>
bool EdgeIndex::Tree::visit_near(const Point3& p, float radius, size_t most, const Visit& visit) const {
  const glm::dvec3 center(p);
  const double reach = double(radius) * double(radius);
  std::array<uint32_t, kDeepest> waiting{0};
  for (int count = 1; count > 0;) {
    const uint32_t at = waiting[size_t(--count)];
    const Node& node = nodes[at];
    const glm::dvec3 gap =
        glm::max(glm::max(glm::dvec3(node.low) - center, center - glm::dvec3(node.high)), glm::dvec3(0));
    if (glm::dot(gap, gap) > reach) continue;
    if (node.end - node.begin > most) {
      const glm::dvec3 far = glm::max(center - glm::dvec3(node.low), glm::dvec3(node.high) - center);
      if (glm::dot(far, far) <= reach) return false;
    }
    if (node.second_child == 0) {
      for (uint32_t i = node.begin; i < node.end; ++i)
        if (!visit(order[i])) return true;
    } else {
      waiting[size_t(count++)] = node.second_child;
      waiting[size_t(count++)] = at + 1;
    }
  }
  return true;
}

EdgeIndex::EdgeIndex(std::vector<BoundaryEdge> edges) : edges_(std::move(edges)) {
  if (edges_.empty()) return;
  std::stable_sort(edges_.begin(), edges_.end(), [](const BoundaryEdge& a, const BoundaryEdge& b) {
    return a.surface_group < b.surface_group;
  });
  group_begin_.assign(size_t(edges_.back().surface_group) + 2, 0);
  for (const BoundaryEdge& edge : edges_) ++group_begin_[size_t(edge.surface_group) + 1];
  for (size_t g = 1; g < group_begin_.size(); ++g) group_begin_[g] += group_begin_[g - 1];
  trees_.resize(group_begin_.size() - 1);
  tbb::parallel_for(size_t{0}, trees_.size(), [&](size_t g) {
    if (group_begin_[g + 1] - group_begin_[g] > kFewEdges)
      trees_[g] = std::make_unique<const Tree>(edges_, group_begin_[g], group_begin_[g + 1]);
  });
}

EdgeIndex::~EdgeIndex() = default;
EdgeIndex::EdgeIndex(EdgeIndex&&) noexcept = default;
EdgeIndex& EdgeIndex::operator=(EdgeIndex&&) noexcept = default;

size_t EdgeIndex::find(const Point3& p, float radius, uint32_t surface_group, std::span<uint32_t> out) const {
  if (surface_group >= trees_.size() || !(radius >= 0)) return 0;
  const glm::dvec3 center(p);
  size_t count = 0;
  const auto visit = [&](uint32_t i) {
    if (!reaches(edges_[i], center, double(radius))) return true;
    if (count < out.size()) out[count] = i;
    return ++count <= out.size();
  };
  const Tree* const tree = trees_[surface_group].get();
  if (!tree) {
    for (uint32_t i = group_begin_[surface_group]; i < group_begin_[surface_group + 1] && visit(i); ++i)
      continue;
    return count;
  }
  if (!tree->visit_near(p, radius, out.size(), visit)) return out.size() + 1;
  std::sort(out.begin(), out.begin() + std::ptrdiff_t(std::min(count, out.size())));
  return count;
}

uint64_t EdgeIndex::memory_bytes() const {
  uint64_t bytes = edges_.size() * sizeof(BoundaryEdge) + group_begin_.size() * sizeof(uint32_t);
  for (const auto& tree : trees_)
    if (tree) bytes += tree->nodes.size() * sizeof(Tree::Node) + tree->order.size() * sizeof(uint32_t);
  return bytes;
}

}  // namespace kaustik::accel
