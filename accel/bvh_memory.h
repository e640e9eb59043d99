#pragma once
// How much memory a Bvh will take, before it is built.

#include <cstdint>

#include "core/geometry/side_estimate.h"
#include "core/scene/scene.h"

namespace kaustik::accel {

// Bytes that the build of a Bvh takes at its peak, from the number of primitives and how they hang together:
// an upper bound for usual scenes, with Embree 3.13 and 4 on x86-64.
uint64_t forecast_bytes(const Scene& scene, const SideEstimate& sides);

}  // namespace kaustik::accel
