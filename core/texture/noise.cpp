// Perlin's improved noise, and its sums over octaves.

#include "core/texture/noise.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

namespace kaustik {

namespace {

// The permutation of Perlin's reference implementation.
constexpr std::array<uint8_t, 256> kPermutation = {
    151, 160, 137, 91,  90,  15,  131, 13,  201, 95,  96,  53,  194, 233, 7,   225, 140, 36,  103, 30,
    69,  142, 8,   99,  37,  240, 21,  10,  23,  190, 6,   148, 247, 120, 234, 75,  0,   26,  197, 62,
    94,  252, 219, 203, 117, 35,  11,  32,  57,  177, 33,  88,  237, 149, 56,  87,  174, 20,  125, 136,
    171, 168, 68,  175, 74,  165, 71,  134, 139, 48,  27,  166, 77,  146, 158, 231, 83,  111, 229, 122,
    60,  211, 133, 230, 220, 105, 92,  41,  55,  46,  245, 40,  244, 102, 143, 54,  65,  25,  63,  161,
    1,   216, 80,  73,  209, 76,  132, 187, 208, 89,  18,  169, 200, 196, 135, 130, 116, 188, 159, 86,
    164, 100, 109, 198, 173, 186, 3,   64,  52,  217, 226, 250, 124, 123, 5,   202, 38,  147, 118, 126,
    255, 82,  85,  212, 207, 206, 59,  227, 47,  16,  58,  17,  182, 189, 28,  42,  223, 183, 170, 213,
    119, 248, 152, 2,   44,  154, 163, 70,  221, 153, 101, 155, 167, 43,  172, 9,   129, 22,  39,  253,
    19,  98,  108, 110, 79,  113, 224, 232, 178, 185, 112, 104, 218, 246, 97,  228, 251, 34,  242, 193,
    238, 210, 144, 12,  191, 179, 162, 241, 81,  51,  145, 235, 249, 14,  239, 107, 49,  192, 214, 31,
    181, 199, 106, 157, 184, 84,  204, 176, 115, 121, 50,  45,  127, 4,   150, 254, 138, 236, 205, 93,
    222, 114, 67,  29,  24,  72,  243, 141, 128, 195, 78,  66,  215, 61,  156, 180};

uint32_t permuted(uint32_t i) {
  return kPermutation[i & 255];
}

// Dot product of (dx, dy, dz) with one of twelve directions to the edges of a cube.
float gradient(uint32_t x, uint32_t y, uint32_t z, float dx, float dy, float dz) {
  const uint32_t h = permuted(permuted(permuted(x) + y) + z) & 15;
  const float u = h < 8 || h == 12 || h == 13 ? dx : dy;
  const float v = h < 4 || h == 12 || h == 13 ? dy : dz;
  return (h & 1 ? -u : u) + (h & 2 ? -v : v);
}

float smooth(float t) {
  return t * t * t * (t * (6 * t - 15) + 10);
}
float lerp(float w, float a, float b) {
  return (1 - w) * a + w * b;
}

struct Cell {
  uint32_t index;
  float offset;
};

Cell cell_of(float x) {
  const float low = std::floor(x);
  const float wrapped = low - 256 * std::floor(low / 256);
  return {static_cast<uint32_t>(wrapped), x - low};
}

float smooth_step(float low, float high, float x) {
  const float t = std::clamp((x - low) / (high - low), 0.0f, 1.0f);
  return t * t * (3 - 2 * t);
}

// Number of octaves that are coarser than the footprint; its fraction is the weight of the last one. Zero for
// footprints that are not a number.
float visible_octaves(const Vector3& dpdx, const Vector3& dpdy, int count) {
  const float squared = std::max(glm::dot(dpdx, dpdx), glm::dot(dpdy, dpdy));
  const float octaves = -1 - 0.5f * std::log2(squared);
  return octaves > 0 ? std::min(octaves, float(count)) : 0;
}

constexpr float kLacunarity = 1.99f, kMeanOfAbsoluteNoise = 0.2f;

}  // namespace

float noise(const Point3& p) {
  if (!is_finite(p)) return 0;
  const Cell cx = cell_of(p.x), cy = cell_of(p.y), cz = cell_of(p.z);
  const float wx = smooth(cx.offset), wy = smooth(cy.offset), wz = smooth(cz.offset);
  float layer[2];
  for (uint32_t z = 0; z < 2; ++z) {
    const auto corner = [&](uint32_t i, uint32_t j) {
      return gradient(cx.index + i, cy.index + j, cz.index + z, cx.offset - float(i), cy.offset - float(j),
                      cz.offset - float(z));
    };
    layer[z] = lerp(wy, lerp(wx, corner(0, 0), corner(1, 0)), lerp(wx, corner(0, 1), corner(1, 1)));
  }
  return lerp(wz, layer[0], layer[1]);
}

float noise(float x, float y) {
  return noise({x, y, 0.5f});
}

float fbm(const Point3& p, const Vector3& dpdx, const Vector3& dpdy, const Octaves& octaves) {
  const float visible = visible_octaves(dpdx, dpdy, octaves.count);
  const int whole = int(visible);
  float sum = 0, lambda = 1, strength = 1;
  for (int i = 0; i < whole; ++i, lambda *= kLacunarity, strength *= octaves.omega)
    sum += strength * noise(lambda * p);
  return sum + strength * smooth_step(0.3f, 0.7f, visible - float(whole)) * noise(lambda * p);
}

float turbulence(const Point3& p, const Vector3& dpdx, const Vector3& dpdy, const Octaves& octaves) {
  const float visible = visible_octaves(dpdx, dpdy, octaves.count);
  const int whole = int(visible);
  float sum = 0, lambda = 1, strength = 1;
  for (int i = 0; i < whole; ++i, lambda *= kLacunarity, strength *= octaves.omega)
    sum += strength * std::abs(noise(lambda * p));
  const float part = smooth_step(0.3f, 0.7f, visible - float(whole));
  sum += strength * lerp(part, kMeanOfAbsoluteNoise, std::abs(noise(lambda * p)));
  for (int i = whole; i < octaves.count; ++i, strength *= octaves.omega)
    sum += strength * kMeanOfAbsoluteNoise;
  return sum;
}

}  // namespace kaustik
