#pragma once
// Instances of every light and light surface, with reference points from which they are seen.

#include <string>
#include <vector>

#include "core/light/light.h"
#include "tests/core/support/statistics.h"
#include "tests/core/support/test_tracer.h"

namespace kaustik::test {

struct LightCase {
  std::string name;
  Light light;
  std::vector<Shape> shapes;  // the one of an area light
  std::vector<Point3> refs;   // lit points; the receiver of fluxes lies at the first one
  Vector3 receiver_normal{0, 0, 1};
  float receiver_radius = 0.5f;
  int subdivisions = 40;  // of a chi-square bin: more where few bins hold much of an outline
};

const std::vector<LightCase>& light_cases();

inline std::optional<EmissionSample> sample_Le(const Light& light, IndependentRandom& random,
                                               EmissionMode mode) {
  const Point2 u_pos = random.next_2d();
  const Point2 u_dir = random.next_2d();
  return std::visit([&](const auto& l) { return l.sample_Le(u_pos, u_dir, mode); }, light);
}
inline std::optional<LightSample> sample_Li(const Light& light, const LightReceiver& x,
                                            IndependentRandom& random) {
  return sample_Li(light, x, random.next_2d());
}

// One-sided disk that catches light.
struct Receiver {
  Point3 center{0};
  Vector3 normal{0, 0, 1};
  float radius = 1;

  float area() const { return kPi * radius * radius; }
  Point3 point(const Point2& u) const;
  bool meets(const Ray& ray) const;
};
Receiver receiver_of(const LightCase& c);

// sample_Li and pdf_Li of an area or infinite light at x, over the cone of directions that holds the light.
SquareCase direction_square(const LightCase& c, const LightReceiver& x);

}  // namespace kaustik::test
