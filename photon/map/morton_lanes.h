#pragma once
// Morton keys of many photons at once, in SIMD lanes.

#include <cstddef>
#include <cstdint>
#include <span>

#include "photon/map/morton.h"
#include "photon/record/photon_record.h"

namespace kaustik::photon {

// keys[i] = morton_key(cube.cell({x[i], y[i], z[i]})), the same bits on every instruction set.
void morton_keys(const MortonCube& cube, const float* x, const float* y, const float* z,
                 std::span<uint64_t> keys);

// Computes the keys of records, of which there must be as many as keys.
void morton_keys(const MortonCube& cube, const PhotonRecord* records, std::span<uint64_t> keys);

}  // namespace kaustik::photon
