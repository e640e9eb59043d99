#pragma once
// The first four dimensions of the Sobol sequence (direction numbers of Joe and Kuo 2008) as byte-wise XOR
// tables. The values are stored with their bits reversed, which is the order in which Owen scrambling by
// hashing works.

#include <array>
#include <cstdint>

namespace kaustik {

constexpr uint32_t reverse_bits(uint32_t x) {
  x = (x << 16) | (x >> 16);
  x = ((x & 0x00ff00ffu) << 8) | ((x & 0xff00ff00u) >> 8);
  x = ((x & 0x0f0f0f0fu) << 4) | ((x & 0xf0f0f0f0u) >> 4);
  x = ((x & 0x33333333u) << 2) | ((x & 0xccccccccu) >> 2);
  return ((x & 0x55555555u) << 1) | ((x & 0xaaaaaaaau) >> 1);
}

// Direction numbers of one dimension from its primitive polynomial (degree s, inner coefficients a) and first
// values m (Bratley and Fox 1988).
constexpr std::array<uint32_t, 32> sobol_directions(int s, uint32_t a, const std::array<uint32_t, 3>& m) {
  std::array<uint32_t, 32> v{};
  for (int i = 0; i < 32; ++i) {
    if (i < s) {
      v[i] = m[i] << (31 - i);
      continue;
    }
    v[i] = v[i - s] ^ (v[i - s] >> s);
    for (int k = 1; k < s; ++k) v[i] ^= ((a >> (s - 1 - k)) & 1u) * v[i - k];
  }
  return v;
}

// table[b][x] is the bit-reversed contribution of byte b of the index when its value is x.
using SobolByteTable = std::array<std::array<uint32_t, 256>, 4>;

constexpr SobolByteTable sobol_byte_table(const std::array<uint32_t, 32>& v) {
  SobolByteTable table{};
  for (int b = 0; b < 4; ++b) {
    for (uint32_t x = 1; x < 256; ++x) {
      const uint32_t rest = x & (x - 1);  // x without its lowest set bit
      int bit = 0;
      while (((x >> bit) & 1u) == 0) ++bit;
      table[b][x] = table[b][rest] ^ reverse_bits(v[8 * b + bit]);
    }
  }
  return table;
}

// Tables of dimensions 1 to 3. Dimension 0 is van der Corput's sequence, whose reversed value is the index
// itself.
inline constexpr std::array<SobolByteTable, 3> kSobolTables = {
    sobol_byte_table(sobol_directions(1, 0, {1, 0, 0})), sobol_byte_table(sobol_directions(2, 1, {1, 3, 0})),
    sobol_byte_table(sobol_directions(3, 1, {1, 3, 1}))};

// Bit-reversed Sobol value of `index` in dimension 0 to 3.
inline uint32_t sobol_reversed(uint32_t index, uint32_t dimension) {
  if (dimension == 0) return index;
  const SobolByteTable& t = kSobolTables[dimension - 1];
  return t[0][index & 255u] ^ t[1][(index >> 8) & 255u] ^ t[2][(index >> 16) & 255u] ^ t[3][index >> 24];
}

// The hash of Laine and Karras (2011) with better constants by Vegdahl (2021). Bit i of the result depends
// only on bits 0 to i of x, so on bit-reversed numbers it is a random Owen scrambling.
constexpr uint32_t laine_karras(uint32_t x, uint32_t seed) {
  x ^= x * 0x3d20adeau;
  x += seed;
  x *= (seed >> 16) | 1u;
  x ^= x * 0x05526c56u;
  return x ^ (x * 0x53a22864u);
}

}  // namespace kaustik
