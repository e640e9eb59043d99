// Feet of walls in the tangent plane of a gather.

#include "photon/estimate/walls.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "photon/estimate/boundary_correction.h"

namespace kaustik::photon {
namespace {

using Fan = LineFan<WallCut::kMostFeet>;

struct Direction {
  glm::dvec2 d;
  int sector;
};

const std::array<Direction, WallCut::kDirections>& directions() {
  static const auto all = [] {
    std::array<Direction, WallCut::kDirections> d;
    for (size_t i = 0; i < d.size(); ++i) {
      const double theta = 2 * std::numbers::pi * (double(i) + 0.5) / double(d.size());
      d[i].d = {std::cos(theta), std::sin(theta)};
      d[i].sector = Fan::sector_of(d[i].d);
    }
    return d;
  }();
  return all;
}

// Distance along the unit direction at which it meets the line; infinite where it does not.
double distance_to(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& direction) {
  const double left = cross(direction, a), right = cross(direction, b);
  if (left * right > 0 || left == right) return HUGE_VAL;
  const glm::dvec2 p = glm::mix(a, b, left / (left - right));
  const double t = glm::dot(p, direction);
  return t > 0 ? t : HUGE_VAL;
}

}  // namespace

Walls::Walls(std::vector<BoundaryEdge> feet, const Bounds3& bounds, float radius)
    : feet_(std::move(feet)), radius_(radius), origin_(bounds.min), marks_(kCells * kCells) {
  const Vector3 extent = bounds.diagonal();
  for (int k = 0; k < 3; ++k) {
    const float cell = std::max(extent[k] / float(kCells), radius / 2);
    cells_per_metre_[k] = cell > 0 ? 1 / cell : 0;
  }
  for (uint32_t i = 0; i < feet_.size(); ++i) mark(feet_[i]);
}

// Marks boxes around points of the foot that are no farther apart than the radius.
void Walls::mark(const BoundaryEdge& foot) {
  const float length = glm::distance(foot.a, foot.b);
  const int steps = static_cast<int>(std::clamp(std::ceil(length / radius_), 1.0f, 1e6f));
  // Half a step, with room for rounding.
  const float reach = 1.0001f * (radius_ + length / float(2 * steps));
  for (int i = 0; i <= steps; ++i) {
    const Point3 p = glm::mix(foot.a, foot.b, float(i) / float(steps)), low = p - reach, high = p + reach;
    // The cells along z are the bits of one word.
    const uint64_t row = ~uint64_t{0} >> (63 - cell_of(high, 2)) & ~uint64_t{0} << cell_of(low, 2);
    const uint32_t x_end = cell_of(high, 0), y_end = cell_of(high, 1);
    for (uint32_t x = cell_of(low, 0); x <= x_end; ++x)
      for (uint32_t y = cell_of(low, 1); y <= y_end; ++y) marks_[x * kCells + y] |= row;
  }
}

WallCut::WallCut(const Walls& walls, const SurfaceInteraction& si, const Vector3& wo, const Normal3& n,
                 float radius)
    : frame_(Frame::from_z(si.n)), step_(4 * double(si.p_error)) {
  x_ = glm::dvec3(si.p) + step_ * glm::dvec3(wo);
  std::array<uint32_t, kMostFeet> found;
  const size_t count = walls.feet().find(si.p, radius, si.surface_group, found);
  if (count > found.size()) return;
  for (size_t i = 0; i < count; ++i) {
    const BoundaryEdge& foot = walls.feet()[found[i]];
    const float side = glm::dot(foot.n, n);
    if (std::abs(side) < kNormalCosine || (side < 0 && !foot.both_sides)) continue;
    feet_.push_back(line_of(foot));
    fan_.add(feet_.size() - 1, feet_.back().a, feet_.back().b);
  }
}

WallCut::Line WallCut::line_of(const BoundaryEdge& edge) const {
  return {flat(glm::dvec3(edge.a) - x_), flat(glm::dvec3(edge.b) - x_)};
}

bool WallCut::hides(const Point3& p, const Vector3& w) const {
  const glm::dvec2 y = flat(glm::dvec3(p) + step_ * glm::dvec3(w) - x_);
  return fan_.any_in(Fan::sector_of(y), [&](size_t i) {
    const Line& foot = feet_[i];
    // The foot's ends count as part of it, so that nothing passes between two feet that meet.
    if (cross(y, foot.a) * cross(y, foot.b) > 0) return false;
    const glm::dvec2 along = foot.b - foot.a;
    return cross(along, -foot.a) * cross(along, y - foot.a) < 0;
  });
}

double WallCut::share(const SurfaceInteraction& si, const KernelSpec& kernel, const accel::EdgeIndex& ends,
                      float radius) const {
  std::array<uint32_t, kMaxEdgesInReach> found;
  const size_t count = ends.find(si.p, radius, si.surface_group, found);
  struct End {
    Line line;
    double sign;
  };
  std::vector<End> outline;
  LineFan<kMaxEdgesInReach> outline_fan;
  for (size_t i = 0; i < count && count <= found.size(); ++i)
    if (const int sign = sign_of_edge(ends[found[i]], si, radius)) {
      const Line line = line_of(ends[found[i]]);
      outline_fan.add(outline.size(), line.a, line.b);
      outline.push_back({line, double(sign)});
    }
  const MassWithin mass_within(kernel);
  const double rim = double(radius), per_radius = 1 / rim;
  double sum = 0;
  for (const Direction& direction : directions()) {
    double wall = rim;
    fan_.any_in(direction.sector, [&](size_t i) {
      wall = std::min(wall, distance_to(feet_[i].a, feet_[i].b, direction.d));
      return false;
    });
    const double within = wall < rim ? mass_within(wall * per_radius) : 1;
    sum += within;
    outline_fan.any_in(direction.sector, [&](size_t i) {
      const End& end = outline[i];
      if (const double t = distance_to(end.line.a, end.line.b, direction.d); t < wall)
        sum -= end.sign * (within - mass_within(t * per_radius));
      return false;
    });
  }
  return std::clamp(sum / double(directions().size()), 0.0, 1.0);
}

Rgb gather_flux(const PhotonMap& map, const GatherQuery& query, const KernelSpec& kernel, const WallCut& cut,
                GatherCounters& counters) {
  const KernelTerms terms = kernel_terms(kernel, query.radius);
  glm::dvec3 sum(0);
  for_each_photon(
      map, query,
      [&](const Photon& photon, float distance_squared) {
        if (cut.hides(photon.p, photon.wi))
          --counters.accepted;
        else
          sum += glm::dvec3(photon.flux) * double(kernel_value(kernel.type, terms, distance_squared));
      },
      counters);
  return Rgb(sum);
}

}  // namespace kaustik::photon
