#include "render/explore/place_grid.h"

#include <algorithm>

namespace kaustik::render {

PlaceGrid::PlaceGrid(const std::vector<VisiblePoint>& points, float cells) : cells_(cells) {
  Bounds3 bounds;
  for (const VisiblePoint& point : points) bounds.add(point.query.p);
  const Vector3 size = bounds.diagonal();
  const float widest = std::max({size.x, size.y, size.z});
  low_ = bounds.min;
  per_cell_ = widest > 0 ? cells / widest : 0;
}

uint64_t PlaceGrid::key(const Point3& p, const Normal3& n) const {
  const glm::vec3 cell = (p - low_) * per_cell_;
  const glm::uvec3 c(glm::floor(glm::clamp(cell, glm::vec3(-1), glm::vec3(cells_ + 1))) + 1.0f);
  return (uint64_t(c.x) << 40 | uint64_t(c.y) << 24 | uint64_t(c.z) << 8) | uint64_t(cube_side(n));
}

}  // namespace kaustik::render
