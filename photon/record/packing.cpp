// Packing of unit vectors (octahedral) and powers (shared exponent).

#include "photon/record/packing.h"

#include <bit>

namespace kaustik::photon {

namespace {

using detail::kMiddle;
using detail::unpack_octahedral;

template <int kBits>
uint32_t pack_octahedral(const Vector3& w) {
  const float sum = std::abs(w.x) + std::abs(w.y) + std::abs(w.z);
  if (!(sum > 0)) return uint32_t(kMiddle<kBits>) * ((1u << kBits) + 1);
  const float scale = 1 / sum, x = w.x * scale, y = w.y * scale;
  const float folded_x = std::copysign(1 - std::abs(y), x), folded_y = std::copysign(1 - std::abs(x), y);
  const bool below = w.z < 0;
  // Rounds a non-negative value by adding one half and truncating: one instruction, where std::lround would
  // be a call.
  const auto quantise = [](float t) {
    constexpr int kM = kMiddle<kBits>;
    return uint32_t(std::clamp(int(t * float(kM) + (float(kM) + 0.5f)), 0, 2 * kM));
  };
  return quantise(below ? folded_x : x) | quantise(below ? folded_y : y) << kBits;
}

}  // namespace

uint32_t pack_direction(const Vector3& w) {
  return pack_octahedral<16>(w);
}

uint32_t pack_surface(const Normal3& n, uint32_t surface_group) {
  return pack_octahedral<8>(n) | surface_group << 16;
}

uint32_t pack_rgb9e5(const Rgb& c) {
  // Comparisons are false for NaN, which therefore becomes zero.
  const auto clamp = [](float v) { return v > 0 ? std::min(v, kRgb9e5Max) : 0.0f; };
  const Rgb v(clamp(c.x), clamp(c.y), clamp(c.z));
  const float largest = max_component(v);
  if (!(largest > 0)) return 0;
  // value = mantissa 2^(exponent - 24), with the largest mantissa in [256, 511] where the exponent allows it.
  // Powers of two are made from their bits, since std::ilogb, std::ldexp and std::lround are function calls.
  const auto power_of_two = [](int e) { return std::bit_cast<float>(uint32_t(127 + e) << 23); };
  const auto round = [](float x) { return uint32_t(int(x + 0.5f)); };
  int exponent = std::clamp(int(std::bit_cast<uint32_t>(largest) >> 23) - 127 + 16, 0, 31);
  if (round(largest * power_of_two(24 - exponent)) == 512) ++exponent;
  const float scale = power_of_two(24 - exponent);
  return round(v.x * scale) | round(v.y * scale) << 9 | round(v.z * scale) << 18 | uint32_t(exponent) << 27;
}

bool normal_counts(uint32_t surface, const Normal3& n) {
  const Vector3 v = unpack_octahedral<8>(surface);
  const float dot = v.x * n.x + v.y * n.y + v.z * n.z;
  const float length_squared = v.x * v.x + v.y * v.y + v.z * v.z;
  return dot > 0 && dot * dot > kNormalCosine * kNormalCosine * length_squared;
}

}  // namespace kaustik::photon
