// Tests that a ray leaving a surface never meets it again, at any scale, and that scaling by 2^k scales every
// result exactly.

#include <gtest/gtest.h>

#include "core/geometry/interaction.h"
#include "tests/core/support/chi_square.h"
#include "tests/core/support/test_tracer.h"
#include "tests/support/random.h"
#include "tests/support/shapes.h"

namespace kaustik {
namespace {

using test::Random;

// A triangle test as in a robust float intersector: it works relative to the ray's origin and takes the plane
// distance from the rounded cross product.
bool float_triangle_hit(const TriangleMesh& mesh, const Ray& ray) {
  const Vector3 v0 = mesh.P[0] - ray.o, v1 = mesh.P[1] - ray.o, v2 = mesh.P[2] - ray.o;
  const Vector3 e0 = v2 - v0, e1 = v0 - v1, e2 = v1 - v2;
  const float u = glm::dot(glm::cross(e0, v2 + v0), ray.d);
  const float v = glm::dot(glm::cross(e1, v0 + v1), ray.d);
  const float w = glm::dot(glm::cross(e2, v1 + v2), ray.d);
  const bool inside = std::min(u, std::min(v, w)) >= 0 || std::max(u, std::max(v, w)) <= 0;
  const Vector3 n = glm::cross(e0, e1);
  const float t = glm::dot(v0, n) / glm::dot(ray.d, n);
  return inside && t > 0 && t < ray.t_max;
}

Shape scaled(const Shape& shape, float s) {
  Shape result = shape;
  if (auto* mesh = std::get_if<TriangleMesh>(&result.geometry)) {
    for (Point3& p : mesh->P) p *= s;
    return result;
  }
  auto& t = std::holds_alternative<Sphere>(result.geometry) ? std::get<Sphere>(result.geometry).to_world
                                                            : std::get<Disk>(result.geometry).to_world;
  t = Transform::from_matrix(test::affine(glm::dmat3(t.linear) * static_cast<double>(s), t.translation * s));
  return result;
}

bool meets(const Shape& shape, const Ray& ray) {
  if (const auto* mesh = std::get_if<TriangleMesh>(&shape.geometry)) return float_triangle_hit(*mesh, ray);
  return test::brute_force({shape}, ray).valid();
}

Point3 random_point(Random& random, float size) {
  return {random.uniform(-size, size), random.uniform(-size, size), random.uniform(-size, size)};
}

// The height is at least 1/50 of the longest edge: the float normal of thinner needles is itself imprecise.
Shape random_triangle(Random& random) {
  for (;;) {
    const Point3 at = random_point(random, std::exp2(random.uniform(-4, 10)));
    const float size = std::exp2(random.uniform(-4, 6));
    const Shape shape = test::triangle(at + random_point(random, size), at + random_point(random, size),
                                       at + random_point(random, size));
    const auto& P = std::get<TriangleMesh>(shape.geometry).P;
    const Vector3 a = P[1] - P[0], b = P[2] - P[0], c = P[2] - P[1];
    const float longest2 = std::max(length_squared(a), std::max(length_squared(b), length_squared(c)));
    if (glm::length(glm::cross(a, b)) > 0.02f * longest2) return shape;
  }
}

Shape random_sphere(Random& random) {
  return test::sphere(random_point(random, std::exp2(random.uniform(-4, 10))),
                      std::exp2(random.uniform(-4, 6)));
}

// Rotated, with unequal half-axes within a factor of eight.
Shape random_ellipsoid(Random& random) {
  const Frame f = Frame::from_z(random.direction());
  glm::mat3 m(f.x, f.y, f.z);
  for (int c = 0; c < 3; ++c) m[c] *= std::exp2(random.uniform(0, 3));
  Shape shape;
  shape.geometry = Sphere{Transform::from_matrix(test::affine(glm::dmat3(m), random_point(random, 100)))};
  return shape;
}

Shape random_disk(Random& random) {
  Shape shape = random_ellipsoid(random);
  const Transform t = std::get<Sphere>(shape.geometry).to_world;
  shape.geometry = Disk{t, 0.25f};
  return shape;
}

// A hit at a random place of the shape, by a ray from outside.
bool random_hit(Random& random, const Shape& shape, Ray* ray, Hit* hit) {
  const Bounds3 b = bounds_of(shape);
  const Point3 o = b.center() + 3 * b.radius() * random.direction();
  Point3 target = b.center() + 0.5f * b.radius() * random.direction();
  if (const auto* mesh = std::get_if<TriangleMesh>(&shape.geometry)) {
    const float r = random.uniform(), s = random.uniform() * (1 - r);
    target = mesh->P[0] + (r * (mesh->P[1] - mesh->P[0]) + s * (mesh->P[2] - mesh->P[0]));
  }
  *ray = {o, glm::normalize(target - o)};
  *hit = test::brute_force({shape}, *ray);
  return hit->valid();
}

// A direction on a random side of the surface, often a grazing one.
Vector3 random_leaving(Random& random, const Normal3& n) {
  const Vector3 w = random.direction();
  const float grazing = std::exp2(-random.uniform(0, 20));
  return glm::normalize(w - (1 - grazing) * glm::dot(w, n) * n);
}

using Generator = Shape (*)(Random&);

void expect_no_self_hits(Generator generate, bool closed) {
  Random random(1);
  int tested = 0;
  for (int i = 0; i < 200000; ++i) {
    const Shape shape = generate(random);
    Ray ray;
    Hit hit;
    if (!random_hit(random, shape, &ray, &hit)) continue;
    const SurfaceInteraction si = make_interaction({shape}, ray, hit);
    const Vector3 w = random_leaving(random, si.n);
    if (closed && glm::dot(w, si.n) < 0) continue;  // crosses the inside and meets the far wall
    ASSERT_FALSE(meets(shape, si.spawn(w))) << i;
    ++tested;
  }
  EXPECT_GT(tested, 20000);
}

TEST(OffsetOrigin, NoSelfHitsOnTriangles) {
  expect_no_self_hits(random_triangle, false);
}
TEST(OffsetOrigin, NoSelfHitsOnSpheres) {
  expect_no_self_hits(random_sphere, true);
}
TEST(OffsetOrigin, NoSelfHitsOnEllipsoids) {
  expect_no_self_hits(random_ellipsoid, true);
}
TEST(OffsetOrigin, NoSelfHitsOnDisks) {
  expect_no_self_hits(random_disk, false);
}

// A ray into a sphere next hits the far wall, at a chord of 2 r cos, never its entry point.
TEST(OffsetOrigin, RefractedRayReachesTheFarWall) {
  Random random(2);
  for (int i = 0; i < 100000; ++i) {
    const Shape shape = random_sphere(random);
    Ray ray;
    Hit hit;
    if (!random_hit(random, shape, &ray, &hit)) continue;
    const SurfaceInteraction si = make_interaction({shape}, ray, hit);
    const Vector3 w = random.direction();
    const float cosine = -glm::dot(w, si.n);
    if (cosine < 0.05f) continue;
    const Hit far_hit = test::brute_force({shape}, si.spawn(w));
    ASSERT_TRUE(far_hit.valid());
    const float radius = std::get<Sphere>(shape.geometry).to_world.linear[0].x;
    // At the end of the chord the angle between sphere and ray has the cosine `cosine`, which divides the
    // offset's error.
    ASSERT_NEAR(far_hit.t, 2 * radius * cosine, 4 * (si.p_error + 16 * 0x1p-24f * radius) / cosine);
  }
}

// Hit, surface point, error bound and next origin at scale 2^k are exactly those at scale one times 2^k.
void expect_exact_scaling(Generator generate) {
  Random random(3);
  for (int i = 0; i < 2000; ++i) {
    const Shape shape = generate(random);
    Ray ray;
    Hit hit;
    if (!random_hit(random, shape, &ray, &hit)) continue;
    const SurfaceInteraction si = make_interaction({shape}, ray, hit);
    const Vector3 w = random.direction();
    for (const float s : {0x1p-20f, 0x1p-7f, 0x1p1f, 0x1p20f}) {
      const Shape big = scaled(shape, s);
      const Ray big_ray{ray.o * s, ray.d};
      const Hit big_hit = test::brute_force({big}, big_ray);
      const SurfaceInteraction big_si = make_interaction({big}, big_ray, big_hit);
      ASSERT_EQ(big_hit.t, hit.t * s);
      ASSERT_EQ(big_si.p, si.p * s);
      ASSERT_EQ(big_si.p_error, si.p_error * s);
      ASSERT_EQ(big_si.n, si.n);
      ASSERT_EQ(big_si.spawn(w).o, si.spawn(w).o * s);
    }
  }
}

TEST(OffsetOrigin, TrianglesScaleExactly) {
  expect_exact_scaling(random_triangle);
}
TEST(OffsetOrigin, SpheresScaleExactly) {
  expect_exact_scaling(random_sphere);
}
TEST(OffsetOrigin, EllipsoidsScaleExactly) {
  expect_exact_scaling(random_ellipsoid);
}
TEST(OffsetOrigin, DisksScaleExactly) {
  expect_exact_scaling(random_disk);
}

}  // namespace
}  // namespace kaustik
