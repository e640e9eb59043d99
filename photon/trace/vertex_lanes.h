#pragma once
// The commonest vertices of photons' paths for many photons at once in SIMD lanes: triangles without vertex
// normals and spheres, of the diffuse BSDFs, mirrors and dielectrics.

#include <cstddef>

#include "accel/ray_lanes.h"
#include "core/sampling/sobol_lanes.h"
#include "photon/trace/surface_table.h"

namespace kaustik::photon {

// Lanes side by side, by columns. Lanes that nobody set are computed and mean nothing.
struct VertexLanes {
  static constexpr size_t kLanes = kSobolLanes;
  static_assert(kLanes == accel::kRayLanes && kLanes == 64);
  using Column = float[kLanes];

  // In: the ray that led here, its flux, and its hit; of a triangle its corners; what the surface's row says.
  accel::RayLanes ray;
  accel::HitLanes hit;
  alignas(64) Column flux[3];
  Column corner[3][3], reflectance[3], parameter[2], flip;
  uint32_t traits[kLanes], surface_group[kLanes];

  // Out: what make_interaction() says, n turned to where the photon comes from, d.n, and the next segment, as
  // the BSDF's sample_f and Russian roulette make it.
  Column p[3], p_error, n[3], facing[3], cos_in;
  accel::RayLanes next;
  Column next_flux[3];
  // How its life goes on.
  enum Fate : int32_t { kAbsorbed = 0, kAlive = 1, kInvalid = 2 };  // kInvalid: not a flux
  int32_t fate[kLanes];
  // Energies of the flux that is scattered, before and after Russian roulette, in units of the ledger.
  int32_t scattered_energy[kLanes], next_energy[kLanes];

  // Of lane k, whose hit is on this surface.
  void set_vertex(size_t k, const SurfaceRow& surface) {
    const std::array<uint32_t, 3>& vertices = surface.indices[hit.primitive[k] & surface.primitives];
    for (size_t v = 0; v < 3; ++v) set(corner[v], k, surface.P[vertices[v]]);
    set(reflectance, k, surface.reflectance);
    parameter[0][k] = surface.parameter[0];
    parameter[1][k] = surface.parameter[1];
    flip[k] = surface.flip;
    traits[k] = surface.traits;
    surface_group[k] = surface.surface_group;
  }
  void set_next(size_t k, const Ray& r, const Rgb& power) {
    set(next.o, k, r.o);
    set(next.d, k, r.d);
    set(next_flux, k, power);
  }
  static void set(Column (&columns)[3], size_t k, const glm::vec3& v) {
    columns[0][k] = v.x;
    columns[1][k] = v.y;
    columns[2][k] = v.z;
  }
  static glm::vec3 get(const Column (&columns)[3], size_t k) {
    return {columns[0][k], columns[1][k], columns[2][k]};
  }
};

// Fills p, p_error, n, facing and cos_in of the first `count` lanes, with the bits of make_interaction().
// Thread-safe.
void locate_lanes(VertexLanes& lanes, const std::vector<Shape>& shapes, size_t count);

// Fills next, next_flux, fate and the energies of the first `count` lanes from what locate_lanes() left.
// Direction from dimensions 0 and 1 of numbers, roulette from dimension 2; at specular surfaces lobe from
// dimension 2 and roulette from dimension 3. The operations are those of the tracer's scalar code, in the
// same order, so the bits are the same too, on every instruction set. Thread-safe.
void scatter_lanes(VertexLanes& lanes, const SobolLanes& numbers, float units_per_watt, size_t count);

}  // namespace kaustik::photon
