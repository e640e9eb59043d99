#pragma once
// Scenes far from the world's origin are built around an origin of their own, near which floats are precise
// enough. Everything given in double (transforms, inline vertices, lights and the camera) is moved before it
// is rounded.

#include <glm/glm.hpp>

#include "core/scene/shapes/shape_source.h"

namespace kaustik {

// Axis-aligned box in double, metres; empty (min > max) until something is added.
struct ExactBounds {
  glm::dvec3 min{std::numeric_limits<double>::infinity()}, max{-std::numeric_limits<double>::infinity()};

  void add(const glm::dvec3& p) {
    min = glm::min(min, p);
    max = glm::max(max, p);
  }
  void add(const ExactBounds& b) {
    min = glm::min(min, b.min);
    max = glm::max(max, b.max);
  }
};

// Bounds of a shape before its transform: of all vertices with the precision in which they were written, or
// of the unit sphere or disk (taken as a ball) under source.local.
ExactBounds object_bounds(const ShapeDescription& shape, const ShapeSource& source);

// Bounds of the eight corners of a box after mapping; empty for an empty box.
ExactBounds mapped(const glm::dmat4& m, const ExactBounds& box);

// A scene is far if the centre of its shapes' box is farther from the world's origin than this many radii of
// the box. Up to that distance, floats are at most 2^-17 of the radius apart.
inline constexpr double kFarRadii = 64;

// The point to build the scene around: zero unless the scene is far, else the centre with each coordinate
// rounded to a multiple of the smallest power of two that is not less than the radius. So subtracting it from
// coordinates in the scene is exact, and scaling the scene by 2^k scales it by 2^k. Zero for boxes that are
// empty, without extent, or not finite.
glm::dvec3 local_origin(const ExactBounds& shapes);

}  // namespace kaustik
