#pragma once
// Emission of a group of photons: area lights of triangles in SIMD lanes, all others one by one.

#include "photon/emission/emission.h"
#include "photon/lanes/photon_lanes.h"

namespace kaustik::photon {

struct EmissionLanes {
  // In: the random numbers of emit_photon(). u_light is used only if there are several lights.
  SobolLanes position_direction;
  LaneColumn u_light;

  // Out: rays and fluxes as emit_photon() makes them.
  accel::RayLanes ray;
  alignas(64) LaneColumn flux[3];
  // 0: nothing is emitted; 1; or kFromSky (see EmissionSample::from_sky)
  int32_t emitted[kPhotonLanes];
  static constexpr int32_t kFromSky = 2;

  // Intermediate values for lights of triangles: the random numbers left for position and direction, the
  // chosen triangle, and its normal on the emitting side.
  alignas(64) LaneColumn u[4], p0[3], e1[3], e2[3], n[3];
};

// Whether photon k comes from the sky through a portal (EmissionSample::from_sky) and an object outside
// blocks it.
template <class Accel>
bool sky_hidden(const Accel& bvh, const EmissionLanes& starts, size_t k) {
  if (starts.emitted[k] != EmissionLanes::kFromSky) return false;
  const Ray start = starts.ray.get(k);
  return bvh.intersect(Ray{start.o, -start.d}).valid();
}

// Emits the first `count` photons, bit for bit as emit_photon() does on every instruction set. Thread-safe.
void emit_lanes(const Scene& scene, uint64_t total, EmissionMode mode, size_t count, EmissionLanes& lanes,
                std::optional<uint32_t> only = {});

}  // namespace kaustik::photon
