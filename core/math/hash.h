#pragma once
// Hashes of 64-bit words.

#include <cstdint>

namespace kaustik {

// Bijective 64-bit finaliser (Stafford 2011, variant 13).
constexpr uint64_t mix64(uint64_t x) {
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9ull;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebull;
  return x ^ (x >> 31);
}
constexpr uint64_t hash_combine(uint64_t a, uint64_t b) {
  return mix64(a ^ (b + 0x9e3779b97f4a7c15ull + (a << 6) + (a >> 2)));
}
// The first 24 bits of a hash as a number in [0, 1).
constexpr float unit_number(uint64_t hash) {
  return static_cast<float>(hash >> 40) * 0x1p-24f;
}

}  // namespace kaustik
