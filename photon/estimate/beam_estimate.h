#pragma once
// The beam radiance estimate: light that a medium scatters along a ray, from photons in the medium.

#include "photon/gather/beam.h"

namespace kaustik::photon {

// Estimates  int T(t) sigma_s int p(wo, wi) L(t, wi) dwi dt  over the ray, in W/(m^2 sr), as the sum over the
// photons near it of  T(t) p(wo, wi) K(d) times the flux that the medium scatters (Jarosz, Zwicker and Jensen
// 2008, "The Beam Radiance Estimate for Volumetric Photon Mapping", with one radius for all photons). The
// kernel is one of the plane across the ray. nearest > 0: where more photons than that are in reach, the
// radius shrinks until about so many are, as if they were spread evenly. bvh: whose surfaces hide photons;
// null: none. The order of the sum is fixed.
Rgb estimate_beam(const PhotonMap& map, BeamQuery query, const Medium& medium, const KernelSpec& kernel,
                  uint32_t nearest, GatherCounters& counters, const accel::Bvh* bvh = nullptr);

}  // namespace kaustik::photon
