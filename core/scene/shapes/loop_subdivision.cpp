// Loop subdivision on half-edges, and positions and normals of the limit surface.

#include "core/scene/shapes/loop_subdivision.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace kaustik {
namespace {

// What is held at most for each triangle of the result.
constexpr uint64_t kBytesOfTriangle = 100;

using Triangle = std::array<uint32_t, 3>;

// Half-edges: half-edge 3 t + k leads from vertex k of triangle t to its next vertex.
struct Topology {
  std::vector<uint32_t> twin;  // opposite half-edge; kNoIndex at a boundary
  // For each vertex an outgoing half-edge, at a boundary the first one of its fan.
  std::vector<uint32_t> start;
};

uint32_t next(uint32_t h) {
  return h % 3 == 2 ? h - 2 : h + 1;
}
uint32_t previous(uint32_t h) {
  return h % 3 == 0 ? h + 2 : h - 1;
}

struct Mesh {
  std::vector<glm::dvec3> P;
  std::vector<Triangle> triangles;

  uint32_t from(uint32_t h) const { return triangles[h / 3][h % 3]; }
  uint32_t to(uint32_t h) const { return from(next(h)); }
};

// Topology::twin of a cage.
std::optional<std::vector<uint32_t>> twins_of(const Mesh& mesh, std::string* error) {
  const auto halves = static_cast<uint32_t>(3 * mesh.triangles.size());
  std::vector<uint32_t> twin(halves, kNoIndex);
  std::vector<std::pair<uint64_t, uint32_t>> edges;  // by their vertices, the lower one first
  edges.reserve(halves);
  for (uint32_t h = 0; h < halves; ++h) {
    const auto [low, high] = std::minmax({mesh.from(h), mesh.to(h)});
    if (low == high) {
      *error = fmt::format("triangle {} has the same vertex twice", h / 3);
      return std::nullopt;
    }
    edges.push_back({uint64_t{low} << 32 | high, h});
  }
  std::sort(edges.begin(), edges.end());
  for (size_t i = 0; i < edges.size(); ++i) {
    const uint32_t h = edges[i].second;
    if (i > 0 && edges[i - 1].first == edges[i].first) {
      const uint32_t other = edges[i - 1].second;
      if (twin[other] != kNoIndex || mesh.from(h) == mesh.from(other)) {
        *error = fmt::format(
            "the edge of vertices {} and {} has {}", mesh.from(h), mesh.to(h),
            twin[other] != kNoIndex ? "more than two triangles" : "two triangles of different winding");
        return std::nullopt;
      }
      twin[h] = other;
      twin[other] = h;
    }
  }
  return twin;
}

// The two half-edges into which h falls when each triangle becomes four, in their order (see refined()).
uint32_t first_half(uint32_t h) {
  return 12 * (h / 3) + 4 * (h % 3);
}
uint32_t second_half(uint32_t h) {
  return 12 * (h / 3) + 3 * (next(h) % 3) + h % 3;
}

std::vector<uint32_t> refined_twins(const std::vector<uint32_t>& twin) {
  std::vector<uint32_t> out(4 * twin.size(), kNoIndex);
  for (uint32_t h = 0; h < twin.size(); ++h) {
    if (twin[h] != kNoIndex) {
      out[first_half(h)] = second_half(twin[h]);
      out[second_half(h)] = first_half(twin[h]);
    }
    // Between the triangle at a corner and the one in the middle.
    const uint32_t first = 12 * (h / 3);
    const uint32_t corner = first + 3 * (h % 3) + next(h) % 3, middle = first + 9 + previous(h) % 3;
    out[corner] = middle;
    out[middle] = corner;
  }
  return out;
}

Topology topology_of(const Mesh& mesh, std::vector<uint32_t> twin) {
  Topology top{std::move(twin), std::vector<uint32_t>(mesh.P.size(), kNoIndex)};
  // An open fan starts at the half-edge without a triangle on its other side.
  for (uint32_t h = 0; h < top.twin.size(); ++h) {
    uint32_t& start = top.start[mesh.from(h)];
    if (start == kNoIndex || top.twin[h] == kNoIndex) start = h;
  }
  return top;
}

// The neighbours of a vertex in the order of its fan; at a boundary the first and the last of them lie on it.
struct Ring {
  std::vector<uint32_t> vertices;
  bool boundary = false;
};

void find_ring(const Mesh& mesh, const Topology& top, uint32_t v, Ring* ring) {
  ring->vertices.clear();
  ring->boundary = false;
  const uint32_t start = top.start[v];
  if (start == kNoIndex) return;
  uint32_t h = start;
  do {
    ring->vertices.push_back(mesh.to(h));
    const uint32_t in = previous(h);  // leads to v
    if (top.twin[in] == kNoIndex) {
      ring->vertices.push_back(mesh.from(in));
      ring->boundary = true;
      return;
    }
    h = top.twin[in];
  } while (h != start);
}

// Whether the fan of each vertex reaches all its triangles, and no two triangles have the same vertices,
// which would have no normals there.
bool is_manifold(const Mesh& mesh, const Topology& top, std::string* error) {
  std::vector<uint32_t> corners(mesh.P.size(), 0);
  for (const Triangle& t : mesh.triangles)
    for (const uint32_t v : t) ++corners[v];
  Ring ring;
  for (uint32_t v = 0; v < mesh.P.size(); ++v) {
    find_ring(mesh, top, v, &ring);
    if (ring.vertices.size() - (ring.boundary ? 1 : 0) != corners[v])
      *error = fmt::format("several fans of triangles meet at vertex {}", v);
    else if (!ring.boundary && corners[v] == 2)
      *error =
          fmt::format("two triangles have the vertices {}, {} and {}", v, ring.vertices[0], ring.vertices[1]);
    else
      continue;
    return false;
  }
  return true;
}

double beta(size_t valence) {
  return valence == 3 ? 3.0 / 16 : 3.0 / (8 * static_cast<double>(valence));
}

// (1 - n weight) p + weight (sum of the ring), where n is the size of the ring.
glm::dvec3 around(const Mesh& mesh, uint32_t v, const Ring& ring, double weight) {
  glm::dvec3 sum(0);
  for (const uint32_t n : ring.vertices) sum += mesh.P[n];
  return (1 - static_cast<double>(ring.vertices.size()) * weight) * mesh.P[v] + weight * sum;
}

glm::dvec3 along(const Mesh& mesh, uint32_t v, const Ring& ring, double weight) {
  return (1 - 2 * weight) * mesh.P[v] +
         weight * (mesh.P[ring.vertices.front()] + mesh.P[ring.vertices.back()]);
}

glm::dvec3 edge_point(const Mesh& mesh, const Topology& top, uint32_t h) {
  const glm::dvec3 ends = mesh.P[mesh.from(h)] + mesh.P[mesh.to(h)];
  if (top.twin[h] == kNoIndex) return 0.5 * ends;
  return 0.375 * ends + 0.125 * (mesh.P[mesh.to(next(h))] + mesh.P[mesh.to(next(top.twin[h]))]);
}

Mesh refined(const Mesh& mesh, const Topology& top) {
  Mesh out;
  out.P.resize(mesh.P.size());
  Ring ring;
  for (uint32_t v = 0; v < mesh.P.size(); ++v) {
    find_ring(mesh, top, v, &ring);
    out.P[v] = ring.vertices.empty() ? mesh.P[v]
               : ring.boundary       ? along(mesh, v, ring, 1.0 / 8)
                                     : around(mesh, v, ring, beta(ring.vertices.size()));
  }
  std::vector<uint32_t> middle(3 * mesh.triangles.size());
  for (uint32_t h = 0; h < middle.size(); ++h) {
    const uint32_t twin = top.twin[h];
    if (twin < h) {
      middle[h] = middle[twin];
      continue;
    }
    middle[h] = static_cast<uint32_t>(out.P.size());
    out.P.push_back(edge_point(mesh, top, h));
  }
  out.triangles.reserve(4 * mesh.triangles.size());
  for (uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto [a, b, c] = mesh.triangles[t];
    const uint32_t ab = middle[3 * t], bc = middle[3 * t + 1], ca = middle[3 * t + 2];
    out.triangles.insert(out.triangles.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
  }
  return out;
}

// The product of two tangents of the limit surface, one around the ring and one across it. The weights at a
// boundary are pbrt's.
glm::dvec3 limit_normal(const Mesh& limit, uint32_t v, const Ring& ring) {
  const size_t n = ring.vertices.size();
  const auto at = [&](size_t i) { return limit.P[ring.vertices[i]]; };
  glm::dvec3 S(0), T(0);
  if (!ring.boundary) {
    for (size_t i = 0; i < n; ++i) {
      const double a = 2 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(n);
      S += std::cos(a) * at(i);
      T += std::sin(a) * at(i);
    }
    return glm::cross(S, T);
  }
  // The fan runs from the first vertex of the boundary to the last one.
  S = at(n - 1) - at(0);
  const glm::dvec3& p = limit.P[v];
  if (n == 2) {
    T = at(0) + at(1) - 2.0 * p;
  } else if (n == 3) {
    T = at(1) - p;
  } else if (n == 4) {
    T = -at(0) + 2.0 * at(1) + 2.0 * at(2) - at(3) - 2.0 * p;
  } else {
    const double theta = std::numbers::pi / static_cast<double>(n - 1);
    T = std::sin(theta) * (at(0) + at(n - 1));
    for (size_t k = 1; k + 1 < n; ++k)
      T += (2 * std::cos(theta) - 2) * std::sin(static_cast<double>(k) * theta) * at(k);
    T = -T;
  }
  return glm::cross(T, S);
}

TriangleMesh at_limit(const Mesh& mesh, const Topology& top) {
  Mesh limit;
  limit.P.resize(mesh.P.size());
  limit.triangles = mesh.triangles;
  Ring ring;
  for (uint32_t v = 0; v < mesh.P.size(); ++v) {
    find_ring(mesh, top, v, &ring);
    const size_t n = ring.vertices.size();
    limit.P[v] = n == 0          ? mesh.P[v]
                 : ring.boundary ? along(mesh, v, ring, 1.0 / 5)
                                 : around(mesh, v, ring, 1 / (static_cast<double>(n) + 3 / (8 * beta(n))));
  }
  TriangleMesh out;
  out.indices = limit.triangles;
  for (uint32_t v = 0; v < limit.P.size(); ++v) {
    find_ring(mesh, top, v, &ring);
    const glm::dvec3 normal = ring.vertices.empty() ? glm::dvec3(0) : limit_normal(limit, v, ring);
    const double length = glm::length(normal);
    out.P.push_back(Point3(limit.P[v]));
    out.N.push_back(length > 0 ? Normal3(normal / length) : Normal3(0));
  }
  return out;
}

}  // namespace

std::optional<TriangleMesh> subdivide_loop(const TriangleMesh& cage, int levels, std::string* error,
                                           const MemoryRoom& room) {
  const double triangles = std::ldexp(static_cast<double>(cage.indices.size()), 2 * levels);
  if (triangles > double(kMostSubdivided)) {
    *error = fmt::format("{} triangles at {} levels exceed the limit of {} triangles", cage.indices.size(),
                         levels, kMostSubdivided);
    return std::nullopt;
  }
  *error = room.lacks(static_cast<uint64_t>(triangles) * kBytesOfTriangle);
  if (!error->empty()) return std::nullopt;
  Mesh mesh;
  mesh.P.assign(cage.P.begin(), cage.P.end());
  mesh.triangles = cage.indices;
  auto twins = twins_of(mesh, error);
  if (!twins) return std::nullopt;
  Topology top = topology_of(mesh, std::move(*twins));
  if (!is_manifold(mesh, top, error)) return std::nullopt;
  for (int level = 0; level < levels; ++level) {
    mesh = refined(mesh, top);
    top = topology_of(mesh, refined_twins(top.twin));
  }
  return at_limit(mesh, top);
}

}  // namespace kaustik
