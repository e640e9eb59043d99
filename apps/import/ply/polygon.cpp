#include "apps/import/ply/polygon.h"

namespace kaustik::pbrt {
namespace {

using Corners = std::vector<uint32_t>;

// The polygon's mean normal by Newell's method; its length is twice the area.
glm::dvec3 mean_normal(std::span<const uint32_t> corners, const std::vector<Point3>& P) {
  glm::dvec3 n(0);
  const glm::dvec3 o(P[corners[0]]);
  for (size_t i = 1; i + 1 < corners.size(); ++i)
    n += glm::cross(glm::dvec3(P[corners[i]]) - o, glm::dvec3(P[corners[i + 1]]) - o);
  return n;
}

// Twice the area of a triangle as seen along n, times |n|; positive when it winds as the polygon does.
double turn(const std::vector<Point3>& P, const glm::dvec3& n, uint32_t a, uint32_t b, uint32_t c) {
  const glm::dvec3 p(P[a]);
  return glm::dot(n, glm::cross(glm::dvec3(P[b]) - p, glm::dvec3(P[c]) - p));
}

bool is_fan(std::span<const uint32_t> corners, const std::vector<Point3>& P, const glm::dvec3& n) {
  const size_t size = corners.size();
  for (size_t i = 0; i < size; ++i)
    if (turn(P, n, corners[i], corners[(i + 1) % size], corners[(i + 2) % size]) < 0) return false;
  for (size_t i = 1; i + 1 < size; ++i)
    if (turn(P, n, corners[0], corners[i], corners[i + 1]) < 0) return false;
  return true;
}

bool is_ear(const Corners& left, size_t i, const std::vector<Point3>& P, const glm::dvec3& n) {
  const size_t size = left.size();
  const uint32_t a = left[(i + size - 1) % size], b = left[i], c = left[(i + 1) % size];
  if (!(turn(P, n, a, b, c) > 0)) return false;
  for (const uint32_t p : left) {
    if (p == a || p == b || p == c) continue;
    if (turn(P, n, a, b, p) >= 0 && turn(P, n, b, c, p) >= 0 && turn(P, n, c, a, p) >= 0) return false;
  }
  return true;
}

}  // namespace

void triangulate(std::span<const uint32_t> corners, const std::vector<Point3>& P,
                 std::array<uint32_t, 3>* triangles) {
  const glm::dvec3 n = corners.size() > 3 ? mean_normal(corners, P) : glm::dvec3(0);
  if (corners.size() == 3 || corners.size() > kMostEars || is_fan(corners, P, n)) {
    for (size_t i = 1; i + 1 < corners.size(); ++i) *triangles++ = {corners[0], corners[i], corners[i + 1]};
    return;
  }
  Corners left(corners.begin(), corners.end());
  while (left.size() > 3) {
    size_t ear = 0;
    while (ear < left.size() && !is_ear(left, ear, P, n)) ++ear;
    if (ear == left.size()) ear = 1;  // a polygon that crosses itself may have no ear: cut off any corner
    const size_t size = left.size();
    *triangles++ = {left[(ear + size - 1) % size], left[ear], left[(ear + 1) % size]};
    left.erase(left.begin() + std::ptrdiff_t(ear));
  }
  *triangles = {left[0], left[1], left[2]};
}

}  // namespace kaustik::pbrt
