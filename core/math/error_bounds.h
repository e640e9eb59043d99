#pragma once
// Floating-point error bounds for ray origins (Pharr, Jakob, Humphreys 2023, section 6.8). There is no
// absolute epsilon: every bound is relative to the magnitude of the numbers involved, so scaling a scene by
// 2^k scales it exactly.

#include "core/math/vec.h"

namespace kaustik {

// Bound on the relative error of n chained roundings.
constexpr float gamma_bound(int n) {
  constexpr float kUnitRoundoff = std::numeric_limits<float>::epsilon() * 0.5f;
  return n * kUnitRoundoff / (1 - n * kUnitRoundoff);
}

// Distance by which a ray must leave a computed surface point p so that neither the error of p nor that of
// the next intersection test brings it back. `position` bounds |p| per coordinate: p and the moved origin are
// each rounded once to that magnitude (sqrt(3) roundings each along a normal; 6 leave room). `extent` bounds
// the size of the primitive per coordinate: the errors of interpolation within it, and of the intersector's
// differences between vertex and origin, are relative to the extent alone (about 8 roundings each).
inline float surface_error(float position, float extent) {
  return gamma_bound(6) * position + gamma_bound(16) * extent;
}

// Origin of a ray that leaves p in direction w, where p is known up to p_error (metres, isotropic): p moved
// along the geometric normal n to the side that w points to, far enough that the ray cannot meet its own
// surface again.
inline Point3 offset_origin(const Point3& p, float p_error, const Normal3& n, const Vector3& w) {
  return glm::dot(w, n) < 0 ? p - p_error * n : p + p_error * n;
}

}  // namespace kaustik
