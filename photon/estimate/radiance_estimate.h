#pragma once
// Reflected radiance from a photon map.

#include "accel/edge_index.h"
#include "core/bsdf/bsdf.h"
#include "core/geometry/interaction.h"
#include "photon/estimate/surface_areas.h"
#include "photon/map/photon_map.h"

namespace kaustik::photon {

struct EstimateSettings {
  float radius = 0;  // r0, metres
  KernelSpec kernel;
  uint32_t nearest = 0;        // K > 0: the radius shrinks to the K-th nearest photon
  bool leaf = false;           // the lecture's leaf lookup instead of the exact search
  uint32_t node_photons = 64;  // N0 of the leaf lookup
  // Where surfaces end; null: discs are taken to lie on the surface as a whole. Not read by the leaf lookup,
  // whose cells cut the disc anyway.
  const accel::EdgeIndex* edges = nullptr;
  // Where surfaces curve, for `radius`; read beside edges only. null: as if they were flat.
  const SurfaceAreas* areas = nullptr;
};

// Share of the kernel's mass on si's surface within `radius` metres, in (0, 1]: what a sum over photons is
// divided by. settings.edges is not null. Thread-safe.
double share_of_disc(const EstimateSettings& settings, const SurfaceInteraction& si, float radius);

// By how much kernels make light too bright, and what it took to find out.
struct BiasEstimate {
  Rgb bias{0};  // W/(m^2 sr)
  GatherCounters counters;
};

// Lr(x, wo) = sum over photons p in reach of f_r(x, wo, wi_p) flux_p K(|x - x_p|)   in W/(m^2 sr)
// Jensen 2001, "Realistic Image Synthesis Using Photon Mapping", equations 7.3 to 7.6. No cosine: flux per
// area already holds it. wo: unit, world, away from the surface. Bias: that of the kernel, O(radius^2) where
// light is smooth. With settings.edges the sum is divided by the kernel's share on the surface
// (share_of_disc), without it is too dark by up to half within radius of the surface's border. Of a BSDF that
// lets light through, photons on the far side count too, with a disc of their own; a body's opposite surface
// nearer than the radius is then taken for this one. Zero for specular BSDFs and empty maps. Thread-safe.
//
// bias: if not null, the bias of this estimate is added to it. Of half the radius an O(r^2) bias is a
// quarter, so it is 4/3 of the difference between this disc and its inner half, which holds some of the same
// photons: noisy, without bias of its own where light is smooth, and some 30 % too small at edges
// (docs/accuracy.md).
Rgb estimate_radiance(const PhotonMap& map, const SurfaceInteraction& si, const Vector3& wo, const Bsdf& bsdf,
                      const EstimateSettings& settings, GatherCounters& counters,
                      BiasEstimate* bias = nullptr);

// Radius of the disc whose photons count where the K-th nearest sets it, at most query.radius. It does not
// count itself: K - 1 photons in the disc that reaches the K-th are an unbiased estimate of density, K
// photons are not (Silverman 1986, section 5.2).
float disc_of_nearest(const PhotonMap& map, const GatherQuery& query, uint32_t k, GatherCounters& counters);

}  // namespace kaustik::photon
