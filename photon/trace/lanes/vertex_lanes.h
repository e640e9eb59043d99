#pragma once
// The commonest vertices of photon paths, computed for a group of photons in SIMD lanes: triangles without
// vertex normals and spheres, with diffuse, Oren-Nayar, mirror and dielectric BSDFs.

#include "photon/lanes/photon_lanes.h"
#include "photon/trace/lanes/surface_table.h"

namespace kaustik::photon {

// A group of vertices as structure of arrays. Lanes that were never set are computed too; ignore their
// results.
struct VertexLanes {
  // In: the ray that led here, its flux and its hit; the corners if it hit a triangle; the surface's row.
  accel::RayLanes ray;
  accel::HitLanes hit;
  alignas(64) LaneColumn flux[3];
  LaneColumn corner[3][3], reflectance[3], parameter[2], flip;
  uint32_t traits[kPhotonLanes], surface_group[kPhotonLanes];

  // Out: p, p_error and n as make_interaction() computes them; n flipped to the side the photon comes from
  // (facing); cos_in = d.n; and the next segment after sample_f and Russian roulette.
  LaneColumn p[3], p_error, n[3], facing[3], cos_in;
  accel::RayLanes next;
  LaneColumn next_flux[3];
  // Outcome of scattering; kInvalid: the flux would be NaN, infinite or negative.
  enum Fate : int32_t { kAbsorbed = 0, kAlive = 1, kInvalid = 2 };
  int32_t fate[kPhotonLanes];
  // Ledger units of the scattered flux before and after Russian roulette.
  int32_t scattered_energy[kPhotonLanes], next_energy[kPhotonLanes];

  // Copies what lane k needs of the surface that its hit is on.
  void set_vertex(size_t k, const SurfaceRow& surface) {
    const std::array<uint32_t, 3>& vertices = surface.indices[hit.primitive[k] & surface.primitives];
    for (size_t v = 0; v < 3; ++v) set_lane(corner[v], k, surface.P[vertices[v]]);
    set_lane(reflectance, k, surface.reflectance);
    parameter[0][k] = surface.parameter[0];
    parameter[1][k] = surface.parameter[1];
    flip[k] = surface.flip;
    traits[k] = surface.traits;
    surface_group[k] = surface.surface_group;
  }
  void set_next(size_t k, const Ray& r, const Rgb& power) {
    set_lane(next.o, k, r.o);
    set_lane(next.d, k, r.d);
    set_lane(next_flux, k, power);
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
