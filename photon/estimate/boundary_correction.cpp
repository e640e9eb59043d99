// Closed-form integrals of the kernels beyond straight edges, summed over the edges near a point.

#include "photon/estimate/boundary_correction.h"

#include <array>
#include <cmath>
#include <numbers>
#include <optional>

#include "photon/record/packing.h"

namespace kaustik::photon {

namespace {

constexpr double kTwoPi = 2 * std::numbers::pi;

// A point counts as lying in si's plane up to this height, as a fraction of the radius.
constexpr double kInPlane = 1e-3;

// Surfaces closer than this share of the radius are not told apart.
constexpr double kSheets = 1.0 / 256;

// Cosine of the bend from which on a surface with an open edge is taken for a bevel: 20 degrees.
constexpr float kBevel = 0.94f;

// How often the radius is halved where too many edges are in reach.
constexpr int kMostHalvings = 2;

// A facet of the opposite orientation lies in si's plane if the normals differ by at most eight degrees: the
// two faces of a sharp wedge do not.
constexpr float kParallel = 0.99f;

// Integral over theta from 0 to atan(t / d) of rho^power, rho = d sec(theta), by the recurrence for powers of
// the secant.
double integral_of_rho(int power, double d, double t) {
  if (power == 0) return std::atan2(t, d);
  const bool odd = power % 2 != 0;
  const double rho_squared = t * t + d * d;
  double integral = odd && d > 0 ? d * std::asinh(t / d) : 0;
  double rho = odd ? std::sqrt(rho_squared) : 1;  // to the power of n - 2
  for (int n = odd ? 3 : 2; n <= power; n += 2) {
    integral = (d * t * rho + (n - 2) * (d * d * integral)) / (n - 1);
    rho *= rho_squared;
  }
  return integral;
}

// Mean of value(j + 2), weighted by the terms m_j of the kernel's mass: see the header.
template <class Value>
double mass_of(const KernelSpec& kernel, const Value& value) {
  const auto terms = mass_terms<double>(kernel);
  double mass = 0, sum = 0;
  for (size_t j = 0; j < terms.size(); ++j) {
    if (terms[j] == 0) continue;
    mass += terms[j] * value(int(j) + 2);
    sum += terms[j];
  }
  return mass / sum;
}

// The kernel's mass on a plane at height h (in radii) above the centre, where photons count by their distance
// to the centre.
double mass_at_height(const KernelSpec& kernel, double h) {
  return mass_of(kernel, [h](int power) { return 1 - (power == 2 ? h * h : std::pow(h, power)); });
}

bool counts(const Normal3& facet, const Normal3& n) {
  return glm::dot(facet, n) > kNormalCosine;
}
bool ends_here(const BoundaryEdge& edge, const Normal3& n) {
  return counts(edge.n, n) && !counts(edge.beyond, n);
}

// How an edge lies to a disc. Lengths in metres but for the height.
struct EdgeView {
  double height;    // above the tangent plane, in radii
  bool leaves;      // whether the surface leaves there or begins again
  double distance;  // in the tangent plane, from the centre to the edge's line
  double t1, t2;    // the edge's extent along the line, from the foot of the perpendicular
};

// Whether the surface that ends at an edge's point q, relative to si, with the normal n there, passes above
// or below si: both sides of a thin shell end at its rim, but no photon reaches the inner one. A surface that
// bends evenly between si and q leaves the chord between them by half of the bend at both ends, and one that
// bends at one of them, as at a bevel, by up to all of it. The latter is allowed for where the edge is a
// crease or the bend is large, since the rims of shells are open. kSheets allows for rounding.
bool is_other_sheet(const BoundaryEdge& edge, const glm::dvec3& q, const Normal3& n,
                    const SurfaceInteraction& si, double radius) {
  const glm::dvec3 here(si.n), there(n), middle = here + there;
  const bool bevel = edge.beyond != Normal3(0) || glm::dot(si.n, n) < kBevel;
  const double apart = std::abs(glm::dot(q, middle)) / glm::length(middle);
  return apart > kSheets * radius + glm::length(q) * glm::length(here - there) / (bevel ? 2 : 8);
}

// Nothing if the edge is no end of si's surface.
std::optional<EdgeView> view_of(const BoundaryEdge& edge, const SurfaceInteraction& si, double radius) {
  const bool behind = ends_here(edge, -si.n),
             same_side = ends_here(edge, si.n) || (edge.both_sides && behind);
  if (!same_side && !(behind && glm::dot(edge.n, si.n) < -kParallel)) return std::nullopt;
  const glm::dvec3 n(si.n), a = glm::dvec3(edge.a) - glm::dvec3(si.p);
  const glm::dvec3 along = glm::dvec3(edge.b) - glm::dvec3(edge.a);
  const double nearest = std::clamp(-glm::dot(a, along) / glm::dot(along, along), 0.0, 1.0);
  const glm::dvec3 q = a + nearest * along;
  const double height = std::abs(glm::dot(q, n)) / radius;
  if (height >= 1 || (!same_side && height > kInPlane)) return std::nullopt;
  const glm::dvec3 flat_along = along - glm::dot(along, n) * n;
  const double length = glm::length(flat_along);
  if (!(length > 0)) return std::nullopt;
  const glm::dvec3 u = flat_along / length;
  const double t1 = glm::dot(a, u);
  const glm::dvec3 foot = a - glm::dot(a, n) * n - t1 * u;
  // si itself lies on the surface: if it is beyond an edge by no more than rounding, it counts as in front of
  // it.
  const bool leaves = glm::dot(foot, glm::dvec3(edge.outward)) >= -2 * double(si.p_error);
  if (leaves && same_side && is_other_sheet(edge, q, behind ? -edge.n : edge.n, si, radius))
    return std::nullopt;
  return EdgeView{height, leaves, glm::length(foot), t1, t1 + length};
}

// The kernel's mass that this edge cuts off: positive where the surface ends, negative where it begins again.
double missing_mass(const BoundaryEdge& edge, const SurfaceInteraction& si, const KernelSpec& kernel,
                    double radius) {
  const auto view = view_of(edge, si, radius);
  if (!view) return 0;
  // Inverse radius of the disc at that height.
  const double unit = 1 / (radius * std::sqrt(1 - view->height * view->height));
  const double mass = mass_behind_edge(kernel, view->distance * unit, view->t1 * unit, view->t2 * unit);
  return (view->leaves ? 1 : -1) * mass_at_height(kernel, view->height) * mass;
}

}  // namespace

double mass_behind_edge(const KernelSpec& kernel, double d, double t1, double t2) {
  if (!(d < 1)) return 0;
  const double rim = std::sqrt(1 - d * d);
  t1 = std::max(t1, -rim);
  t2 = std::min(t2, rim);
  if (!(t1 < t2)) return 0;
  const auto over = [&](int power) { return integral_of_rho(power, d, t2) - integral_of_rho(power, d, t1); };
  const double angle = over(0);
  return mass_of(kernel, [&](int power) { return angle - over(power); }) / kTwoPi;
}

int sign_of_edge(const BoundaryEdge& edge, const SurfaceInteraction& si, float radius) {
  const auto view = view_of(edge, si, double(radius));
  return !view ? 0 : view->leaves ? 1 : -1;
}

double surface_share(const accel::EdgeIndex& edges, const SurfaceInteraction& si, const KernelSpec& kernel,
                     float radius) {
  if (!(radius > 0) || !std::isfinite(radius)) return 1;
  std::array<uint32_t, kMaxEdgesInReach> found;
  size_t count = edges.find(si.p, radius, si.surface_group, found);
  for (int halved = 0; count > found.size(); ++halved) {
    if (halved == kMostHalvings) return 1;
    radius /= 2;
    count = edges.find(si.p, radius, si.surface_group, found);
  }
  double missing = 0;
  for (size_t i = 0; i < count; ++i) missing += missing_mass(edges[found[i]], si, kernel, double(radius));
  return std::clamp(1 - missing, kLeastShare, 1.0);
}

}  // namespace kaustik::photon
