// Works in two stages to keep memory low: smooth edges inside one mesh are matched by vertex index, and the
// remaining ones by position over all meshes of a surface group.

#include "core/geometry/boundary_edges.h"

#include <algorithm>
#include <bit>
#include <map>
#include <numbers>
#include <numeric>
#include <span>
#include <tuple>

#include "core/geometry/point_bits.h"
#include "core/geometry/rims.h"
#include "core/geometry/triangle_bounds.h"
#include "core/parallel/parallel.h"

namespace kaustik {
namespace {

Point3 point_of(const PointBits& bits) {
  return {std::bit_cast<float>(bits[0]), std::bit_cast<float>(bits[1]), std::bit_cast<float>(bits[2])};
}

// A side of triangle corner / 3, from its vertex corner % 3 to the next one.
struct MeshSide {
  uint64_t vertices;  // welded vertex indices, the lower one first
  uint32_t corner;
  bool forward;  // the winding runs from the lower vertex to the higher one
};

// A side that must be compared with other meshes.
struct OpenSide {
  std::array<PointBits, 2> ends;  // sorted
  uint32_t shape, corner;
};

// For each vertex, the first vertex at the same position.
std::vector<uint32_t> weld(const std::vector<Point3>& P) {
  std::vector<uint32_t> order(P.size()), welded(P.size());
  std::iota(order.begin(), order.end(), 0u);
  parallel::sort(order.begin(), order.end(), [&](uint32_t i, uint32_t j) {
    const PointBits a = bits_of(P[i]), b = bits_of(P[j]);
    return a != b ? a < b : i < j;
  });
  for (size_t i = 0; i < order.size(); ++i) {
    const bool same = i > 0 && bits_of(P[order[i]]) == bits_of(P[order[i - 1]]);
    welded[order[i]] = same ? welded[order[i - 1]] : order[i];
  }
  return welded;
}

std::vector<MeshSide> sides_of(const TriangleMesh& mesh) {
  const std::vector<uint32_t> welded = weld(mesh.P);
  std::vector<MeshSide> sides;
  sides.reserve(mesh.indices.size() * 3);
  for (uint32_t t = 0; t < mesh.indices.size(); ++t) {
    if (winding_normal(mesh, t) == Normal3(0)) continue;
    for (uint32_t k = 0; k < 3; ++k) {
      const uint32_t from = welded[mesh.indices[t][k]], to = welded[mesh.indices[t][(k + 1) % 3]];
      if (from == to) continue;
      sides.push_back({uint64_t{std::min(from, to)} << 32 | std::max(from, to), 3 * t + k, from < to});
    }
  }
  parallel::sort(sides.begin(), sides.end(), [](const MeshSide& a, const MeshSide& b) {
    return a.vertices != b.vertices ? a.vertices < b.vertices : a.corner < b.corner;
  });
  return sides;
}

std::pair<Point3, Point3> ends_of(const TriangleMesh& mesh, const MeshSide& side) {
  return {mesh.P[side.vertices >> 32], mesh.P[side.vertices & 0xffffffffu]};
}

// How two triangles meet at their common side.
struct Bend {
  bool smooth = false;
  bool oriented = true;
  double angle = 0;  // radians
};

Bend bend_of(const TriangleMesh& mesh, const MeshSide& a, const MeshSide& b) {
  const Normal3 na = winding_normal(mesh, a.corner / 3), nb = winding_normal(mesh, b.corner / 3);
  // If windings agree, they run along the common side in opposite directions.
  const Normal3 turned = a.forward != b.forward ? nb : -nb;
  if (!(glm::dot(na, turned) > kBendCosine)) return {};
  const bool oriented = outside_of(mesh, mesh.indices[a.corner / 3], na, false) *
                            outside_of(mesh, mesh.indices[b.corner / 3], nb, false) *
                            (a.forward != b.forward ? 1.0f : -1.0f) >
                        0;
  return {true, oriented, 2 * std::asin(std::min(0.5 * double(glm::length(na - turned)), 1.0))};
}

// The number of different triangles among these sides, up to three, with the first of each in front.
size_t distinct_triangles(const TriangleMesh& mesh, std::span<const MeshSide> sides, MeshSide (&first)[2]) {
  const auto third = [&](const MeshSide& side) {
    return bits_of(mesh.P[mesh.indices[side.corner / 3][(side.corner + 2) % 3]]);
  };
  size_t count = 0;
  for (const MeshSide& side : sides) {
    bool known = false;
    for (size_t i = 0; i < count; ++i) known = known || third(first[i]) == third(side);
    if (known) continue;
    if (count == std::size(first)) return count + 1;
    first[count++] = side;
  }
  return count;
}

void add_open_sides(const TriangleMesh& mesh, uint32_t shape, std::vector<OpenSide>* open,
                    SurfaceBend* bends) {
  const std::vector<MeshSide> sides = sides_of(mesh);
  for (size_t begin = 0, end = 0; begin < sides.size(); begin = end) {
    while (end < sides.size() && sides[end].vertices == sides[begin].vertices) ++end;
    const std::span<const MeshSide> joint(&sides[begin], end - begin);
    MeshSide pair[2];
    if (joint.size() > 1 && distinct_triangles(mesh, joint, pair) == 2) {
      const Bend bend = bend_of(mesh, pair[0], pair[1]);
      const auto [low, high] = ends_of(mesh, joint[0]);
      bends->oriented = bends->oriented && bend.oriented;
      // Where triangles lie on each other, their areas are added, too.
      bends->bend += double(joint.size()) / 2 * bend.angle * glm::length(glm::dvec3(high) - glm::dvec3(low));
      if (bend.smooth) continue;
    }
    for (size_t i = begin; i < end; ++i) {
      const auto [low, high] = ends_of(mesh, sides[i]);
      std::array<PointBits, 2> ends = {bits_of(low), bits_of(high)};
      std::sort(ends.begin(), ends.end());
      open->push_back({ends, shape, sides[i].corner});
    }
  }
}

// All sides that meet at one edge, over all meshes.
class Joint {
 public:
  Joint(const std::vector<Shape>& shapes, std::span<const OpenSide> sides)
      : group_(shapes[sides[0].shape].surface_group) {
    for (const OpenSide& side : sides) {
      const auto& mesh = std::get<TriangleMesh>(shapes[side.shape].geometry);
      const uint32_t t = side.corner / 3, k = side.corner % 3;
      Facet facet;
      facet.n = winding_normal(mesh, t);
      facet.orientation = outside_of(mesh, mesh.indices[t], facet.n, shapes[side.shape].flip_normal);
      facet.forward = bits_of(mesh.P[mesh.indices[t][k]]) == side.ends[0];
      facet.third = mesh.P[mesh.indices[t][(k + 2) % 3]];
      facet.side = &side;
      add(facet);
    }
  }

  void add_edges(std::vector<BoundaryEdge>* edges) const {
    for (size_t i = 0; i < facets_.size(); ++i) {
      const size_t j = partner(i);
      if (j != i && glm::dot(facets_[i].n, turned(i, j)) > kBendCosine) continue;
      const Facet& facet = facets_[i];
      const OpenSide& side = *facet.side;
      BoundaryEdge edge = make_edge(point_of(side.ends[0]), point_of(side.ends[1]), facet.third,
                                    facet.orientation * facet.n, group_);
      if (!(edge.height > 0)) continue;
      edge.both_sides = facet.both_sides;
      // If the partner continues in a third facet, this facet simply ends here.
      if (j != i && partner(j) == i) edge.beyond = facet.orientation * turned(i, j);
      edges->push_back(edge);
    }
  }

 private:
  struct Facet {
    Normal3 n;  // of the winding
    float orientation;
    bool forward;
    Point3 third;
    const OpenSide* side;
    bool both_sides = false;
  };
  // Facets that fold back by this cosine (two and a half degrees) lie on each other.
  static constexpr float kCoincident = -0.999f;

  // A facet that lies on one that is there already neither continues it nor ends a second time.
  void add(const Facet& facet) {
    for (Facet& other : facets_) {
      if (!(glm::dot(other.n, turned(other, facet)) < kCoincident)) continue;
      other.both_sides |= glm::dot(other.orientation * other.n, facet.orientation * facet.n) < 0;
      return;
    }
    facets_.push_back(facet);
  }
  // The winding normal of b, oriented to the side of a's.
  static Normal3 turned(const Facet& a, const Facet& b) { return a.forward != b.forward ? b.n : -b.n; }
  Normal3 turned(size_t i, size_t j) const { return turned(facets_[i], facets_[j]); }
  // The other facet that bends least from i; i itself if there is no other.
  size_t partner(size_t i) const {
    size_t best = i;
    float best_cosine = -kInfinity;
    for (size_t j = 0; j < facets_.size(); ++j) {
      const float cosine = glm::dot(facets_[i].n, turned(i, j));
      if (j == i || cosine <= best_cosine) continue;
      best = j;
      best_cosine = cosine;
    }
    return best;
  }

  uint32_t group_;
  std::vector<Facet> facets_;
};

// Edges of more triangles are skipped: they are no part of a proper surface, and matching takes cubic time.
constexpr size_t kMaxSidesOfJoint = 64;

// Adds the edges of the meshes of one surface group, and how much they bend apart from them.
void add_group_edges(const std::vector<Shape>& shapes, std::span<const uint32_t> meshes,
                     std::vector<BoundaryEdge>* edges, SurfaceBend* bends) {
  std::vector<OpenSide> open;
  for (const uint32_t i : meshes) add_open_sides(std::get<TriangleMesh>(shapes[i].geometry), i, &open, bends);
  const auto key = [](const OpenSide& s) { return std::tie(s.ends, s.shape, s.corner); };
  parallel::sort(open.begin(), open.end(),
                 [&](const OpenSide& a, const OpenSide& b) { return key(a) < key(b); });
  for (size_t begin = 0, end = 0; begin < open.size(); begin = end) {
    while (end < open.size() && open[end].ends == open[begin].ends) ++end;
    if (end - begin <= kMaxSidesOfJoint)
      Joint(shapes, std::span(open).subspan(begin, end - begin)).add_edges(edges);
  }
}

// Surface groups share no edges, so that each is done apart.
void add_mesh_edges(const std::vector<Shape>& shapes, std::vector<BoundaryEdge>* edges,
                    std::vector<SurfaceBend>* bends) {
  std::vector<std::vector<uint32_t>> meshes(bends->size());
  for (uint32_t i = 0; i < shapes.size(); ++i)
    if (std::holds_alternative<TriangleMesh>(shapes[i].geometry))
      meshes[shapes[i].surface_group].push_back(i);
  std::vector<std::vector<BoundaryEdge>> of_group(meshes.size());
  parallel::for_index(size_t{0}, meshes.size(),
                      [&](size_t g) { add_group_edges(shapes, meshes[g], &of_group[g], &(*bends)[g]); });
  size_t count = edges->size();
  for (const auto& some : of_group) count += some.size();
  edges->reserve(count);
  for (auto& some : of_group) {
    edges->insert(edges->end(), some.begin(), some.end());
    some = {};
  }
}

// Edges of an instanced mesh in its own space.
struct OwnEdges {
  std::vector<BoundaryEdge> edges;
  std::vector<SurfaceBend> bends{1};
  uint64_t instances = 0;
};

void find_own_edges(const InstancedMesh& instance, bool flip_normal, OwnEdges* own) {
  std::vector<Shape> alone(1);
  alone[0].geometry = *instance.mesh;
  alone[0].flip_normal = flip_normal;
  own->bends[0].area = surface_area(alone[0]);
  add_mesh_edges(alone, &own->edges, &own->bends);
}

void add_placed(const OwnEdges& own, const Transform& t, uint32_t group, std::vector<BoundaryEdge>* edges) {
  for (const BoundaryEdge& e : own.edges) {
    const Point3 inner = 0.5f * (e.a + e.b) - e.height * e.outward;
    BoundaryEdge placed =
        make_edge(t.point(e.a), t.point(e.b), t.point(inner), unit_vector(t.normal(e.n)), group);
    if (!(placed.height > 0)) continue;
    if (e.beyond != Normal3(0)) placed.beyond = unit_vector(t.normal(e.beyond));
    placed.both_sides = e.both_sides;
    edges->push_back(placed);
  }
}

void add_instance_edges(const std::vector<Shape>& shapes, std::vector<BoundaryEdge>* edges,
                        std::vector<SurfaceBend>* bends) {
  std::map<std::pair<const TriangleMesh*, bool>, OwnEdges> own;
  const auto for_each_instance = [&](const auto& fn) {
    for (const Shape& shape : shapes)
      if (const auto* instance = std::get_if<InstancedMesh>(&shape.geometry))
        fn(shape, *instance, own[{instance->mesh.get(), shape.flip_normal}]);
  };
  for_each_instance([](const Shape& shape, const InstancedMesh& instance, OwnEdges& found) {
    if (found.instances++ == 0) find_own_edges(instance, shape.flip_normal, &found);
  });
  for_each_instance([&](const Shape& shape, const InstancedMesh& instance, const OwnEdges& found) {
    SurfaceBend& bend = (*bends)[shape.surface_group];
    bend.oriented = bend.oriented && found.bends[0].oriented;
    const double scale = std::cbrt(std::abs(glm::determinant(glm::dmat3(instance.to_world.linear))));
    bend.bend += found.bends[0].bend * scale;
    bend.area += found.bends[0].area * scale * scale;
    if (found.edges.size() * found.instances <= kMostInstanceEdges)
      add_placed(found, instance.to_world, shape.surface_group, edges);
  });
}

double bend_of_analytic(const Shape& shape) {
  const auto swept = swept_of(shape);
  if (!swept) return 0;
  return std::visit([&](const auto& s) { return s.bend(surface_area(shape)); }, *swept);
}

}  // namespace

void sort_by_group(std::vector<BoundaryEdge>* edges) {
  const auto in_order = [](const BoundaryEdge& a, const BoundaryEdge& b) {
    return a.surface_group < b.surface_group;
  };
  if (!std::is_sorted(edges->begin(), edges->end(), in_order))
    std::stable_sort(edges->begin(), edges->end(), in_order);
}

std::vector<BoundaryEdge> find_boundary_edges(const std::vector<Shape>& shapes,
                                              std::vector<SurfaceBend>* bends) {
  std::vector<BoundaryEdge> edges;
  uint32_t groups = 0;
  for (const Shape& shape : shapes) groups = std::max(groups, shape.surface_group + 1);
  std::vector<SurfaceBend> found(groups);
  for (const Shape& shape : shapes) {
    if (std::holds_alternative<InstancedMesh>(shape.geometry)) continue;
    found[shape.surface_group].area += surface_area(shape);
    found[shape.surface_group].bend += bend_of_analytic(shape);
  }
  add_mesh_edges(shapes, &edges, &found);
  add_instance_edges(shapes, &edges, &found);
  for (const Shape& shape : shapes) add_rims(shape, &edges);
  if (bends) *bends = std::move(found);
  return edges;
}

}  // namespace kaustik
