// Triangles are cut into pieces no longer than a voxel; pieces in one voxel with nearly the same normal are
// then joined.

#include "photon/estimate/surface_areas.h"

#include <algorithm>
#include <cmath>
#include <compare>
#include <utility>

#include "core/geometry/tessellate.h"
#include "core/geometry/triangle_bounds.h"
#include "core/parallel/parallel.h"
#include "photon/estimate/ball_share.h"
#include "photon/estimate/walls.h"

namespace kaustik::photon {

namespace {

constexpr int kVoxelBits = 21;

// Key by which pieces are joined: voxel, surface group and quantised normal.
struct Place {
  uint64_t voxel = 0;
  uint32_t group = 0, normals = 0;
  auto operator<=>(const Place&) const = default;
};

struct Piece {
  Place place;
  float area;  // m^2
  Point3 p;
  Normal3 n;
};

using Corners = std::array<Point3, 3>;

// A triangle in world space, with its outside.
struct Facet {
  Corners c;
  Normal3 n;
};

// Transforms an instance's triangle to world space as SurfaceInteraction::n is: the outside stays outside
// even if the transform mirrors.
void place(const Transform& to_world, Facet* facet) {
  for (Point3& p : facet->c) p = to_world.point(p);
  facet->n = unit_vector(to_world.normal(facet->n));
}

// Pieces of a full turn about a quadric's axis, of which the side of a voxel holds one, but no fewer than
// keep their normals within four degrees. Meshes have their own triangles, which are not visited here.
int around_of(const Shape& shape, double voxel) {
  constexpr double kCoarseTurn = 48;
  if (shape.mesh()) return kFineTurn;
  const double turn = std::numbers::pi * double(max_component(bounds_of(shape).diagonal()));
  return static_cast<int>(std::clamp(std::ceil(turn / voxel), kCoarseTurn, double(kFineTurn)));
}

void add_facets(const Shape& shape, double voxel, std::vector<Facet>* facets) {
  const TriangleMesh quadric = tessellated(shape, around_of(shape, voxel));
  const auto* const instance = std::get_if<InstancedMesh>(&shape.geometry);
  const TriangleMesh& mesh = shape.mesh() ? *shape.mesh() : quadric;
  facets->reserve(facets->size() + mesh.indices.size());
  for (const auto& triangle : mesh.indices) {
    Facet facet{{mesh.P[triangle[0]], mesh.P[triangle[1]], mesh.P[triangle[2]]}, {}};
    facet.n = triangle_normal(facet.c[1] - facet.c[0], facet.c[2] - facet.c[0]);
    if (facet.n == Normal3(0)) continue;
    facet.n *= outside_of(mesh, triangle, facet.n, shape.flip_normal);
    if (instance) place(instance->to_world, &facet);
    facets->push_back(facet);
  }
}

// What triangles of a group that lie on each other have in common: the corners.
struct Footprint {
  std::array<std::array<float, 3>, 3> corners;  // sorted
  uint32_t index;
  auto operator<=>(const Footprint&) const = default;
};

Footprint footprint_of(const Facet& facet, uint32_t index) {
  Footprint f{{}, index};
  for (size_t i = 0; i < 3; ++i)  // adding zero makes -0 and 0 the same
    f.corners[i] = {facet.c[i].x + 0.0f, facet.c[i].y + 0.0f, facet.c[i].z + 0.0f};
  std::sort(f.corners.begin(), f.corners.end());
  return f;
}

// Drops triangles that lie on an earlier one and face the same way: their surface is there once.
void drop_copies(std::vector<Facet>* facets) {
  std::vector<Footprint> order;
  order.reserve(facets->size());
  for (uint32_t i = 0; i < facets->size(); ++i) order.push_back(footprint_of((*facets)[i], i));
  parallel::sort(order.begin(), order.end());
  std::vector<bool> copy(facets->size());
  for (size_t first = 0, i = 1; i < order.size(); ++i) {
    if (order[first].corners != order[i].corners) first = i;
    for (size_t k = first; k < i && !copy[order[i].index]; ++k)
      copy[order[i].index] = glm::dot((*facets)[order[k].index].n, (*facets)[order[i].index].n) > 0;
  }
  size_t kept = 0;
  for (size_t i = 0; i < facets->size(); ++i)
    if (!copy[i]) (*facets)[kept++] = (*facets)[i];
  facets->resize(kept);
}

// Cuts the triangles of a surface group into pieces.
class Cutter {
 public:
  Cutter(const Bounds3& bounds, float voxel, uint32_t group, std::vector<Piece>* pieces)
      : origin_(bounds.min), voxel_(voxel), group_(group), pieces_(pieces) {}

  void cut(const Facet& facet) {
    n_ = facet.n;
    cut(facet.c);
  }

 private:
  // Cuts the triangle into strips along its shortest side and those into cells, so that needles give few
  // pieces.
  void cut(const Corners& c) {
    size_t k = 0;
    for (size_t i = 1; i < 3; ++i)
      if (side(c, i) < side(c, k)) k = i;
    const glm::dvec3 apex(c[(k + 2) % 3]), q = glm::dvec3(c[k]) - apex, r = glm::dvec3(c[(k + 1) % 3]) - apex;
    const double area = 0.5 * glm::length(glm::cross(q, r)), base = side(c, k);
    const int strips = parts(std::max(glm::length(q), glm::length(r)));
    for (int i = 0; i < strips; ++i) {
      const double t0 = i / double(strips), t1 = (i + 1) / double(strips);
      const double squares = t1 * t1 - t0 * t0, middle = (t1 * t1 * t1 - t0 * t0 * t0) / squares * 2 / 3;
      const int cells = parts(base * t1);
      for (int j = 0; j < cells; ++j)
        add(apex + middle * glm::mix(q, r, (j + 0.5) / cells), area * squares / cells);
    }
  }

  static double side(const Corners& c, size_t i) {
    return glm::length(glm::dvec3(c[(i + 1) % 3]) - glm::dvec3(c[i]));
  }
  int parts(double length) const {
    return static_cast<int>(std::clamp(std::ceil(length / double(voxel_)), 1.0, 1e6));
  }

  void add(const glm::dvec3& p, double area) {
    uint64_t voxel = 0;
    for (int k = 0; k < 3; ++k) {
      const double at = (p[k] - double(origin_[k])) / double(voxel_);
      voxel = voxel << kVoxelBits | static_cast<uint64_t>(std::clamp(at, 0.0, double((1 << kVoxelBits) - 1)));
    }
    pieces_->push_back({{voxel, group_, bin_of(n_)}, float(area), Point3(p), n_});
  }

  // Normals are binned to about four degrees, so that along a tube or fold the pieces at the limit of near
  // normals count or do not count together.
  static uint32_t bin_of(const Normal3& n) { return pack_surface(n, 0) & 0xfcfcu; }

  Point3 origin_;
  float voxel_;
  uint32_t group_;
  std::vector<Piece>* pieces_;
  Normal3 n_{0};
};

// Appends the parts in their order.
template <class Vector>
void append_all(const std::vector<Vector>& parts, Vector* all) {
  std::vector<size_t> begin{all->size()};
  for (const Vector& part : parts) begin.push_back(begin.back() + part.size());
  all->resize(begin.back());
  parallel::for_index(size_t{0}, parts.size(), [&](size_t i) {
    std::copy(parts[i].begin(), parts[i].end(), all->begin() + std::ptrdiff_t(begin[i]));
  });
}

// The pieces sorted by place; pieces of one place keep their order.
std::vector<std::pair<Place, uint32_t>> order_of(const std::vector<Piece>& pieces) {
  std::vector<std::pair<Place, uint32_t>> order(pieces.size());
  parallel::for_index(uint32_t{0}, uint32_t(pieces.size()), [&](uint32_t i) {
    order[i] = {pieces[i].place, i};
  });
  parallel::sort(order.begin(), order.end());
  return order;
}

using Order = std::vector<std::pair<Place, uint32_t>>;

// Joins the pieces of each place to one photon whose flux is their area: the places that begin in this part
// of the order.
void join(const std::vector<Piece>& pieces, const Order& order, size_t begin, size_t last, float unit,
          PhotonRecords* records) {
  while (begin > 0 && begin < last && order[begin].first == order[begin - 1].first) ++begin;
  for (size_t end = begin; begin < last; begin = end) {
    const Place place = order[begin].first;
    double area = 0;
    glm::dvec3 p(0), n(0);
    for (; end < order.size() && order[end].first == place; ++end) {
      const Piece& piece = pieces[order[end].second];
      area += double(piece.area);
      p += double(piece.area) * glm::dvec3(piece.p);
      n += double(piece.area) * glm::dvec3(piece.n);
    }
    if (!(area > 0) || n == glm::dvec3(0)) continue;
    const Normal3 normal(glm::normalize(n));
    records->push_back(pack({Point3(p / area), normal, Rgb(float(area)), normal, place.group}, unit));
  }
}

PhotonBuffer joined(const std::vector<Piece>& pieces, float unit) {
  constexpr size_t kPart = 4096;
  const Order order = order_of(pieces);
  std::vector<PhotonRecords> parts((order.size() + kPart - 1) / kPart);
  parallel::for_index(size_t{0}, parts.size(), [&](size_t i) {
    join(pieces, order, i * kPart, std::min((i + 1) * kPart, order.size()), unit, &parts[i]);
  });
  PhotonBuffer buffer;
  buffer.flux_unit = unit;
  append_all(parts, &buffer.records);
  return buffer;
}

// Cuts the surfaces of the chosen groups into pieces, each group apart.
std::vector<Piece> pieces_of(const Scene& scene, const std::vector<bool>& chosen, float voxel) {
  std::vector<std::vector<uint32_t>> shapes(chosen.size());
  for (uint32_t i = 0; i < scene.shapes.size(); ++i)
    if (chosen[scene.shapes[i].surface_group]) shapes[scene.shapes[i].surface_group].push_back(i);
  std::vector<std::vector<Piece>> of_group(shapes.size());
  parallel::for_index(size_t{0}, shapes.size(), [&](size_t g) {
    std::vector<Facet> facets;
    for (const uint32_t i : shapes[g]) add_facets(scene.shapes[i], double(voxel), &facets);
    drop_copies(&facets);
    Cutter cutter(scene.bounds, voxel, uint32_t(g), &of_group[g]);
    for (const Facet& facet : facets) cutter.cut(facet);
  });
  std::vector<Piece> pieces;
  append_all(of_group, &pieces);
  return pieces;
}

// By surface group, the radius of a ball that is all of the group, negative where its normals point to the
// centre; otherwise zero.
std::vector<float> lone_balls(const Scene& scene, size_t groups) {
  std::vector<float> balls(groups);
  std::vector<bool> seen(groups);
  for (const Shape& shape : scene.shapes) {
    const auto* const sphere = std::get_if<Sphere>(&shape.geometry);
    const double radius = sphere ? sphere->radius().value_or(0) : 0;
    const bool alone = !seen[shape.surface_group];
    balls[shape.surface_group] = alone ? float(shape.flip_normal ? -radius : radius) : 0;
    seen[shape.surface_group] = true;
  }
  return balls;
}

// Chooses the groups that are curved enough to be summed, as long as their pieces fit into kMostPieces. Balls
// take none.
std::vector<bool> curved_groups(const Scene& scene, const std::vector<SurfaceBend>& bends,
                                const std::vector<float>& balls, float radius) {
  const double voxel = double(radius) / SurfaceAreas::kFineness;
  std::vector<double> pieces(bends.size());
  std::vector<bool> curved(bends.size());
  for (const Shape& shape : scene.shapes) {
    pieces[shape.surface_group] += double(triangle_count(shape, around_of(shape, voxel)));
    if (scene.materials[shape.material].lobes().diffuse) curved[shape.surface_group] = true;
  }
  double total = 0;
  for (size_t g = 0; g < bends.size(); ++g) {
    const SurfaceBend& bend = bends[g];
    pieces[g] = balls[g] != 0 ? 0 : pieces[g] + 4 * bend.area / (voxel * voxel);
    curved[g] = curved[g] && bend.oriented && bend.bend * double(radius) > SurfaceAreas::kFlat * bend.area &&
                total + pieces[g] <= double(SurfaceAreas::kMostPieces);
    if (curved[g]) total += pieces[g];
  }
  return curved;
}

}  // namespace

SurfaceAreas::SurfaceAreas(const Scene& scene, const std::vector<SurfaceBend>& bends, float radius)
    : radius_(radius) {
  const float voxel = radius / kFineness;
  if (!(voxel > 0) || !std::isfinite(voxel)) return;
  balls_ = lone_balls(scene, bends.size());
  covered_ = curved_groups(scene, bends, balls_, radius);
  std::vector<bool> in_pieces = covered_;
  for (size_t g = 0; g < balls_.size(); ++g)
    if (balls_[g] != 0) in_pieces[g] = false;
  pieces_ = PhotonMap::build(
      joined(pieces_of(scene, in_pieces, voxel), std::ldexp(1.0f, std::ilogb(voxel * voxel))),
      {scene.bounds});
}

uint64_t SurfaceAreas::most_pieces(const Scene& scene) {
  uint64_t groups = 0, pieces = 0;
  for (const Shape& shape : scene.shapes) groups = std::max(groups, uint64_t{shape.surface_group} + 1);
  const std::vector<float> balls = lone_balls(scene, groups);
  for (const Shape& shape : scene.shapes)
    if (balls[shape.surface_group] == 0 && scene.materials[shape.material].lobes().diffuse)
      pieces += triangle_count(shape);
  return std::min(pieces, kMostPieces);
}

double SurfaceAreas::share(const SurfaceInteraction& si, const KernelSpec& kernel, float radius,
                           const WallCut* cut) const {
  double share = 0;
  if (const float ball = balls_[si.surface_group]; ball != 0) {
    share = share_on_ball(si, ball, kernel, radius, cut);
  } else {
    GatherCounters ignored;
    const GatherQuery query{si.p, si.n, si.surface_group, radius, kAllPhotons};
    share = double((cut ? gather_flux(pieces_, query, kernel, *cut, ignored)
                        : gather_flux(pieces_, query, kernel, ignored))
                       .x);
  }
  return std::clamp(share, kLeastOfCurved, 1.0);
}

}  // namespace kaustik::photon
