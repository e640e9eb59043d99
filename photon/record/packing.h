#pragma once
// Number formats of the photon record.

#include <bit>
#include <cmath>
#include <cstdint>

#include "core/math/vec.h"

namespace kaustik::photon {

namespace detail {

// Value that stands for coordinate zero; coordinates range from 0 to twice this, an even number, so that zero
// is exact.
template <int kBits>
inline constexpr int kMiddle = (1 << (kBits - 1)) - 1;

// Not normalised: the result's L1 norm is kMiddle.
template <int kBits>
Vector3 unpack_octahedral(uint32_t bits) {
  const float a = float(int(bits & ((1u << kBits) - 1)) - kMiddle<kBits>);
  const float b = float(int((bits >> kBits) & ((1u << kBits) - 1)) - kMiddle<kBits>);
  const float c = float(kMiddle<kBits>) - std::abs(a) - std::abs(b);
  const float fold = std::max(-c, 0.0f);
  return {a - std::copysign(fold, a), b - std::copysign(fold, b), c};
}

}  // namespace detail

// Octahedral map of unit vectors to two integers of `kBits` bits (Cigolle et al. 2014, "A Survey of Efficient
// Representations for Independent Unit Vectors"). Axis directions are exact.
uint32_t pack_direction(const Vector3& w);  // 2 x 16 bits
// Unit vector; the angular error is below 7e-5 rad.
inline Vector3 unpack_direction(uint32_t bits) {
  return glm::normalize(detail::unpack_octahedral<16>(bits));
}

// Packs n into 2 x 8 octahedral bits (low half), and the surface group modulo 2^16 (high half).
uint32_t pack_surface(const Normal3& n, uint32_t surface_group);
// Unit vector; the angular error is below 0.0175 rad.
inline Normal3 unpack_surface_normal(uint32_t surface) {
  return glm::normalize(detail::unpack_octahedral<8>(surface));
}

// Three 9-bit mantissas and a shared 5-bit exponent (the format of GL_EXT_texture_shared_exponent). The error
// of each component is at most 1/511 of the largest component, if that is between 2^-16 and kRgb9e5Max;
// larger values are clamped to kRgb9e5Max, negative values and NaN to zero.
inline constexpr float kRgb9e5Max = 65408;  // 511/512 2^16
uint32_t pack_rgb9e5(const Rgb& c);
inline Rgb unpack_rgb9e5(uint32_t bits) {
  const float scale = std::bit_cast<float>(((bits >> 27) + (127 - 24)) << 23);
  return {float(bits & 511) * scale, float(bits >> 9 & 511) * scale, float(bits >> 18 & 511) * scale};
}

// A photon counts when its normal and the query's make a cosine above this (60 degrees): curved surfaces keep
// their photons, the other side of a sheet and the far wall of a corner do not count.
inline constexpr float kNormalCosine = 0.5f;

// Whether a photon with this packed surface counts for a query with normal n. Defines the
// result of the SIMD loops; exact in small integers up to the dot product.
bool normal_counts(uint32_t surface, const Normal3& n);

}  // namespace kaustik::photon
