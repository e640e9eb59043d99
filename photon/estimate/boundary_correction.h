#pragma once
// How much of a gather disc lies on the surface.
//
// The density estimate sums photons over a disc of radius r as if all of it could receive them. Where the
// surface ends within r it is too small by the share of the kernel's mass on the surface; divided by that
// share it is unbiased for even light again (the cut-and-normalised estimator, Gasser and Mueller 1979;
// Jensen 2001, section 7.2, names the darkening).
//
// In the tangent plane at x, in polar coordinates (rho, theta) about x, the mass behind an edge is that of
// all directions in which the edge is seen, from the edge to the rim of the disc. An edge at distance d of
// its line, from t1 to t2 along the line as counted from the foot of the perpendicular, is met at rho = d /
// cos(theta), t = d tan(theta), so with both in units of r
//
//   M = integral over theta of m(rho),   m(rho) = integral of K(s) s ds from rho to 1
//   constant      2 pi m = 1 - rho^2
//   Epanechnikov  2 pi m = (1 - rho^2)^2
//   cone          2 pi m = (1 - rho^2 - 2/(3k) (1 - rho^3)) / (1 - 2/(3k))
//
// whose integrals follow from those of sec^2, sec^4 and sec^3. Edges that are left from the surface add,
// edges beyond which it begins again (the far side of a hole) subtract: the sum is the mass off the surface
// exactly, for every flat surface (Green's theorem, region by region). Curved surfaces: exact to first order
// in r / curvature.

#include "accel/edge_index.h"
#include "core/geometry/interaction.h"
#include "photon/gather/kernel.h"

namespace kaustik::photon {

// M above: the share of the kernel's mass behind a straight edge. All in units of the radius: d >= 0 from the
// centre to the edge's line, t1 <= t2 along it from the foot. In [0, 1/2]; zero for d >= 1.
double mass_behind_edge(const KernelSpec& kernel, double d, double t1, double t2);

// No less of the disc is ever taken to be there: about a corner of 23 degrees. Thinner slivers stay too dark.
inline constexpr double kLeastShare = 1.0 / 16;

// Outlines of more edges within a disc are finer than what it resolves: no correction.
inline constexpr size_t kMaxEdgesInReach = 512;

// Share of the kernel's mass on si's surface, in [kLeastShare, 1]: what photon sums at si over a disc of
// `radius` metres must be divided by. An edge counts where photons in front of it count at si and those
// behind do not (kNormalCosine). Facets of the opposite orientation count only when they lie in si's plane:
// winding is arbitrary there, while a closed body has its far side elsewhere. Thread-safe.
double surface_share(const accel::EdgeIndex& edges, const SurfaceInteraction& si, const KernelSpec& kernel,
                     float radius);

}  // namespace kaustik::photon
