#pragma once
// Vector types: GLM's under the field's names. The aliases inform the reader only; the types are the same.
// Lengths are in metres; Rgb is linear Rec. 709.

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <glm/glm.hpp>
#include <limits>
#include <numbers>

namespace kaustik {

using Point2 = glm::vec2;
using Point3 = glm::vec3;
using Vector2 = glm::vec2;
using Vector3 = glm::vec3;
using Normal3 = glm::vec3;
using Rgb = glm::vec3;

inline constexpr float kPi = std::numbers::pi_v<float>;
inline constexpr float kInvPi = std::numbers::inv_pi_v<float>;
inline constexpr float kInfinity = std::numeric_limits<float>::infinity();
// Largest float below one; clamping to it keeps canonical random numbers inside [0, 1).
inline constexpr float kOneMinusEpsilon = 0x1.fffffep-1f;

inline float max_component(const glm::vec3& v) {
  return std::max(v.x, std::max(v.y, v.z));
}
inline float max_abs_component(const glm::vec3& v) {
  return std::max(std::abs(v.x), std::max(std::abs(v.y), std::abs(v.z)));
}
// 0, 1 or 2: the first of the largest components.
template <class T, glm::qualifier Q>
int largest_axis(const glm::vec<3, T, Q>& v) {
  return v.x >= v.y && v.x >= v.z ? 0 : v.y >= v.z ? 1 : 2;
}
// Number, 0 to 5, of the side of a cube through which n points.
inline int cube_side(const glm::vec3& n) {
  const int axis = largest_axis(glm::abs(n));
  return 2 * axis + (n[axis] < 0);
}
inline float abs_dot(const glm::vec3& a, const glm::vec3& b) {
  return std::abs(glm::dot(a, b));
}
inline float length_squared(const glm::vec3& v) {
  return glm::dot(v, v);
}
// Relative luminance of a linear Rec. 709 colour.
inline float luminance(const Rgb& c) {
  return 0.2126f * c.x + 0.7152f * c.y + 0.0722f * c.z;
}
inline bool is_black(const Rgb& c) {
  return c.x == 0 && c.y == 0 && c.z == 0;
}
inline bool is_grey(const Rgb& c) {
  return c.x == c.y && c.y == c.z;
}
inline bool is_finite(const glm::vec3& v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}
// Vectors are normalised as they are if the squares of their lengths lie between these bounds.
inline constexpr float kLeastSquare = 1e-30f, kLargestSquare = 1e30f;
// The bits of a float that hold the exponent of its power of two.
inline constexpr uint32_t kExponentBits = 0x7f800000;
// The unit vector along v, also where the square of its length is beyond the range of floats; the x axis
// where v is zero or not finite. Powers of two scale exactly, so that a scene of any scale has the same bits.
inline glm::vec3 unit_vector(const glm::vec3& v) {
  const float square = length_squared(v);
  if (square > kLeastSquare && square < kLargestSquare) return glm::normalize(v);
  if (!is_finite(v) || v == glm::vec3(0)) return {1, 0, 0};
  const float scale = std::bit_cast<float>(std::bit_cast<uint32_t>(max_abs_component(v)) & kExponentBits);
  return glm::normalize(v / std::max(scale, std::numeric_limits<float>::min()));
}

}  // namespace kaustik
