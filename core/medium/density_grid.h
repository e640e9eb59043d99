#pragma once
// Densities at the points of a regular grid, for media that are not the same everywhere.
//
// Along a ray, the density between two planes of the grid is a polynomial of third degree, whose integral a
// Gauss rule of two points gives exactly. So nothing about such media is random that is not so in others:
// neither what they let through nor, given a random number, how far light goes.

#include <span>
#include <vector>

#include "core/math/ray.h"

namespace kaustik {

// The density is interpolated between the eight points around a place, is zero at points beyond the grid's
// last, and ends at the sides of its box: as pbrt-v4 has it (Pharr 2023, section 11.4).
class DensityGrid {
 public:
  // values: one for each point, x changing fastest, finite and not negative. The points are the centres of
  // equal cells of the unit cube, which box_to_world takes to the world: can_place() must hold.
  DensityGrid(const glm::ivec3& points, std::span<const double> values, const glm::dmat4& box_to_world);

  // Whether the map from the world to the grid is finite in float precision.
  static bool can_place(const glm::ivec3& points, const glm::dmat4& box_to_world);

  float at(const Point3& p) const;
  float largest() const { return largest_; }
  const glm::ivec3& points() const { return points_; }

  // Column density of the part of a ray between two places: the integral of the density, in metres. The ray's
  // direction is unit; the places are metres from its start, of which `end` may be infinite.
  float column(const Ray& ray, float begin, float end) const;
  // The place of a ray, from `begin` to `end`, up to which there is that much column density; `end` if there
  // is less.
  float place_of(float column, const Ray& ray, float begin, float end) const;

 private:
  friend class ColumnTable;

  // A ray in units of the grid, whose points have integral coordinates from 0 on.
  struct GridRay {
    Point3 o;
    Vector3 d;
    Point3 at(float t) const { return o + t * d; }
  };

  Point3 to_grid(const Point3& p) const { return to_grid_ * p + offset_; }
  GridRay to_grid(const Ray& ray) const { return {to_grid(ray.o), to_grid_ * ray.d}; }
  bool in_box(const Point3& p) const;
  float interpolated(const Point3& p) const;
  float integral(const GridRay& ray, float begin, float end) const;
  // Calls piece(begin, end) for the parts of the ray between planes of the grid, one after the other, leaving
  // out those where bricks of cells are empty, until it returns false.
  template <class Fn>
  void for_each_piece(const GridRay& ray, float begin, float end, const Fn& piece) const;

  glm::ivec3 points_, brick_counts_;
  glm::mat3 to_grid_;
  Vector3 offset_;
  std::vector<float> values_;  // with a border of zeros
  std::vector<float> bricks_;  // largest density in each
  float largest_ = 0;
};

// Column densities from a ray's start on, for many places on it.
class ColumnTable {
 public:
  // ray: of unit direction; end: metres, may be infinite.
  ColumnTable(const DensityGrid& grid, const Ray& ray, float end);

  // Up to t metres from the ray's start, at most `end`. Exact where the ray crosses a plane of the grid;
  // cubic in between, by the densities there.
  float at(float t) const;
  // Replaces places by the column densities up to them.
  void replace(std::span<float> places) const;

 private:
  struct Entry {
    float t, column, density;
  };
  std::vector<Entry> entries_;
};

}  // namespace kaustik
