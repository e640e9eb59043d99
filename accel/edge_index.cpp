// One tree of boxes for each surface group that has more than a few edges. A tree of all groups would visit
// the edges of every object near the point: in a room of fine objects that took most of a render. Edges lie
// in the order of the leaves, so that a node is a range of them. Distances of edges are exact in double
// precision, and boxes are tested with a margin, so that the results are the same at every scale.

#include "accel/edge_index.h"

#include <algorithm>
#include <array>
#include <numeric>

#include "core/parallel/parallel.h"

namespace kaustik::accel {

namespace {

constexpr uint32_t kFewEdges = 16;  // up to this many, a linear walk is no slower than a descent of the tree
constexpr uint32_t kEdgesOfLeaf = 4;  // at most
constexpr int kDeepest = 64;          // halving 2^32 edges takes 32 levels
constexpr double kMargin = 0x1p-20;   // relative, of squared distances to boxes: a few roundings

bool reaches(const BoundaryEdge& edge, const glm::dvec3& p, double radius) {
  const glm::dvec3 a = glm::dvec3(edge.a) - p, along = glm::dvec3(edge.b) - glm::dvec3(edge.a);
  const double t = std::clamp(-glm::dot(a, along) / glm::dot(along, along), 0.0, 1.0);
  const glm::dvec3 nearest = a + t * along;
  return glm::dot(nearest, nearest) <= radius * radius;
}

glm::dvec3 doubled_middle(const BoundaryEdge& edge) {
  return glm::dvec3(edge.a) + glm::dvec3(edge.b);
}

// Indices of edges, up to the size of the span; counts one more than that at most.
class Found {
 public:
  explicit Found(std::span<uint32_t> out) : out_(out) {}
  size_t count() const { return count_; }
  // Adds the range; false when it does not fit.
  bool add(uint32_t begin, uint32_t end) {
    if (end - begin > out_.size() - count_) {
      count_ = out_.size() + 1;
      return false;
    }
    while (begin < end) out_[count_++] = begin++;
    return true;
  }
  // Sorts the indices. They are unspecified if they do not all fit.
  void sort() {
    if (count_ <= out_.size()) std::sort(out_.begin(), out_.begin() + std::ptrdiff_t(count_));
  }

 private:
  std::span<uint32_t> out_;
  size_t count_ = 0;
};

// Adds those of the range that reach the ball; false when they do not fit.
bool add_reaching(const std::vector<BoundaryEdge>& edges, uint32_t begin, uint32_t end, const glm::dvec3& p,
                  float radius, Found* found) {
  for (uint32_t i = begin; i < end; ++i)
    if (reaches(edges[i], p, double(radius)) && !found->add(i, i + 1)) return false;
  return true;
}

}  // namespace

// Nodes in preorder: the first child follows its parent. A node of edges from begin to end has its children
// meet at the middle of these.
struct EdgeIndex::Tree {
  struct Node {
    Point3 low, high;
    uint32_t second_child = 0;  // 0: a leaf
  };
  std::vector<Node> nodes;

  // Sorts the edges from begin to end.
  Tree(std::vector<BoundaryEdge>& edges, uint32_t begin, uint32_t end);

  // Adds the edges of the tree, which are those from begin to end, that have a point in the ball, up to the
  // first that does not fit.
  void find(const std::vector<BoundaryEdge>& edges, uint32_t begin, uint32_t end, const Point3& p,
            float radius, Found* found) const;

 private:
  static uint32_t middle(uint32_t begin, uint32_t end) { return begin + (end - begin) / 2; }
  void build(const std::vector<BoundaryEdge>& edges, std::span<uint32_t> order);
};

EdgeIndex::Tree::Tree(std::vector<BoundaryEdge>& edges, uint32_t begin, uint32_t end) {
  std::vector<uint32_t> order(end - begin);
  std::iota(order.begin(), order.end(), begin);
  nodes.reserve(order.size());
  build(edges, order);
  std::vector<BoundaryEdge> sorted(order.size());
  std::transform(order.begin(), order.end(), sorted.begin(), [&](uint32_t i) { return edges[i]; });
  std::copy(sorted.begin(), sorted.end(), edges.begin() + begin);
}

void EdgeIndex::Tree::build(const std::vector<BoundaryEdge>& edges, std::span<uint32_t> order) {
  Node node{Point3(kInfinity), Point3(-kInfinity)};
  glm::dvec3 low(HUGE_VAL), high(-HUGE_VAL);  // of the middles
  for (const uint32_t i : order) {
    const BoundaryEdge& edge = edges[i];
    node.low = glm::min(node.low, glm::min(edge.a, edge.b));
    node.high = glm::max(node.high, glm::max(edge.a, edge.b));
    low = glm::min(low, doubled_middle(edge));
    high = glm::max(high, doubled_middle(edge));
  }
  const size_t at = nodes.size();
  nodes.push_back(node);
  if (order.size() <= kEdgesOfLeaf) return;
  const int axis = largest_axis(high - low);
  const size_t half = middle(0, static_cast<uint32_t>(order.size()));
  std::nth_element(order.begin(), order.begin() + std::ptrdiff_t(half), order.end(),
                   [&](uint32_t a, uint32_t b) {
                     const double x = doubled_middle(edges[a])[axis], y = doubled_middle(edges[b])[axis];
                     return x != y ? x < y : a < b;
                   });
  build(edges, order.first(half));
  nodes[at].second_child = static_cast<uint32_t>(nodes.size());
  build(edges, order.subspan(half));
}

// The nearer child comes first, so that a ball with too many edges is left early.
void EdgeIndex::Tree::find(const std::vector<BoundaryEdge>& edges, uint32_t begin, uint32_t end,
                           const Point3& p, float radius, Found* found) const {
  struct Waiting {
    uint32_t node, begin, end;
    double squared_gap, squared_far;  // distances from p to the nearest and the farthest point of the box
  };
  const auto view = [&](uint32_t at, uint32_t first, uint32_t last) {
    const Node& node = nodes[at];
    const Vector3 over = node.low - p, under = p - node.high;
    const glm::dvec3 gap(glm::max(glm::max(over, under), Vector3(0))), far(glm::max(-over, -under));
    return Waiting{at, first, last, glm::dot(gap, gap), glm::dot(far, far)};
  };
  const double squared = double(radius) * double(radius);
  const double outside = squared * (1 + kMargin), inside = squared * (1 - kMargin);
  std::array<Waiting, kDeepest> waiting;
  waiting[0] = view(0, begin, end);
  for (int count = 1; count > 0;) {
    const Waiting at = waiting[size_t(--count)];
    if (at.squared_gap > outside) continue;
    if (at.squared_far < inside) {
      if (!found->add(at.begin, at.end)) return;
    } else if (const uint32_t second = nodes[at.node].second_child; second == 0) {
      if (!add_reaching(edges, at.begin, at.end, glm::dvec3(p), radius, found)) return;
    } else {
      const uint32_t half = middle(at.begin, at.end);
      Waiting near = view(at.node + 1, at.begin, half), far = view(second, half, at.end);
      if (far.squared_far < near.squared_far) std::swap(near, far);
      waiting[size_t(count++)] = far;
      waiting[size_t(count++)] = near;
    }
  }
}

EdgeIndex::EdgeIndex(std::vector<BoundaryEdge> edges) : edges_(std::move(edges)) {
  if (edges_.empty()) return;
  sort_by_group(&edges_);
  group_begin_.assign(size_t(edges_.back().surface_group) + 2, 0);
  for (const BoundaryEdge& edge : edges_) ++group_begin_[size_t(edge.surface_group) + 1];
  for (size_t g = 1; g < group_begin_.size(); ++g) group_begin_[g] += group_begin_[g - 1];
  trees_.resize(group_begin_.size() - 1);
  parallel::for_index(size_t{0}, trees_.size(), [&](size_t g) {
    if (group_begin_[g + 1] - group_begin_[g] > kFewEdges)
      trees_[g] = std::make_unique<const Tree>(edges_, group_begin_[g], group_begin_[g + 1]);
  });
}

EdgeIndex::~EdgeIndex() = default;
EdgeIndex::EdgeIndex(EdgeIndex&&) noexcept = default;
EdgeIndex& EdgeIndex::operator=(EdgeIndex&&) noexcept = default;

size_t EdgeIndex::find(const Point3& p, float radius, uint32_t surface_group, std::span<uint32_t> out) const {
  if (surface_group >= trees_.size() || !(radius >= 0)) return 0;
  Found found(out);
  const uint32_t begin = group_begin_[surface_group], end = group_begin_[surface_group + 1];
  if (const Tree* const tree = trees_[surface_group].get()) {
    tree->find(edges_, begin, end, p, radius, &found);
    found.sort();
  } else {
    add_reaching(edges_, begin, end, glm::dvec3(p), radius, &found);
  }
  return found.count();
}

uint64_t EdgeIndex::memory_bytes() const {
  uint64_t bytes = edges_.size() * sizeof(BoundaryEdge) + group_begin_.size() * sizeof(uint32_t);
  for (const auto& tree : trees_)
    if (tree) bytes += tree->nodes.size() * sizeof(Tree::Node);
  return bytes;
}

}  // namespace kaustik::accel
