#pragma once
// Groups of photons for SIMD lanes: their size and columns.

#include <cstddef>

#include "accel/ray_lanes.h"
#include "core/math/vec.h"
#include "core/sampling/sobol_lanes.h"

namespace kaustik::photon {

// Number of photons that take a step together.
inline constexpr size_t kPhotonLanes = kSobolLanes;
static_assert(kPhotonLanes == accel::kRayLanes && kPhotonLanes == 64);

// One number for each photon of a group.
using LaneColumn = float[kPhotonLanes];

// Access to a vector or colour of photon k in three columns.
inline void set_lane(LaneColumn (&columns)[3], size_t k, const glm::vec3& v) {
  columns[0][k] = v.x;
  columns[1][k] = v.y;
  columns[2][k] = v.z;
}
inline glm::vec3 get_lane(const LaneColumn (&columns)[3], size_t k) {
  return {columns[0][k], columns[1][k], columns[2][k]};
}

}  // namespace kaustik::photon
