#pragma once
// The interface of shapes that a formula gives, as opposed to meshes. Every such shape lives in a space of
// its own and is mapped to the world by to_world. An uv of a hit means the local x and y for shapes that are
// flat(), and nothing for others.
//
// The concept AnalyticShape lists what a type in the list of core/geometry/shape.h must have:
//   static constexpr std::string_view kName
//     name of its type in `kaustik info`
//   static constexpr uint32_t kMostCrossings
//     how often a straight line can meet it
//   Transform to_world
//   float intersect(ray, uv) const
//     t of the nearest intersection with 0 < t < ray.t_max, or kInfinity; sets *uv where the shape is flat
//   SurfacePoint at_hit(ray, t, uv) const
//     the point of the surface that such an intersection found, rebuilt so that its error does not grow with
//     the ray's length
//   Bounds3 bounds() const
//     in the world, with room for the error of points
//   double area() const
//     m^2
//   Bounds3 local_bounds() const
//     in its own space
//   swept() const
//     the shape as a SweptShape: itself, or one that holds it as a special case
//
// The concept SweptShape lists what areas, edges, texture coordinates and emission are made from: the surface
// as a grid over (s, phi), where s in [0, 1] leads from one end to the other, and the azimuth phi about the
// local z axis from 0 to turn(). All members but error() and the members above work in local space:
//   double turn() const
//     largest azimuth, in (0, 2 pi]
//   glm::dvec3 point_at(s, phi) const
//   glm::dvec3 normal_at(p) const
//     unit normal of the outside at a point of the surface
//   bool flat() const
//     lies in z = 0 with its outside on the side of +z
//   int strips(around) const
//     strips along s that go with `around` pieces of a full turn
//   double strip_at(t) const
//     s for t in [0, 1], so that equal steps of t make even strips
//   bool has_rim(end) const
//     the surface ends at s = 0 (end 0) or s = 1 (end 1)
//   double bend(area) const
//     m: the integral over the surface (area, in m^2) of the sum of its principal curvatures, up to uneven
//     scaling
//   LocalParameters parameters(p) const
//     uv and derivatives at a point of the surface
//   float error() const
//     bound on the error of a point along the normal, metres
//   bool keeps_areas_even() const
//     equal areas in local space are equal in the world
//   Point3 sample_uniform(u) const
//     uniformly distributed in local space, for u in [0, 1)^2; phi = turn() u.y
//   Point2 square_of(p) const
//     inverse of sample_uniform
//   float v_of(u_x) const
//     texture coordinate v of sample_uniform({u_x, ...})

#include <concepts>
#include <string_view>

#include "core/math/bounds.h"
#include "core/math/ray.h"
#include "core/math/transform.h"

namespace kaustik {

// A point of a surface in world space; n is the unit normal of its outside before Shape::flip_normal.
struct SurfacePoint {
  Point3 p{0};
  float p_error = 0;  // bound on |computed - true| along the normal, metres
  Normal3 n{0, 0, 1};
};

// As SurfaceParameters, in local space; the normal n need not be unit.
struct LocalParameters {
  Point2 uv{0};
  Vector3 dpdu{0}, dpdv{0};
  Normal3 n{0, 0, 1};
  Vector3 dndu{0}, dndv{0};
};

template <class S>
concept SweptShape = requires(const S& s, const Point2& u, const Point3& p, const glm::dvec3& q, double x,
                              float f, int n) {
  { s.to_world } -> std::convertible_to<Transform>;
  { s.turn() } -> std::same_as<double>;
  { s.point_at(x, x) } -> std::same_as<glm::dvec3>;
  { s.normal_at(q) } -> std::same_as<glm::dvec3>;
  { s.flat() } -> std::same_as<bool>;
  { s.strips(n) } -> std::same_as<int>;
  { s.strip_at(x) } -> std::same_as<double>;
  { s.has_rim(n) } -> std::same_as<bool>;
  { s.bend(x) } -> std::same_as<double>;
  { s.parameters(p) } -> std::same_as<LocalParameters>;
  { s.error() } -> std::same_as<float>;
  { s.keeps_areas_even() } -> std::same_as<bool>;
  { s.sample_uniform(u) } -> std::same_as<Point3>;
  { s.square_of(p) } -> std::same_as<Point2>;
  { s.v_of(f) } -> std::same_as<float>;
};

template <class G>
concept AnalyticShape = requires(const G& g, const Ray& ray, float t, Point2* uv) {
  { G::kName } -> std::convertible_to<std::string_view>;
  { G::kMostCrossings } -> std::convertible_to<uint32_t>;
  { g.to_world } -> std::convertible_to<Transform>;
  { g.intersect(ray, uv) } -> std::same_as<float>;
  { g.at_hit(ray, t, *uv) } -> std::same_as<SurfacePoint>;
  { g.bounds() } -> std::same_as<Bounds3>;
  { g.area() } -> std::same_as<double>;
  { g.local_bounds() } -> std::same_as<Bounds3>;
  { g.swept() } -> SweptShape;
};

// The local point of a hit: from its uv where the surface is flat, from the point in the world elsewhere.
template <SweptShape S>
Point3 local_point(const S& shape, const Point3& world, const Point2& hit_uv) {
  return shape.flat() ? Point3(hit_uv, 0) : shape.to_world.inverse_point(world);
}

// True when the linear map only rotates, mirrors and scales by one factor, up to the rounding of a chain of
// float matrices.
bool is_similarity(const glm::mat3& m);

}  // namespace kaustik
