#pragma once
// Photon starts, many at once: lights of triangles in SIMD lanes, the others one by one.

#include "photon/emission/emission.h"
#include "photon/trace/vertex_lanes.h"

namespace kaustik::photon {

struct EmissionLanes {
  using Column = VertexLanes::Column;

  // In: the random numbers of emit_photon(). u_light is needed when there are several lights.
  SobolLanes position_direction;
  Column u_light;

  // Out: rays and fluxes as emit_photon() makes them; emitted is zero where it makes none.
  accel::RayLanes ray;
  alignas(64) Column flux[3];
  int32_t emitted[VertexLanes::kLanes];  // kFromSky: EmissionSample::from_sky
  static constexpr int32_t kFromSky = 2;

  // Between: for lights of triangles, the numbers left for the point and the direction, and the triangle
  // chosen with its normal on the side that emits.
  alignas(64) Column u[4], p0[3], e1[3], e2[3], n[3];
};

// Whether photon k comes from the sky (EmissionSample::from_sky) and something stands before its start.
template <class Accel>
bool sky_hidden(const Accel& bvh, const EmissionLanes& starts, size_t k) {
  if (starts.emitted[k] != EmissionLanes::kFromSky) return false;
  const Ray start = starts.ray.get(k);
  return bvh.intersect(Ray{start.o, -start.d}).valid();
}

// The first `count` starts, bit for bit those of emit_photon() on every instruction set. Thread-safe.
void emit_lanes(const Scene& scene, uint64_t total, EmissionMode mode, size_t count, EmissionLanes& lanes,
                std::optional<uint32_t> only = {});

}  // namespace kaustik::photon
