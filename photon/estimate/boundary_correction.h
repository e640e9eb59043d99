#pragma once
// The share of a gather disc that lies on the surface, where the surface has edges.
//
// The density estimate sums photons over a disc of radius r as if all of it could receive photons. Where the
// surface ends within r, the estimate is too small by the share of the kernel's mass that lies on the
// surface; divided by that share, it is unbiased for even light again (the cut-and-normalised estimator,
// Gasser and Mueller 1979; Jensen 2001, section 7.2, mentions the darkening).
//
// In the tangent plane at x, in polar coordinates (rho, theta) about x, the mass behind an edge is that of
// all directions in which the edge is seen, from the edge to the rim of the disc. Let d be the distance of
// the edge's line, and t1 to t2 the edge's extent along the line, counted from the foot of the perpendicular.
// The edge is met at rho = d / cos(theta), t = d tan(theta), so with both in units of r
//
//   M = integral over theta of m(rho),   m(rho) = integral of K(s) s ds from rho to 1
//
// For a kernel of photon/gather/kernel.h
//
//   2 pi m = (sum over j of m_j (1 - rho^(j + 2))) / (sum over j of m_j),   m_j = 2 a_j / ((j + 2) k^j),
//
// which is 1 - rho^2 for the constant kernel and (1 - rho^2)^2 for Epanechnikov's; the integrals follow from
// those of powers of the secant. Edges at which the surface ends add mass, edges beyond which it begins again
// (the far side of a hole) subtract: the sum is exactly the mass off the surface for every flat surface
// (Green's theorem, region by region). For curved surfaces it is exact to first order in r / curvature.

#include <array>

#include "accel/edge_index.h"
#include "core/geometry/interaction.h"
#include "photon/gather/kernel.h"

namespace kaustik::photon {

// M above: the share of the kernel's mass behind a straight edge. All lengths in units of the radius: d >= 0
// from the centre to the edge's line, t1 <= t2 along it from the foot of the perpendicular. In [0, 1/2]; zero
// for d >= 1.
double mass_behind_edge(const KernelSpec& kernel, double d, double t1, double t2);

// 1 if si's surface ends at this edge as seen from si, -1 if it begins again there, 0 if the edge is no end
// of it within `radius` metres.
int sign_of_edge(const BoundaryEdge& edge, const SurfaceInteraction& si, float radius);

// Lower bound of the share, reached at a corner of about 23 degrees. Thinner slivers stay too dark.
inline constexpr double kLeastShare = 1.0 / 16;

// If more edges than this lie within a disc, the outline is finer than the disc resolves.
inline constexpr size_t kMaxEdgesInReach = 192;

// Share of the kernel's mass on si's surface, in [kLeastShare, 1], by which the sum over photons in the disc
// of `radius` metres at si must be divided. An edge counts if photons in front of it count at si and those
// behind it do not (kNormalCosine). Facets of the opposite orientation count only if they lie in si's plane:
// there the winding is arbitrary, while a closed body has its far side elsewhere. Where a surface that passes
// above or below si ends, no edge counts. With more than kMaxEdgesInReach edges the share is that of a disc
// of half the radius, or of a quarter; if those meet as many, it is 1. Thread-safe.
double surface_share(const accel::EdgeIndex& edges, const SurfaceInteraction& si, const KernelSpec& kernel,
                     float radius);

}  // namespace kaustik::photon
