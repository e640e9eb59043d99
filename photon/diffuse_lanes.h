#pragma once
// The commonest vertex of a photon's path, a Lambertian triangle without vertex normals, for many photons at
// once in SIMD lanes.

#include <cstddef>

#include "core/geometry/interaction.h"
#include "core/sampling/sobol_lanes.h"

namespace kaustik::photon {

// Lanes side by side, by columns. Lanes that nobody set are computed and mean nothing.
struct DiffuseLanes {
  static constexpr size_t kLanes = kSobolLanes;
  using Column = float[kLanes];

  // In: the ray that led here and its flux; the triangle's corners, barycentrics of the hit and reflectance;
  // flip is 1 or, for shapes of flipped normal, -1.
  alignas(64) Column o[3], d[3], flux[3];
  Column corner[3][3], uv[2], reflectance[3], flip;

  // Out: what make_interaction() says, n turned to where the photon comes from, d.n, and the next segment, as
  // Lambertian::sample_f and Russian roulette make it.
  Column p[3], p_error, n[3], facing[3], cos_in;
  Column next_o[3], next_d[3], next_flux[3];
  // How its life goes on.
  enum Fate : int32_t { kAbsorbed = 0, kAlive = 1, kInvalid = 2 };  // kInvalid: not a flux
  int32_t fate[kLanes];

  void set_vertex(size_t k, const TriangleMesh& mesh, bool flip_normal, const Hit& hit, const Rgb& albedo) {
    const std::array<uint32_t, 3>& vertices = mesh.indices[hit.primitive];
    for (size_t v = 0; v < 3; ++v) set(corner[v], k, mesh.P[vertices[v]]);
    uv[0][k] = hit.uv.x;
    uv[1][k] = hit.uv.y;
    set(reflectance, k, albedo);
    flip[k] = flip_normal ? -1.0f : 1.0f;
  }
  void set_segment(size_t k, const Ray& ray, const Rgb& power) {
    set(o, k, ray.o);
    set(d, k, ray.d);
    set(flux, k, power);
  }
  // Photon k walks on, as number `to` <= k.
  void move(size_t k, size_t to) {
    for (int c = 0; c < 3; ++c) {
      o[c][to] = next_o[c][k];
      d[c][to] = next_d[c][k];
      flux[c][to] = next_flux[c][k];
    }
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
void locate_lanes(DiffuseLanes& lanes, size_t count);

// Fills next_* and fate of the first `count` lanes from what locate_lanes() left. Direction from dimensions 0
// and 1 of numbers, roulette from dimension 2. The operations are those of the tracer's scalar code, in the
// same order, so the bits are the same too, on every instruction set. Thread-safe.
void scatter_lanes(DiffuseLanes& lanes, const SobolLanes& numbers, size_t count);

}  // namespace kaustik::photon
