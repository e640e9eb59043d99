#include "core/medium/density_grid.h"

#include <algorithm>
#include <cmath>

namespace kaustik {

namespace {

// A brick has so many cells along each axis. Cells lie between points; the first cell of an axis is that
// before point 0.
constexpr int kBrick = 8;

// Calls cell(index, begin, end) for the cells, cubes of this edge from `first` on, `counts` of them, that the
// part of the ray from begin to end crosses, one after the other, until it returns false (Amanatides and Woo
// 1987, "A Fast Voxel Traversal Algorithm for Ray Tracing"). The part must not leave them.
template <class Fn>
bool for_each_cell(const Point3& o, const Vector3& d, float begin, float end, float first, float edge,
                   const glm::ivec3& counts, const Fn& cell) {
  glm::ivec3 index(0);
  Vector3 next(0);
  const auto leave = [&](int a) {
    const float side = first + edge * float(index[a] + (d[a] > 0));
    return d[a] == 0 ? kInfinity : (side - o[a]) / d[a];
  };
  for (int a = 0; a < 3; ++a) {
    const float place = (o[a] + begin * d[a] - first) / edge;
    index[a] = place >= 0 ? int(std::min(std::floor(place), float(counts[a] - 1))) : 0;  // 0 for NaN, too
    next[a] = leave(a);
  }
  while (true) {
    const int a = next.x < next.y ? (next.x < next.z ? 0 : 2) : (next.y < next.z ? 1 : 2);
    const float to = std::min(next[a], end);
    if (to > begin) {
      if (!cell(index, begin, to)) return false;
      begin = to;
    }
    index[a] += d[a] > 0 ? 1 : -1;
    if (next[a] >= end || index[a] < 0 || index[a] >= counts[a]) return true;
    next[a] = leave(a);
  }
}

// Maps the world to the grid's points, whose coordinates begin with 0.
glm::dmat4 world_to_grid(const glm::ivec3& points, const glm::dmat4& box_to_world) {
  glm::dmat4 box_to_grid(1);
  for (int a = 0; a < 3; ++a) box_to_grid[a][a] = points[a], box_to_grid[3][a] = -0.5;
  return box_to_grid * glm::inverse(box_to_world);
}

}  // namespace

bool DensityGrid::can_place(const glm::ivec3& points, const glm::dmat4& box_to_world) {
  const glm::dmat4 m = world_to_grid(points, box_to_world);
  for (int column = 0; column < 4; ++column)
    if (!is_finite(Vector3(glm::dvec3(m[column])))) return false;
  return true;
}

DensityGrid::DensityGrid(const glm::ivec3& points, std::span<const double> values,
                         const glm::dmat4& box_to_world)
    : points_(points), brick_counts_((points + kBrick) / kBrick) {
  const glm::dmat4 to_grid = world_to_grid(points, box_to_world);
  to_grid_ = glm::mat3(to_grid);
  offset_ = Vector3(glm::dvec3(to_grid[3]));
  const glm::ivec3 padded = points + 2;
  values_.resize(size_t(padded.x) * size_t(padded.y) * size_t(padded.z));
  bricks_.resize(size_t(brick_counts_.x) * size_t(brick_counts_.y) * size_t(brick_counts_.z));
  size_t i = 0;
  for (int z = 0; z < points.z; ++z)
    for (int y = 0; y < points.y; ++y)
      for (int x = 0; x < points.x; ++x) {
        const auto value = float(values[i++]);
        values_[(size_t(z + 1) * size_t(padded.y) + size_t(y + 1)) * size_t(padded.x) + size_t(x + 1)] =
            value;
        largest_ = std::max(largest_, value);
        // A point is a corner of the cells x and x + 1, as they are counted here.
        for (int bz = z / kBrick; bz <= (z + 1) / kBrick; ++bz)
          for (int by = y / kBrick; by <= (y + 1) / kBrick; ++by)
            for (int bx = x / kBrick; bx <= (x + 1) / kBrick; ++bx) {
              float& most = bricks_[size_t((bz * brick_counts_.y + by) * brick_counts_.x + bx)];
              most = std::max(most, value);
            }
      }
}

float DensityGrid::at(const Point3& p) const {
  const Point3 in_grid = to_grid(p);
  return in_box(in_grid) ? interpolated(in_grid) : 0;
}

bool DensityGrid::in_box(const Point3& p) const {
  for (int a = 0; a < 3; ++a)
    if (!(p[a] >= -0.5f) || !(p[a] <= float(points_[a]) - 0.5f)) return false;
  return true;
}

// p: within half a cell of the points. What is read is in the grid for any other p, too, such as NaN.
float DensityGrid::interpolated(const Point3& p) const {
  size_t low[3];
  float part[3];
  for (int a = 0; a < 3; ++a) {
    const float below = p[a] >= 0 ? std::min(std::floor(p[a]), float(points_[a] - 1)) : -1.0f;
    low[a] = size_t(int(below) + 1);
    part[a] = std::clamp(p[a] - below, 0.0f, 1.0f);
  }
  const size_t row = size_t(points_.x) + 2, slice = row * (size_t(points_.y) + 2);
  const float* const corner = &values_[low[2] * slice + low[1] * row + low[0]];
  const auto along_x = [&](const float* v) { return v[0] + part[0] * (v[1] - v[0]); };
  const auto along_y = [&](const float* v) {
    const float below = along_x(v);
    return below + part[1] * (along_x(v + row) - below);
  };
  const float below = along_y(corner);
  return std::max(below + part[2] * (along_y(corner + slice) - below), 0.0f);
}

float DensityGrid::integral(const GridRay& ray, float begin, float end) const {
  const float middle = 0.5f * (begin + end), half = 0.5f * (end - begin), away = half * 0.57735027f;
  return half * (interpolated(ray.at(middle - away)) + interpolated(ray.at(middle + away)));
}

template <class Fn>
void DensityGrid::for_each_piece(const GridRay& ray, float begin, float end, const Fn& piece) const {
  for (int a = 0; a < 3; ++a) {
    const float inverse = 1 / ray.d[a], low = -0.5f - ray.o[a], high = float(points_[a]) - 0.5f - ray.o[a];
    if (ray.d[a] == 0) {
      if (low > 0 || high < 0) return;
      continue;
    }
    begin = std::max(begin, std::min(low * inverse, high * inverse));
    end = std::min(end, std::max(low * inverse, high * inverse));
  }
  if (!(begin < end)) return;
  for_each_cell(ray.o, ray.d, begin, end, -1, kBrick, brick_counts_,
                [&](const glm::ivec3& brick, float enter, float leave) {
                  const int number = (brick.z * brick_counts_.y + brick.y) * brick_counts_.x + brick.x;
                  if (bricks_[size_t(number)] == 0) return true;
                  return for_each_cell(ray.o, ray.d, enter, leave, -1, 1, points_ + 1,
                                       [&](const glm::ivec3&, float a, float b) { return piece(a, b); });
                });
}

float DensityGrid::column(const Ray& ray, float begin, float end) const {
  const GridRay in_grid = to_grid(ray);
  float sum = 0;
  for_each_piece(in_grid, begin, end, [&](float a, float b) {
    sum += integral(in_grid, a, b);
    return true;
  });
  return sum;
}

float DensityGrid::place_of(float column, const Ray& ray, float begin, float end) const {
  const GridRay in_grid = to_grid(ray);
  float place = end;
  for_each_piece(in_grid, begin, end, [&](float a, float b) {
    const float whole = integral(in_grid, a, b);
    if (whole < column) {
      column -= whole;
      return true;
    }
    // Newton's method, and bisection where that would leave the interval.
    float low = a, high = b;
    const float share = column / whole;
    place = share >= 0 && share <= 1 ? a + (b - a) * share : b;  // b where both overflow
    for (int i = 0; i < 24 && high - low > 0x1p-20f * (b - a); ++i) {
      const float over = integral(in_grid, a, place) - column, slope = interpolated(in_grid.at(place));
      (over > 0 ? high : low) = place;
      if (std::abs(over) <= 0x1p-20f * whole) break;
      const float newton = place - over / slope;
      place = newton > low && newton < high ? newton : 0.5f * (low + high);
    }
    return false;
  });
  return std::min(place, end);
}

ColumnTable::ColumnTable(const DensityGrid& grid, const Ray& ray, float end) {
  const DensityGrid::GridRay in_grid = grid.to_grid(ray);
  float sum = 0;
  grid.for_each_piece(in_grid, 0, end, [&](float a, float b) {
    if (entries_.empty() || entries_.back().t != a)
      entries_.push_back({a, sum, grid.interpolated(in_grid.at(a))});
    sum += grid.integral(in_grid, a, b);
    entries_.push_back({b, sum, grid.interpolated(in_grid.at(b))});
    return true;
  });
}

float ColumnTable::at(float t) const {
  const auto behind = std::upper_bound(entries_.begin(), entries_.end(), t,
                                       [](float place, const Entry& entry) { return place < entry.t; });
  if (behind == entries_.begin()) return 0;
  const Entry& a = behind[-1];
  if (behind == entries_.end()) return a.column;
  const Entry& b = *behind;
  const float width = b.t - a.t, u = (t - a.t) / width, v = 1 - u;
  const float cubic = a.column + (b.column - a.column) * u * u * (3 - 2 * u) +
                      width * u * v * (v * a.density - u * b.density);
  return std::clamp(cubic, a.column, b.column);
}

void ColumnTable::replace(std::span<float> places) const {
  for (float& place : places) place = at(place);
}

}  // namespace kaustik
