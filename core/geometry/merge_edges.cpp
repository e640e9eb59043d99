// Edges are linked at the points where exactly two of them continue each other. Each chain of links is then
// replaced by one edge if that is straight enough, and otherwise halved.

#include "core/geometry/merge_edges.h"

#include <algorithm>
#include <array>
#include <span>
#include <tuple>

#include "core/geometry/point_bits.h"
#include "core/parallel/parallel.h"

namespace kaustik {
namespace {

constexpr double kStraight = 0x1p-19;     // of the largest coordinate
constexpr float kSame = 1 - 0x1p-20f;     // cosine
constexpr size_t kMostEdgesAtPoint = 64;  // where more meet, none continues another
constexpr uint32_t kNone = 0xffffffffu;

bool agree(const Vector3& a, const Vector3& b) {
  return a == b || glm::dot(a, b) > kSame;
}

bool same_side(const BoundaryEdge& a, const BoundaryEdge& b) {
  return a.both_sides == b.both_sides && agree(a.n, b.n) && agree(a.beyond, b.beyond) &&
         agree(a.outward, b.outward);
}

// One end of an edge.
struct End {
  uint32_t edge;
  bool at_b;

  const Point3& point(std::span<const BoundaryEdge> edges) const {
    return at_b ? edges[edge].b : edges[edge].a;
  }
  End other() const { return {edge, !at_b}; }
  size_t index() const { return 2 * size_t(edge) + at_b; }
};

// The edges of one surface group.
class Chains {
 public:
  explicit Chains(std::span<const BoundaryEdge> edges)
      : edges_(edges), linked_(2 * edges.size(), End{kNone, false}) {
    link_all();
  }

  // Appends the merged edges.
  void merge(std::vector<BoundaryEdge>* merged) const {
    std::vector<bool> done(edges_.size());
    std::vector<End> chain;
    for (uint32_t i = 0; i < edges_.size(); ++i) {
      if (done[i]) continue;
      chain.clear();
      for (End end = first_of(i); end.edge != kNone && !done[end.edge]; end = linked_[end.other().index()]) {
        done[end.edge] = true;
        chain.push_back(end);
      }
      merge(chain, merged);
    }
  }

 private:
  void link_all() {
    struct Keyed {
      PointBits at;
      End end;
    };
    std::vector<Keyed> ends;
    ends.reserve(linked_.size());
    for (uint32_t i = 0; i < edges_.size(); ++i)
      for (const End end : {End{i, false}, End{i, true}}) ends.push_back({bits_of(end.point(edges_)), end});
    std::sort(ends.begin(), ends.end(), [](const Keyed& a, const Keyed& b) {
      return std::tuple(a.at, a.end.index()) < std::tuple(b.at, b.end.index());
    });
    std::vector<End> together;
    for (size_t begin = 0, end = 0; begin < ends.size(); begin = end) {
      together.clear();
      for (; end < ends.size() && ends[end].at == ends[begin].at; ++end) together.push_back(ends[end].end);
      if (together.size() <= kMostEdgesAtPoint) link(together);
    }
  }

  // Links the pairs among the ends at one point of which each is the only one to continue the other.
  void link(std::span<const End> ends) {
    const auto only_next = [&](End end) {
      End next{kNone, false};
      for (const End other : ends) {
        if (!continues(end, other)) continue;
        if (next.edge != kNone) return End{kNone, false};
        next = other;
      }
      return next;
    };
    for (const End end : ends) {
      const End next = only_next(end);
      if (next.edge != kNone && only_next(next).edge == end.edge) linked_[end.index()] = next;
    }
  }

  bool continues(End end, End next) const {
    if (end.edge == next.edge || !same_side(edges_[end.edge], edges_[next.edge])) return false;
    const glm::dvec3 p(end.point(edges_));
    const glm::dvec3 back = glm::dvec3(end.other().point(edges_)) - p;
    const glm::dvec3 on = glm::dvec3(next.other().point(edges_)) - p;
    return glm::dot(back, on) < 0;
  }

  // The end at which the chain of the edge begins; somewhere on it if it is closed.
  End first_of(uint32_t edge) const {
    End first{edge, false};
    for (End end = linked_[first.index()]; end.edge != kNone && end.edge != edge;
         end = linked_[first.index()])
      first = end.other();
    return first;
  }

  void merge(std::span<const End> chain, std::vector<BoundaryEdge>* merged) const {
    if (chain.size() == 1) return merged->push_back(edges_[chain[0].edge]);
    const BoundaryEdge whole = spanned(chain);
    if (fits(chain, whole)) return merged->push_back(whole);
    merge(chain.first(chain.size() / 2), merged);
    merge(chain.subspan(chain.size() / 2), merged);
  }

  BoundaryEdge spanned(std::span<const End> chain) const {
    BoundaryEdge whole = edges_[chain[chain.size() / 2].edge];
    whole.a = chain.front().point(edges_);
    whole.b = chain.back().other().point(edges_);
    for (const End end : chain) whole.height = std::min(whole.height, edges_[end.edge].height);
    return whole;
  }

  bool fits(std::span<const End> chain, const BoundaryEdge& whole) const {
    const glm::dvec3 a(whole.a), along = glm::dvec3(whole.b) - a;
    const double length = glm::length(along);
    if (!(length > 0)) return false;
    const double size = double(std::max(max_abs_component(whole.a), max_abs_component(whole.b)));
    return std::all_of(chain.begin(), chain.end(), [&](End end) {
      const glm::dvec3 off = glm::cross(glm::dvec3(end.point(edges_)) - a, along / length);
      return glm::length(off) <= kStraight * size && same_side(edges_[end.edge], whole);
    });
  }

  std::span<const BoundaryEdge> edges_;
  std::vector<End> linked_;  // by index of an end: the end of the edge that continues it there
};

// Where each surface group begins in the sorted edges, and the end of the last.
std::vector<size_t> begins_of_groups(std::span<const BoundaryEdge> edges) {
  std::vector<size_t> begins;
  for (size_t i = 0; i < edges.size(); ++i)
    if (i == 0 || edges[i].surface_group != edges[i - 1].surface_group) begins.push_back(i);
  begins.push_back(edges.size());
  return begins;
}

}  // namespace

std::vector<BoundaryEdge> merge_edges(std::vector<BoundaryEdge> edges) {
  sort_by_group(&edges);
  const std::vector<size_t> begins = begins_of_groups(edges);
  std::vector<std::vector<BoundaryEdge>> merged(begins.size() - 1);
  parallel::for_index(size_t{0}, merged.size(), [&](size_t g) {
    Chains(std::span(edges).subspan(begins[g], begins[g + 1] - begins[g])).merge(&merged[g]);
  });
  size_t count = 0;
  for (const auto& some : merged) count += some.size();
  std::vector<BoundaryEdge> all;
  all.reserve(count);
  for (const auto& some : merged) all.insert(all.end(), some.begin(), some.end());
  return all;
}

}  // namespace kaustik
