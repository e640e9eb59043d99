// Joins shapes to surface groups by name or by shared boundary edges.

#include "core/scene/build/surface_groups.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <map>
#include <numeric>
#include <span>

#include "core/geometry/point_bits.h"
#include "core/math/frame.h"
#include "core/parallel/parallel.h"

namespace kaustik {
namespace {

constexpr float kSameSurfaceCosine = 0.9f;

class DisjointSets {
 public:
  explicit DisjointSets(size_t n) : parent_(n) { std::iota(parent_.begin(), parent_.end(), 0u); }
  uint32_t find(uint32_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  // The smaller index remains the representative, so that the result does not depend on the order of joining.
  void join(uint32_t a, uint32_t b) {
    a = find(a);
    b = find(b);
    parent_[std::max(a, b)] = std::min(a, b);
  }

 private:
  std::vector<uint32_t> parent_;
};

struct BoundaryEdge {
  std::array<PointBits, 2> ends;  // sorted
  Normal3 n;                      // unit, of the triangle that ends there
  uint32_t shape;
};

Normal3 normal_of(const TriangleMesh& mesh, const std::array<uint32_t, 3>& triangle) {
  const glm::dvec3 p0(mesh.P[triangle[0]]);
  const glm::dvec3 n = glm::cross(glm::dvec3(mesh.P[triangle[1]]) - p0, glm::dvec3(mesh.P[triangle[2]]) - p0);
  const double length = glm::length(n);
  return length > 0 ? Normal3(n / length) : Normal3(0);
}

// Edges that belong to only one triangle, compared by vertex index. Meshes with duplicated vertices also have
// such edges inside, which does no harm because they only join a shape to itself.
std::vector<BoundaryEdge> boundary_edges(const TriangleMesh& mesh, uint32_t shape) {
  struct Edge {
    uint64_t vertices;
    uint32_t triangle;
  };
  std::vector<Edge> edges;
  edges.reserve(mesh.indices.size() * 3);
  for (size_t t = 0; t < mesh.indices.size(); ++t) {
    for (int k = 0; k < 3; ++k) {
      const auto [low, high] = std::minmax({mesh.indices[t][k], mesh.indices[t][(k + 1) % 3]});
      edges.push_back({(uint64_t{low} << 32) | high, static_cast<uint32_t>(t)});
    }
  }
  parallel::sort(edges.begin(), edges.end(), [](const Edge& a, const Edge& b) {
    return a.vertices != b.vertices ? a.vertices < b.vertices : a.triangle < b.triangle;
  });
  std::vector<BoundaryEdge> boundary;
  for (size_t i = 0; i < edges.size(); ++i) {
    const bool shared = (i > 0 && edges[i - 1].vertices == edges[i].vertices) ||
                        (i + 1 < edges.size() && edges[i + 1].vertices == edges[i].vertices);
    if (shared) continue;
    std::array<PointBits, 2> ends = {bits_of(mesh.P[edges[i].vertices >> 32]),
                                     bits_of(mesh.P[edges[i].vertices & 0xffffffffu])};
    std::sort(ends.begin(), ends.end());
    boundary.push_back({ends, normal_of(mesh, mesh.indices[edges[i].triangle]), shape});
  }
  return boundary;
}

std::vector<BoundaryEdge> all_boundary_edges(const std::vector<Shape>& shapes,
                                             const std::vector<std::string>& names) {
  const auto is_candidate = [&](size_t i) {
    return names[i].empty() && std::holds_alternative<TriangleMesh>(shapes[i].geometry);
  };
  size_t candidates = 0;
  for (size_t i = 0; i < shapes.size(); ++i) candidates += is_candidate(i) ? 1 : 0;
  if (candidates < 2) return {};
  std::vector<std::vector<BoundaryEdge>> of_shape(shapes.size());
  parallel::for_index(size_t{0}, shapes.size(), [&](size_t i) {
    if (!is_candidate(i)) return;
    of_shape[i] = boundary_edges(std::get<TriangleMesh>(shapes[i].geometry), static_cast<uint32_t>(i));
  });
  std::vector<BoundaryEdge> edges;
  for (auto& part : of_shape) edges.insert(edges.end(), part.begin(), part.end());
  std::stable_sort(edges.begin(), edges.end(),
                   [](const BoundaryEdge& a, const BoundaryEdge& b) { return a.ends < b.ends; });
  return edges;
}

// In double precision, in which no square of a difference vanishes.
glm::dvec3 point_of(const PointBits& bits) {
  return {std::bit_cast<float>(bits[0]), std::bit_cast<float>(bits[1]), std::bit_cast<float>(bits[2])};
}

void join_if_alike(const BoundaryEdge& a, const BoundaryEdge& b, DisjointSets& sets) {
  if (abs_dot(a.n, b.n) > kSameSurfaceCosine) sets.join(a.shape, b.shape);
}

// Joins all pairs whose normals are alike, directly or by others between them. The normals are perpendicular
// to the common edge, so neighbours in the order of the angle around it are enough: a scene can have any
// number of triangles at one edge.
void join_around(std::span<const BoundaryEdge> edges, DisjointSets& sets) {
  const Frame frame =
      Frame::from_z(Vector3(glm::normalize(point_of(edges[0].ends[1]) - point_of(edges[0].ends[0]))));
  std::vector<std::pair<float, uint32_t>> by_angle;  // in [0, pi]: opposite normals are alike
  for (uint32_t i = 0; i < edges.size(); ++i) {
    const Vector3 n = frame.to_local(edges[i].n);
    if (n == Vector3(0)) continue;
    const float angle = std::atan2(n.y, n.x);
    by_angle.emplace_back(angle < 0 ? angle + kPi : angle, i);
  }
  std::sort(by_angle.begin(), by_angle.end());
  for (size_t k = 0; k < by_angle.size(); ++k)
    join_if_alike(edges[by_angle[k].second], edges[by_angle[(k + 1) % by_angle.size()].second], sets);
}

void join_by_edges(const std::vector<BoundaryEdge>& edges, DisjointSets& sets) {
  for (size_t begin = 0, end = 0; begin < edges.size(); begin = end) {
    while (end < edges.size() && edges[end].ends == edges[begin].ends) ++end;
    if (edges[begin].ends[0] == edges[begin].ends[1]) continue;  // triangles without area
    if (end - begin == 2) join_if_alike(edges[begin], edges[begin + 1], sets);
    if (end - begin > 2) join_around(std::span(edges).subspan(begin, end - begin), sets);
  }
}

}  // namespace

uint32_t assign_surface_groups(std::vector<Shape>& shapes, const std::vector<std::string>& names) {
  DisjointSets sets(shapes.size());
  std::map<std::string, uint32_t> first_of_name;
  for (uint32_t i = 0; i < shapes.size(); ++i) {
    if (!names[i].empty()) sets.join(i, first_of_name.emplace(names[i], i).first->second);
  }
  join_by_edges(all_boundary_edges(shapes, names), sets);

  std::vector<uint32_t> group_of_root(shapes.size(), kNoIndex);
  uint32_t groups = 0;
  for (uint32_t i = 0; i < shapes.size(); ++i) {
    uint32_t& group = group_of_root[sets.find(i)];
    if (group == kNoIndex) group = groups++;
    shapes[i].surface_group = group;
  }
  return groups;
}

}  // namespace kaustik
