#pragma once
// Random numbers for tests, the same with every standard library.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>

#include "core/math/vec.h"

namespace kaustik::test {

// Independent draws: significance tests assume independence, which Sobol points lack. Floats are made from
// bits here because the results of the standard distributions differ between libraries.
class Random {
 public:
  explicit Random(uint64_t seed) : engine_(seed) {}

  uint32_t bits() { return static_cast<uint32_t>(engine_() >> 32); }
  float uniform() { return static_cast<float>(engine_() >> 40) * 0x1p-24f; }  // in [0, 1)
  float uniform(float a, float b) { return a + (b - a) * uniform(); }
  Point2 uniform_2d() {
    const float x = uniform();
    return {x, uniform()};
  }
  Point3 uniform_3d() {
    const Point2 xy = uniform_2d();
    return {xy.x, xy.y, uniform()};
  }
  Vector3 in_cube() { return 2.0f * uniform_3d() - 1.0f; }  // in [-1, 1)^3
  // Uniform on the unit sphere.
  Vector3 direction() {
    const float z = uniform(-1, 1);
    const float r = std::sqrt(std::max(0.0f, 1 - z * z));
    const float phi = 2 * kPi * uniform();
    return glm::normalize(Vector3(r * std::cos(phi), r * std::sin(phi), z));
  }

 private:
  std::mt19937_64 engine_;
};

}  // namespace kaustik::test
