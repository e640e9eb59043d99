#pragma once
// Reflected radiance estimated from a photon map.

#include "accel/edge_index.h"
#include "core/bsdf/bsdf.h"
#include "core/geometry/interaction.h"
#include "photon/estimate/clear_radius.h"
#include "photon/estimate/surface_areas.h"
#include "photon/estimate/walls.h"
#include "photon/gather/gather.h"

namespace kaustik::photon {

struct EstimateSettings {
  float radius = 0;  // r0, metres
  KernelSpec kernel;
  uint32_t nearest = 0;        // K > 0: without discs, the radius shrinks to the K-th nearest photon
  bool leaf = false;           // the lecture's leaf lookup instead of the exact search
  uint32_t node_photons = 64;  // N0 of the leaf lookup
  // The photons' own discs, none wider than `radius`. Null: the photons around a point all have one radius.
  const PhotonDiscs* discs = nullptr;
  // Edges of surfaces, for boundary correction. Null: every disc is assumed to lie on the surface as a whole.
  // Not used by the leaf lookup, whose cells cut the disc anyway.
  const accel::EdgeIndex* edges = nullptr;
  // Areas of curved surfaces, for discs of up to `radius`; used only if `edges` is set. Null: surfaces are
  // treated as flat.
  const SurfaceAreas* areas = nullptr;
  // Walls that hide photons, for discs of up to `radius`. Null: there are none.
  const Walls* walls = nullptr;
  // Narrows discs where other surfaces are near; none is wider than `radius`. Null: all have `radius`. Not
  // used beside discs, `nearest` or the leaf lookup.
  const ClearRadius* clear = nullptr;
};

// Share of the kernel's mass on si's surface within `radius` metres, in (0, 1], by which a sum over photons
// is divided. settings.edges must not be null. cut: walls that hide some of the surface; null for none.
// Thread-safe.
double share_of_disc(const EstimateSettings& settings, const SurfaceInteraction& si, float radius,
                     const WallCut* cut = nullptr);

// Estimated bias of the density estimate, and the cost of estimating it.
struct BiasEstimate {
  Rgb bias{0};  // W/(m^2 sr)
  GatherCounters counters;
};

// Lr(x, wo) = sum over photons p in reach of f_r(x, wo, wi_p) flux_p K(|x - x_p|)   in W/(m^2 sr)
// (Jensen 2001, "Realistic Image Synthesis Using Photon Mapping", equations 7.3 to 7.6). There is no cosine,
// since flux per area already contains it. wo: unit, world space, away from the surface. The kernel's bias is
// O(radius^2) where light is smooth. With settings.edges the sum is divided by the kernel's share on the
// surface (share_of_disc); without, the result is too dark by up to half within radius of the surface's
// border. Photons behind settings.walls do not count. For a BSDF that transmits light, photons on the far
// side count too, with a disc of their own; a body's opposite surface nearer than the radius is then mistaken
// for this one. Zero for specular BSDFs and empty maps. Thread-safe.
//
// bias: if not null, this estimate's bias is added to it: 4/3 of the difference between the estimate of this
// disc and that of half its radius, which uses some of the same photons. It is noisy. Where light is smooth
// it is itself unbiased, since a bias in proportion to r^2 is a quarter at half the radius. Summed across an
// edge of light the bias is in proportion to r, so that only 4/3 (1 - 1/2) = 2/3 of it is found; measured
// shares are in docs/decisions/004-error-is-measured-by-passes.md.
Rgb estimate_radiance(const PhotonMap& map, const SurfaceInteraction& si, const Vector3& wo, const Bsdf& bsdf,
                      const EstimateSettings& settings, GatherCounters& counters,
                      BiasEstimate* bias = nullptr);

// The same sum over the photons whose directions are faint in the glossy lobes: with f_r that of the glossy
// lobes, and only where their density of samples, pdf_glossy(wo, wi), is below most_pdf (1/sr). Photons of
// the viewer's side count. Zero for BSDFs without glossy lobes and empty maps. Thread-safe.
Rgb estimate_glossy_tail(const PhotonMap& map, const SurfaceInteraction& si, const Vector3& wo,
                         const Bsdf& bsdf, const EstimateSettings& settings, float most_pdf,
                         GatherCounters& counters);

// The query for the photons that count at si on the side of n. With settings.nearest and without discs, its
// radius is that of the disc whose photons count in a K-nearest estimate. The K-th photon itself is excluded:
// K - 1 photons in the disc that reaches the K-th give an unbiased estimate of density, K photons do not
// (Silverman 1986, section 5.2).
GatherQuery query_at(const PhotonMap& map, const SurfaceInteraction& si, const Normal3& n,
                     const EstimateSettings& settings, GatherCounters& counters);

}  // namespace kaustik::photon
