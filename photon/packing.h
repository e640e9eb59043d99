#pragma once
// The number formats of the photon record.

#include <cstdint>

#include "core/math/vec.h"

namespace kaustik::photon {

// Octahedral map of unit vectors to two integers of `kBits` bits (Cigolle et al. 2014, "A Survey of Efficient
// Representations for Independent Unit Vectors"). Axis directions are exact.
uint32_t pack_direction(const Vector3& w);  // 2 x 16 bits
Vector3 unpack_direction(uint32_t bits);    // unit; off by less than 7e-5 rad

// Octahedral 2 x 8 bits of n in the low half, the group modulo 2^16 in the high half.
uint32_t pack_surface(const Normal3& n, uint32_t surface_group);
Normal3 unpack_surface_normal(uint32_t surface);  // unit; off by less than 0.0175 rad

// Three 9-bit mantissas and a shared 5-bit exponent (the format of GL_EXT_texture_shared_exponent). Each
// component is off by at most 1/511 of the largest one, for largest ones from 2^-16 to kRgb9e5Max; larger
// values are clamped to kRgb9e5Max, negative values and NaN to zero.
inline constexpr float kRgb9e5Max = 65408;  // 511/512 2^16
uint32_t pack_rgb9e5(const Rgb& c);
Rgb unpack_rgb9e5(uint32_t bits);

// Does the stored normal count for a query normal, see kNormalCosine? Defines what the SIMD loops compute: in
// exact small integers up to the dot product.
bool normal_counts(uint32_t surface, const Normal3& n);

}  // namespace kaustik::photon
