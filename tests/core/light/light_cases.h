#pragma once
// Instances of every light and every light surface, with reference points that see them.

#include <string>
#include <vector>

#include "core/light/light.h"
#include "tests/core/support/chi_square.h"
#include "tests/core/support/test_tracer.h"
#include "tests/support/random.h"

namespace kaustik::test {

struct LightCase {
  std::string name;
  Light light;
  std::vector<Shape> shapes;  // the shape of an area light
  std::vector<Point3> refs;   // lit points; the receiver in tests of flux lies at the first one
  Vector3 receiver_normal{0, 0, 1};
  float receiver_radius = 0.5f;
  int subdivisions = 40;  // of each chi-square bin; more where an outline crosses few bins
};

const std::vector<LightCase>& light_cases();

inline std::optional<EmissionSample> sample_Le(const Light& light, Random& random, EmissionMode mode) {
  const Point2 u_pos = random.uniform_2d();
  const Point2 u_dir = random.uniform_2d();
  return std::visit([&](const auto& l) { return l.sample_Le(u_pos, u_dir, mode); }, light);
}
inline std::optional<LightSample> sample_Li(const Light& light, const LightReceiver& x, Random& random) {
  return sample_Li(light, x, random.uniform_2d());
}

// A one-sided disk that receives light.
struct Receiver {
  Point3 center{0};
  Vector3 normal{0, 0, 1};
  float radius = 1;

  float area() const { return kPi * radius * radius; }
  Point3 point(const Point2& u) const;
  bool meets(const Ray& ray) const;
};
Receiver receiver_of(const LightCase& c);

// The case that tests sample_Li against pdf_Li of an area or infinite light at x, over the cone of directions
// that holds the light.
SquareCase direction_square(const LightCase& c, const LightReceiver& x);

}  // namespace kaustik::test
