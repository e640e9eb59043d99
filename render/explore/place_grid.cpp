#include "render/explore/place_grid.h"

#include <algorithm>
#include <bit>

#include "core/sampling/sampler.h"

namespace kaustik::render {

namespace {

// Index, 0 to 5, of the cube's side through which the normal points.
uint64_t cube_side(const Normal3& n) {
  const int axis = largest_axis(glm::abs(n));
  return uint64_t(2 * axis + (n[axis] < 0));
}

}  // namespace

PlaceGrid::PlaceGrid(const std::vector<VisiblePoint>& points, float cells) : cells_(cells) {
  Bounds3 bounds;
  for (const VisiblePoint& point : points) bounds.add(point.query.p);
  const Vector3 size = bounds.diagonal();
  const float widest = std::max({size.x, size.y, size.z});
  low_ = bounds.min;
  per_cell_ = widest > 0 ? cells / widest : 0;
}

uint64_t PlaceGrid::key_of(const glm::vec3& cell, const Normal3& n) const {
  const glm::uvec3 c(glm::floor(glm::clamp(cell, glm::vec3(-1), glm::vec3(cells_ + 1))) + 1.0f);
  return (uint64_t(c.x) << 40 | uint64_t(c.y) << 24 | uint64_t(c.z) << 8) | cube_side(n);
}

uint64_t PlaceGrid::key(const Point3& p, const Normal3& n) const {
  return key_of((p - low_) * per_cell_, n);
}

uint64_t PlaceGrid::blurred_key(const Point3& p, const Normal3& n) const {
  glm::vec3 cell = (p - low_) * per_cell_;
  // Adding zero makes -0 and 0 the same.
  uint64_t hash = 0;
  for (int k = 0; k < 3; ++k) hash = hash_combine(hash, std::bit_cast<uint32_t>(cell[k] + 0.0f));
  for (int k = 0; k < 3; ++k) cell[k] += float(hash >> (21 * k) & 0x1fffff) * 0x1p-21f - 0.5f;
  return key_of(cell, n);
}

}  // namespace kaustik::render
