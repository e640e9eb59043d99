// Rims of disks and other quadrics as polygons.

#include "core/geometry/rims.h"

#include <cmath>

#include "core/geometry/analytic/quadric_bounds.h"

namespace kaustik {
namespace {

constexpr int kSides = 64;  // per full turn

// Adds a polygon around the disk's outer rim, or inside its inner one, so that no point of the disk lies
// beyond its edges.
void add_rim(const Disk& disk, const Shape& shape, bool outer, std::vector<BoundaryEdge>* edges) {
  const double step = 2 * std::numbers::pi / kSides;
  const double radius = outer ? 1 / std::cos(0.5 * step) : double(disk.inner);
  const auto corner = [&](int i) {
    const double phi = step * (i % kSides);
    return disk.to_world.point(Point3(radius * std::cos(phi), radius * std::sin(phi), 0));
  };
  const Normal3 n = shape.flip_normal ? -disk_normal(disk.to_world) : disk_normal(disk.to_world);
  const Point3 center = disk.to_world.point(Point3(0));
  for (int i = 0; i < kSides; ++i) {
    BoundaryEdge edge = make_edge(corner(i), corner(i + 1), center, n, shape.surface_group);
    if (!(edge.height > 0)) continue;
    if (!outer) {
      edge.outward = -edge.outward;
      edge.height *= (1 - disk.inner) / disk.inner;
    } else {
      edge.height *= 1 - disk.inner;
    }
    edges->push_back(edge);
  }
}

// Coordinates of a point on a quadric, as for point_at().
struct Place {
  double s, phi;
};

// One rim of a quadric from begin to end; the surface lies on the side of `inward`.
struct Rim {
  Place begin, end, inward;
  int sides;
};

template <SweptShape S>
std::vector<Rim> rims_of(const S& q) {
  std::vector<Rim> rims;
  const double turn = q.turn();
  const int around = std::max(1, static_cast<int>(std::ceil(kSides * turn / (2 * std::numbers::pi))));
  if (q.has_rim(0)) rims.push_back({{0, 0}, {0, turn}, {1, 0}, around});
  if (q.has_rim(1)) rims.push_back({{1, 0}, {1, turn}, {-1, 0}, around});
  if (turn >= double(2 * kPi)) return rims;
  const int up = q.strips(kSides);
  rims.push_back({{0, 0}, {1, 0}, {0, 1}, up});
  rims.push_back({{0, turn}, {1, turn}, {0, -1}, up});
  return rims;
}

template <SweptShape S>
void add_rim(const S& q, const Rim& rim, const Shape& shape, std::vector<BoundaryEdge>* edges) {
  constexpr double kStep = 1e-4;  // of s, or radians: a small step to find the direction of the surface
  const auto place = [&](double t) {
    return Place{rim.begin.s + t * (rim.end.s - rim.begin.s),
                 rim.begin.phi + t * (rim.end.phi - rim.begin.phi)};
  };
  const auto world = [&](const glm::dvec3& p) { return q.to_world.point(Point3(p)); };
  for (int i = 0; i < rim.sides; ++i) {
    const Place a = place(i / double(rim.sides)), b = place((i + 1) / double(rim.sides));
    // Use the middle of the side: at its ends, parts of a sphere may meet in a pole.
    const Place m = place((i + 0.5) / rim.sides);
    const glm::dvec3 middle = q.point_at(m.s, m.phi);
    const glm::dvec3 in = q.point_at(m.s + kStep * rim.inward.s, m.phi + kStep * rim.inward.phi) - middle;
    const Point3 inner = world(middle + in / kStep * (rim.inward.s != 0 ? 1.0 : std::min(1.0, q.turn())));
    const Normal3 n = unit_vector(q.to_world.normal(Normal3(q.normal_at(middle))));
    const BoundaryEdge edge = make_edge(world(q.point_at(a.s, a.phi)), world(q.point_at(b.s, b.phi)), inner,
                                        shape.flip_normal ? -n : n, shape.surface_group);
    if (edge.height > 0) edges->push_back(edge);
  }
}

}  // namespace

BoundaryEdge make_edge(const Point3& a, const Point3& b, const Point3& c, const Normal3& n, uint32_t group) {
  const glm::dvec3 along = glm::normalize(glm::dvec3(b) - glm::dvec3(a));
  const glm::dvec3 to_c = glm::dvec3(c) - glm::dvec3(a);
  const glm::dvec3 inward = to_c - glm::dot(to_c, along) * along;
  const double height = glm::length(inward);
  return {a, b, n, Normal3(0), Vector3(-inward / height), float(height), group};
}

void add_rims(const Shape& shape, std::vector<BoundaryEdge>* edges) {
  if (const auto* disk = std::get_if<Disk>(&shape.geometry)) {
    add_rim(*disk, shape, true, edges);
    if (disk->inner > 0) add_rim(*disk, shape, false, edges);
  } else if (const auto swept = swept_of(shape)) {
    std::visit(
        [&](const auto& s) {
          for (const Rim& rim : rims_of(s)) add_rim(s, rim, shape, edges);
        },
        *swept);
  }
}

}  // namespace kaustik
