// The equal-area map with polynomial sine and cosine, so that its bits are the same on every machine.

#include "core/sampling/equal_area.h"

#include "core/sampling/warp.h"

namespace kaustik {

Vector3 equal_area_square_to_sphere(const Point2& p) {
  const Point2 s = 2.0f * p - 1.0f;
  const Point2 a = glm::abs(s);
  const float inner = 1 - (a.x + a.y);  // signed distance from the diagonals; negative for z < 0
  const float r = 1 - std::abs(inner);
  // The azimuth within its quadrant is pi/4 (1 + turn).
  const float turn = r > 0 ? (a.y - a.x) / r : 0;
  const Point2 cs = cos_sin_octant(0.25f * kPi * turn);
  const float half = std::numbers::sqrt2_v<float> / 2;
  const float radius = r * std::sqrt(std::max(0.0f, 2 - r * r));
  return {std::copysign(radius * half * (cs.x - cs.y), s.x),
          std::copysign(radius * half * (cs.x + cs.y), s.y), std::copysign(1 - r * r, inner)};
}

Point2 equal_area_sphere_to_square(const Vector3& w) {
  const Vector3 a = glm::abs(w);
  const float r = std::sqrt((a.x * a.x + a.y * a.y) / (1 + a.z));  // sqrt(1 - |z|) without cancellation
  const float longer = std::max(a.x, a.y), shorter = std::min(a.x, a.y);
  const float octant = longer > 0 ? std::atan(shorter / longer) * (2 * kInvPi) : 0;
  const float quadrant = a.x < a.y ? 1 - octant : octant;  // the azimuth in units of a right angle
  Point2 s(r - quadrant * r, quadrant * r);
  if (w.z < 0) s = Point2(1 - s.y, 1 - s.x);
  s = {std::copysign(s.x, w.x), std::copysign(s.y, w.y)};
  return glm::clamp(0.5f * (s + 1.0f), Point2(0), Point2(1));
}

Point2 wrap_equal_area_square(Point2 p) {
  if (p.x < 0) {
    p = {-p.x, 1 - p.y};
  } else if (p.x > 1) {
    p = {2 - p.x, 1 - p.y};
  }
  if (p.y < 0) {
    p = {1 - p.x, -p.y};
  } else if (p.y > 1) {
    p = {1 - p.x, 2 - p.y};
  }
  return p;
}

}  // namespace kaustik
