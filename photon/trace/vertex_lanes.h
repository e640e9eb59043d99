#pragma once
// The commonest vertices of photon paths, computed for a group of photons in SIMD lanes: triangles without
// vertex normals and spheres, with diffuse, Oren-Nayar, mirror and dielectric BSDFs.

#include <cstddef>

#include "accel/ray_lanes.h"
#include "core/sampling/sobol_lanes.h"
#include "photon/trace/surface_table.h"

namespace kaustik::photon {

// A group of vertices as structure of arrays. Lanes that were never set are computed too; ignore their
// results.
struct VertexLanes {
  static constexpr size_t kLanes = kSobolLanes;
  static_assert(kLanes == accel::kRayLanes && kLanes == 64);
  using Column = float[kLanes];

  // In: the ray that led here, its flux and its hit; the corners if it hit a triangle; the surface's row.
  accel::RayLanes ray;
  accel::HitLanes hit;
  alignas(64) Column flux[3];
  Column corner[3][3], reflectance[3], parameter[2], flip;
  uint32_t traits[kLanes], surface_group[kLanes];

  // Out: p, p_error and n as make_interaction() computes them; n flipped to the side the photon comes from
  // (facing); cos_in = d.n; and the next segment after sample_f and Russian roulette.
  Column p[3], p_error, n[3], facing[3], cos_in;
  accel::RayLanes next;
  Column next_flux[3];
  // Outcome of scattering; kInvalid: the flux would be NaN, infinite or negative.
  enum Fate : int32_t { kAbsorbed = 0, kAlive = 1, kInvalid = 2 };
  int32_t fate[kLanes];
  // Ledger units of the scattered flux before and after Russian roulette.
  int32_t scattered_energy[kLanes], next_energy[kLanes];

  // Copies what lane k needs of the surface that its hit is on.
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

// Computes p, p_error, n, facing and cos_in of the first `count` lanes, with the bits of make_interaction().
// Thread-safe.
void locate_lanes(VertexLanes& lanes, const std::vector<Shape>& shapes, size_t count);

// Computes next, next_flux, fate and the energies of the first `count` lanes from what locate_lanes() left.
// The direction uses dimensions 0 and 1 of numbers, roulette dimension 2; at specular surfaces the lobe uses
// dimension 2 and roulette dimension 3. The operations and their order are those of the tracer's scalar code,
// so the bits are the same on every instruction set. Thread-safe.
void scatter_lanes(VertexLanes& lanes, const SobolLanes& numbers, float units_per_watt, size_t count);

}  // namespace kaustik::photon
