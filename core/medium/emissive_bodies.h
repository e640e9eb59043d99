#pragma once
// Directions towards media that emit light, for samples of that light.

#include <vector>

#include "core/math/bounds.h"
#include "core/medium/medium.h"

namespace kaustik {

// Spheres around bodies of media that emit. The light itself is not known here: it is whatever a ray meets.
// Media without bounds, and all but kMost bodies, are left to rays that happen to meet them.
class EmissiveBodies {
 public:
  // Most bodies that are kept: each direction takes a few operations for each.
  static constexpr size_t kMost = 8;

  // box: around a body of the medium, which emits.
  void add(const Bounds3& box, const Medium& medium);
  bool empty() const { return bodies_.empty(); }

  // A direction from p, and its density per solid angle; of density zero if there is none. u_body in [0, 1),
  // u in [0, 1)^2. Bodies are chosen in proportion to an estimate of the irradiance that they cause at p.
  struct Sample {
    Vector3 wi{0};
    float pdf = 0;
  };
  Sample sample(const Point3& p, float u_body, const Point2& u) const;
  // Density of sample(). wi: unit.
  float pdf(const Point3& p, const Vector3& wi) const;

 private:
  struct Body {
    Point3 center;
    float radius;
    float brightness;  // radiance in the middle, luminance
  };
  // The directions from a point towards a body: all of them from points within its sphere.
  struct Cone {
    Vector3 axis{0, 0, 1};
    float one_minus_cos = 2;
  };
  static Cone cone_of(const Body& body, const Point3& p);
  static float weight(const Body& body, const Cone& cone) { return body.brightness * cone.one_minus_cos; }

  std::vector<Body> bodies_;  // in descending order of brightness times radius^2
};

}  // namespace kaustik
