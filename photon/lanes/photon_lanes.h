#pragma once
// Photons side by side, for SIMD lanes: how many there are, and their columns.

#include <cstddef>

#include "accel/ray_lanes.h"
#include "core/math/vec.h"
#include "core/sampling/sobol_lanes.h"

namespace kaustik::photon {

// Photons that take a step together.
inline constexpr size_t kPhotonLanes = kSobolLanes;
static_assert(kPhotonLanes == accel::kRayLanes && kPhotonLanes == 64);

// One number of each photon.
using LaneColumn = float[kPhotonLanes];

// A vector or colour of photon k, by three columns.
inline void set_lane(LaneColumn (&columns)[3], size_t k, const glm::vec3& v) {
  columns[0][k] = v.x;
  columns[1][k] = v.y;
  columns[2][k] = v.z;
}
inline glm::vec3 get_lane(const LaneColumn (&columns)[3], size_t k) {
  return {columns[0][k], columns[1][k], columns[2][k]};
}

}  // namespace kaustik::photon
