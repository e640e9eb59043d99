#pragma once
#include <variant>
#include <vector>

#include "core/geometry/interaction.h"
#include "core/light/light_types.h"
#include "core/sampling/discrete.h"

namespace kaustik {

// Surfaces that emit: their own copy of the geometry, in world space, oriented.
struct TriangleEmitter {
  struct Triangle {
    Point3 p0;
    Vector3 e1, e2;
    Normal3 n;  // unit, outside
  };
  std::vector<Triangle> triangles;
  DiscreteDistribution by_area;
};
struct SphereEmitter {
  Point3 center;
  float radius;
  bool inward = false;  // emits to the inside
};
struct QuadricEmitter {
  Quadric quadric;
  bool inward = false;  // emits to the inside
};
struct DiskEmitter {
  Transform to_world;
  float inner;
  Normal3 n;
};

// Lambertian emitter of constant radiance L (W/(m^2 sr)), on its outside or on both sides.
struct DiffuseAreaLight {
  static constexpr bool kDelta = false;
  static constexpr std::string_view kName = "diffuse";

  std::variant<TriangleEmitter, SphereEmitter, DiskEmitter, QuadricEmitter> surface;
  Rgb L{1};
  bool twosided = false;
  float area = 0;  // m^2, one side

  // Empty when the shape cannot emit by area sampling: a sphere or cylinder under a transform that does not
  // keep it round, or an instance.
  static std::optional<DiffuseAreaLight> make(const Shape& shape, const Rgb& L, bool twosided);

  // Radiance leaving point p with outside normal n in direction w (unit).
  Rgb Le(const Normal3& n, const Vector3& w) const { return twosided || glm::dot(n, w) > 0 ? L : Rgb(0); }
  std::optional<LightSample> sample_Li(const Point3& ref, const Point2& u) const;
  // on_light: the point of this lamp that the ray from ref in direction wi meets.
  float pdf_Li(const Point3& ref, const Vector3& wi, const SurfaceInteraction& on_light) const;
  std::optional<EmissionSample> sample_Le(const Point2& u_pos, const Point2& u_dir, EmissionMode mode) const;
  Rgb power() const { return (twosided ? 2.0f : 1.0f) * kPi * area * L; }
};

}  // namespace kaustik
