#include "render/explore/place_grid.h"

#include <algorithm>

namespace kaustik::render {

namespace {

Bounds3 box_of(const std::vector<VisiblePoint>& points) {
  Bounds3 bounds;
  for (const VisiblePoint& point : points) bounds.add(point.query.p);
  return bounds;
}

}  // namespace

float longest_side(const std::vector<VisiblePoint>& points) {
  const Vector3 size = box_of(points).diagonal();
  return points.empty() ? 0 : std::max({size.x, size.y, size.z});
}

PlaceGrid::PlaceGrid(const std::vector<VisiblePoint>& points, float cells)
    : low_(box_of(points).min), cells_(cells) {
  const float widest = longest_side(points);
  per_cell_ = widest > 0 ? cells / widest : 0;
}

uint64_t PlaceGrid::key(const Point3& p, const Normal3& n) const {
  const glm::vec3 cell = (p - low_) * per_cell_;
  const glm::uvec3 c(glm::floor(glm::clamp(cell, glm::vec3(-1), glm::vec3(cells_ + 1))) + 1.0f);
  return (uint64_t(c.x) << 40 | uint64_t(c.y) << 24 | uint64_t(c.z) << 8) | uint64_t(cube_side(n));
}

}  // namespace kaustik::render
