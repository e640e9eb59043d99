// Tests the intersection of rays with spheres and disks, and surface points rebuilt from hits.

#include <gtest/gtest.h>

#include <array>

#include "core/geometry/analytic/sphere_lanes.h"
#include "core/geometry/interaction.h"
#include "tests/core/support/chi_square.h"
#include "tests/core/support/test_tracer.h"
#include "tests/support/random.h"
#include "tests/support/shapes.h"

namespace kaustik {
namespace {

using test::affine;
using test::Random;

Sphere unit_at(const Point3& center, float radius = 1) {
  return Sphere{Transform::from_matrix(affine(glm::dmat3(radius), center))};
}

// Solves the quadratic of a round sphere in double.
double sphere_reference(const Point3& center, double r, const Ray& ray) {
  const glm::dvec3 o = glm::dvec3(ray.o) - glm::dvec3(center), d(ray.d);
  const double a = glm::dot(d, d), b = glm::dot(o, d), c = glm::dot(o, o) - r * r;
  const double disc = b * b - a * c;
  if (disc < 0) return kInfinity;
  const double q = b > 0 ? -b - std::sqrt(disc) : -b + std::sqrt(disc);
  const double t0 = std::min(q / a, c / q), t1 = std::max(q / a, c / q);
  if (t0 > 0) return t0;
  return t1 > 0 ? t1 : kInfinity;
}

TEST(IntersectSphere, MatchesDoubleReference) {
  Random random(1);
  int hits = 0;
  for (int i = 0; i < 100000; ++i) {
    const Point3 center = 10.0f * random.direction();
    const float radius = random.uniform(0.1f, 12);
    const Point3 target = center + radius * random.uniform(0, 0.99f) * random.direction();
    const Point3 o = random.uniform(0, 30) * random.direction();
    const Ray ray{o, random.uniform(0.1f, 10) * (target - o)};
    const double expected = sphere_reference(center, radius, ray);
    const float t = intersect_sphere(unit_at(center, radius), ray);
    // Origins within rounding of the surface are skipped: rounding decides there between two roots.
    if (std::abs(glm::distance(o, center) - radius) < 1e-3f * (radius + 10)) continue;
    ASSERT_TRUE(std::isfinite(t) == std::isfinite(expected));
    if (!std::isfinite(expected)) continue;
    ++hits;
    // The ray aims up to 0.99 radii off the centre, which amplifies rounding by 1/sqrt(1 - 0.99^2) = 7.
    const double scale = (glm::length(o) + glm::length(center) + radius) / glm::length(ray.d);
    ASSERT_NEAR(t, expected, 64 * 0x1p-24 * scale);
  }
  EXPECT_GT(hits, 50000);
}

// From a distance of 10^6 radii the textbook quadratic has lost all precision. Here a grazing ray at 99 % of
// the radius must still hit, and one at 101 % must miss.
TEST(IntersectSphere, OutlineIsPreciseFromFarAway) {
  const Sphere s = unit_at({0, 0, 0});
  const float distance = 0x1p20f;
  EXPECT_TRUE(std::isfinite(intersect_sphere(s, {{0, 0.99f, -distance}, {0, 0, 1}})));
  EXPECT_FALSE(std::isfinite(intersect_sphere(s, {{0, 1.01f, -distance}, {0, 0, 1}})));
  EXPECT_EQ(intersect_sphere(s, {{0, 0, -distance}, {0, 0, 1}}), distance - 1);
}

TEST(IntersectSphere, OriginsInsideTangentsAndRangeLimits) {
  const Sphere s = unit_at({0, 0, 5}, 2);
  EXPECT_FLOAT_EQ(intersect_sphere(s, {{0, 0, 0}, {0, 0, 1}}), 3);
  EXPECT_FLOAT_EQ(intersect_sphere(s, {{0, 0, 5}, {0, 0, 1}}), 2);   // from the centre
  EXPECT_FLOAT_EQ(intersect_sphere(s, {{0, 0, 6}, {0, 0, -1}}), 3);  // from inside
  EXPECT_FLOAT_EQ(intersect_sphere(s, {{0, 0, 0}, {0, 0, 0.5f}}), 6);
  EXPECT_FALSE(std::isfinite(intersect_sphere(s, {{0, 0, 0}, {0, 0, -1}})));
  EXPECT_FALSE(std::isfinite(intersect_sphere(s, {{0, 0, 0}, {0, 0, 1}, 2.9f})));
  EXPECT_FALSE(std::isfinite(intersect_sphere(s, {{0, 0, 0}, {0, 0, 1}, 3})));  // t_max is excluded
  EXPECT_FLOAT_EQ(intersect_sphere(s, {{2, 0, 0}, {0, 0, 1}}), 5);              // tangent: touches exactly
  EXPECT_FALSE(std::isfinite(intersect_sphere(s, {{2.0001f, 0, 0}, {0, 0, 1}})));
}

TEST(IntersectSphere, EllipsoidAndItsNormal) {
  Shape shape;
  shape.geometry = Sphere{Transform::from_matrix(affine({3, 0, 0, 0, 1, 0, 0, 0, 2}, {1, 0, 0}))};
  const Ray ray{{10, 0.5f, 0}, {-1, 0, 0}};
  Hit hit = test::brute_force({shape}, ray);
  const double x = 3 * std::sqrt(0.75);
  EXPECT_NEAR(hit.t, 9 - x, 1e-5);
  const SurfaceInteraction si = make_interaction({shape}, ray, hit);
  EXPECT_LT(glm::distance(si.p, Point3(glm::dvec3(1 + x, 0.5, 0))), 4e-6);
  // The expected normal is the gradient of the implicit form.
  EXPECT_LT(glm::distance(si.n, Normal3(glm::normalize(glm::dvec3(x / 9, 0.5, 0)))), 1e-6);
}

TEST(IntersectDisk, HitsTheAnnulusOnly) {
  const Disk d{Transform::from_matrix(affine(glm::dmat3(2), {0, 0, 1})), 0.5f};
  Point2 uv;
  EXPECT_FALSE(std::isfinite(intersect_disk(d, {{0.9f, 0, 0}, {0, 0, 1}}, &uv)));
  EXPECT_FLOAT_EQ(intersect_disk(d, {{1.5f, 0, 0}, {0, 0, 1}}, &uv), 1);
  EXPECT_EQ(uv, Point2(0.75f, 0));
  EXPECT_FALSE(std::isfinite(intersect_disk(d, {{2.1f, 0, 0}, {0, 0, 1}}, &uv)));
  EXPECT_FALSE(std::isfinite(intersect_disk(d, {{1.5f, 0, 0}, {0, 0, -1}}, &uv)));
  EXPECT_FALSE(std::isfinite(intersect_disk(d, {{1.5f, 0, 0}, {1, 0, 0}}, &uv)));  // parallel
  EXPECT_FALSE(std::isfinite(intersect_disk(d, {{1.5f, 0, 1}, {1, 0, 0}}, &uv)));  // in its plane
  EXPECT_FALSE(std::isfinite(intersect_disk(d, {{1.5f, 0, 0}, {0, 0, 1}, 0.5f}, &uv)));
}

TEST(Interaction, NormalsFollowOrientation) {
  Shape shape = test::triangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0});
  const Ray ray{{0.25f, 0.25f, 1}, {0, 0, -1}};
  const Hit hit = test::brute_force({shape}, ray);
  EXPECT_EQ(make_interaction({shape}, ray, hit).n, Normal3(0, 0, 1));
  shape.flip_normal = true;
  EXPECT_EQ(make_interaction({shape}, ray, hit).n, Normal3(0, 0, -1));
  // Vertex normals take precedence over flip_normal and put n into their hemisphere.
  auto& mesh = std::get<TriangleMesh>(shape.geometry);
  mesh.N = {{0.6f, 0, 0.8f}, {0, 0, 1}, {0, 0, 1}};
  SurfaceInteraction si = make_interaction({shape}, ray, hit);
  EXPECT_EQ(si.n, Normal3(0, 0, 1));
  EXPECT_LT(glm::distance(si.ns, glm::normalize(Normal3(0.3f, 0, 0.9f))), 1e-6);
  for (Normal3& n : mesh.N) n = -n;
  si = make_interaction({shape}, ray, hit);
  EXPECT_EQ(si.n, Normal3(0, 0, -1));
  EXPECT_GT(glm::dot(si.n, si.ns), 0);
}

// In the first two, rounding loses the point of a ray from far away; the squares of the others' inverse maps
// are beyond the range of floats.
TEST(Interaction, RoundShapesHaveNormalsAtAnyScale) {
  constexpr float kFar = 0x1p60f, kLarge = 0x1p66f, kSmall = 0x1p-66f;
  struct Case {
    Quadric shape;
    Ray ray;
    float t;
  };
  const auto of_radius = [](float r) { return Transform::from_matrix(glm::dmat4(glm::dmat3(double(r)))); };
  for (const Case& c : {Case{{of_radius(0.5f)}, {{0, 0, kFar}, {0, 0, -1}}, kFar},
                        Case{{of_radius(0.5f), QuadricKind::kCylinder}, {{kFar, 0, 0}, {-1, 0, 0}}, kFar},
                        Case{{of_radius(kLarge)}, {Point3(0), {0, 0, 1}}, kLarge},
                        Case{{of_radius(kSmall)}, {Point3(0), {0, 0, 1}}, kSmall}}) {
    for (const SurfacePoint& at :
         {c.shape.at_hit(c.ray, c.t, {}), Sphere{c.shape.to_world}.at_hit(c.ray, c.t, {})}) {
      EXPECT_TRUE(is_finite(at.p)) << c.t;
      EXPECT_NEAR(glm::length(at.n), 1, 1e-6f) << c.t;
    }
  }
}

TEST(Interaction, CarriesTheShapesIndices) {
  std::vector<Shape> shapes = {test::sphere({0, 0, 5}, 1), test::sphere({0, 0, 10}, 1)};
  shapes[1].material = 3;
  shapes[1].light = 2;
  shapes[1].surface_group = 7;
  const Ray ray{{0, 0, 7}, {0, 0, 1}};
  const SurfaceInteraction si = make_interaction(shapes, ray, test::brute_force(shapes, ray));
  EXPECT_EQ(si.shape, 1u);
  EXPECT_EQ(si.material, 3u);
  EXPECT_EQ(si.light, 2u);
  EXPECT_EQ(si.surface_group, 7u);
  EXPECT_EQ(si.p, Point3(0, 0, 9));
  EXPECT_EQ(si.n, Normal3(0, 0, -1));
}

TEST(Shape, AreasAndBounds) {
  EXPECT_NEAR(surface_area(test::triangle({0, 0, 0}, {2, 0, 0}, {0, 3, 0})), 3, 1e-12);
  EXPECT_NEAR(surface_area(test::sphere({1, 2, 3}, 2)), 16 * std::numbers::pi, 1e-9);
  Shape shape;
  // Area of a prolate spheroid of half-axes 1, 1, c: 2 pi (1 + c/e asin e), e^2 = 1 - 1/c^2.
  const double c = 3, e = std::sqrt(1 - 1 / (c * c));
  shape.geometry = Sphere{Transform::from_matrix(affine({1, 0, 0, 0, c, 0, 0, 0, 1}, {0, 0, 0}))};
  // The quadrature's own error is of second order in 1/128.
  EXPECT_NEAR(surface_area(shape) / (2 * std::numbers::pi * (1 + c / e * std::asin(e))), 1, 1e-3);
  const Bounds3 b = bounds_of(shape);
  for (int axis = 0; axis < 3; ++axis) {
    EXPECT_GE(b.max[axis], axis == 1 ? c : 1);
    EXPECT_NEAR(b.max[axis], axis == 1 ? c : 1, 1e-4);
  }
  shape.geometry = Disk{Transform::from_matrix(affine({2, 0, 0, 0, 3, 0, 0, 0, 1}, {0, 0, 5})), 0.5f};
  EXPECT_NEAR(surface_area(shape), std::numbers::pi * 6 * 0.75, 1e-9);
  EXPECT_EQ(primitive_count(shape), 1u);
}

// Ellipsoids and spheres of all sizes, with origins inside, outside and on the surface, with and without
// t_max, and counts that do not fill a vector.
TEST(IntersectSphere, LanesMatchTheScalarCodeBitForBit) {
  Random random(5);
  int hits = 0;
  for (int i = 0; i < 20000; ++i) {
    glm::dmat3 linear(std::ldexp(1.0, static_cast<int>(random.uniform(-20, 20))));
    if (i % 2) linear[1] *= 3.0;
    const Point3 center = 10.0f * random.direction();
    const Sphere sphere{Transform::from_matrix(affine(linear, center))};
    alignas(64) float o[3][kSphereLanes], d[3][kSphereLanes], t_max[kSphereLanes], t[kSphereLanes];
    const float size = static_cast<float>(linear[0][0]);
    std::array<Ray, kSphereLanes> rays;
    for (size_t k = 0; k < kSphereLanes; ++k) {
      const float reach = k % 4 == 0 ? 1.0f : random.uniform(0, 3);
      const Point3 from = center + reach * size * random.direction();
      const Point3 to = center + random.uniform(0, 1.5f) * size * random.direction();
      rays[k] = {from, random.uniform(0.1f, 10) * (to - from), k % 3 ? kInfinity : random.uniform(0, 2)};
      for (int c = 0; c < 3; ++c) {
        o[c][k] = rays[k].o[c];
        d[c][k] = rays[k].d[c];
      }
      t_max[k] = rays[k].t_max;
    }
    const size_t count = i % 3 == 0 ? kSphereLanes : static_cast<size_t>(1 + i % 15);
    intersect_sphere_lanes(sphere, {{o[0], o[1], o[2]}, {d[0], d[1], d[2]}, t_max}, count, t);
    for (size_t k = 0; k < count; ++k) {
      ASSERT_EQ(t[k], intersect_sphere(sphere, rays[k])) << i << ' ' << k;
      hits += t[k] < kInfinity;
    }
  }
  EXPECT_GT(hits, 50000);
}

}  // namespace
}  // namespace kaustik
