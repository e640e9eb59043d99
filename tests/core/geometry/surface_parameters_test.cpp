// Tests uv of shapes and its derivatives against values worked out by hand from the formulas of pbrt-v4's
// manual.

#include "core/geometry/surface_parameters.h"

#include <gtest/gtest.h>

#include <glm/gtc/matrix_transform.hpp>

namespace kaustik {
namespace {

SurfaceInteraction hit_from(const Shape& shape, const Point3& o, const Vector3& d) {
  const Ray ray{o, d};
  Hit hit{0, 0, 0, Point2(0)};
  std::visit(
      [&]<class G>(const G& g) {
        if constexpr (AnalyticShape<G>) hit.t = g.intersect(ray, &hit.uv);
      },
      shape.geometry);
  EXPECT_LT(hit.t, kInfinity);
  return make_interaction({shape}, ray, hit);
}

Shape sphere_of(const glm::dmat4& m = glm::dmat4(1)) {
  Shape shape;
  shape.geometry = Sphere{Transform::from_matrix(m)};
  return shape;
}

void expect_near(const Vector3& a, const Vector3& b, float tolerance) {
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(a[c], b[c], tolerance);
}

// u = phi / (2 pi) from +x towards +y; v = 0 at -z and 1 at +z. The tolerance of 4e-6 is a few float
// roundings.
TEST(SurfaceParameters, SphereMatchesPbrtsFormulas) {
  const Shape shape = sphere_of();
  const SurfaceParameters x = surface_parameters(shape, hit_from(shape, {3, 0, 0}, {-1, 0, 0}));
  expect_near({x.uv, 0}, {0, 0.5f, 0}, 4e-6f);
  expect_near(x.dpdu, {0, 2 * kPi, 0}, 4e-5f);
  expect_near(x.dpdv, {0, 0, kPi}, 4e-5f);
  const SurfaceParameters y = surface_parameters(shape, hit_from(shape, {0, -3, 0}, {0, 1, 0}));
  expect_near({y.uv, 0}, {0.75f, 0.5f, 0}, 4e-6f);
  const float s = std::sqrt(0.5f);  // 45 degrees above the equator: theta = pi / 4
  const SurfaceParameters z = surface_parameters(shape, hit_from(shape, {0, 3 * s, 3 * s}, {0, -s, -s}));
  expect_near({z.uv, 0}, {0.25f, 0.75f, 0}, 4e-6f);
}

// At the poles phi is undefined: the derivatives stay finite and linearly independent.
TEST(SurfaceParameters, PolesHaveFiniteIndependentDerivatives) {
  const Shape shape = sphere_of();
  for (const float z : {-3.0f, 3.0f}) {
    const SurfaceParameters pole = surface_parameters(shape, hit_from(shape, {0, 0, z}, {0, 0, -z}));
    EXPECT_NEAR(pole.uv.y, z > 0 ? 1 : 0, 4e-6f);
    EXPECT_GT(glm::length(glm::cross(pole.dpdu, pole.dpdv)), 0);
  }
}

// u = phi / (2 pi), v = (radius - r) / (radius - innerradius). At r = 3/4 of an annulus of inner radius 1/2,
// v = 1/2.
TEST(SurfaceParameters, DiskMatchesPbrtsFormulas) {
  Shape shape;
  shape.geometry = Disk{Transform::from_matrix(glm::scale(glm::dmat4(1), glm::dvec3(2))), 0.5f};
  const SurfaceParameters x = surface_parameters(shape, hit_from(shape, {0, 1.5f, 1}, {0, 0, -1}));
  expect_near({x.uv, 0}, {0.25f, 0.5f, 0}, 4e-6f);
  expect_near(x.dpdu, {-2 * kPi * 1.5f, 0, 0}, 4e-5f);
  expect_near(x.dpdv, {0, -1, 0}, 4e-6f);  // inward, by radius - innerradius = 1
}

Shape triangle_of(std::vector<Point2> uv, std::vector<Normal3> N = {}) {
  TriangleMesh mesh;
  mesh.P = {{0, 0, 0}, {2, 0, 0}, {0, 4, 0}};
  mesh.indices = {{0, 1, 2}};
  mesh.uv = std::move(uv);
  mesh.N = std::move(N);
  Shape shape;
  shape.geometry = std::move(mesh);
  return shape;
}

SurfaceParameters on_triangle(const Shape& shape, float b1, float b2) {
  return surface_parameters(shape, make_interaction({shape}, {}, {1, 0, 0, {b1, b2}}));
}

// Without uv the corners have (0, 0), (1, 0), (1, 1): at b = (1/2, 1/4, 1/4) uv = (1/2, 1/4). P(u, v) = P0 +
// u (P1 - P0) + v (P2 - P1).
TEST(SurfaceParameters, TriangleWithoutUvUsesDefaultCorners) {
  const SurfaceParameters s = on_triangle(triangle_of({}), 0.25f, 0.25f);
  EXPECT_EQ(s.uv, Point2(0.5f, 0.25f));
  EXPECT_EQ(s.dpdu, Vector3(2, 0, 0));
  EXPECT_EQ(s.dpdv, Vector3(-2, 4, 0));
}

TEST(SurfaceParameters, TriangleWithUvInterpolatesThem) {
  const SurfaceParameters s = on_triangle(triangle_of({{1, 1}, {1, 2}, {3, 1}}), 0.5f, 0.25f);
  EXPECT_EQ(s.uv, Point2(1.5f, 1.5f));
  EXPECT_EQ(s.dpdu, Vector3(0, 2, 0));
  EXPECT_EQ(s.dpdv, Vector3(2, 0, 0));
}

TEST(SurfaceParameters, ColoursAreInterpolatedAlsoWhereUvAreDegenerate) {
  for (const auto& uv : {std::vector<Point2>{}, std::vector<Point2>{{0, 0}, {1, 1}, {2, 2}}}) {
    Shape shape = triangle_of(uv);
    EXPECT_EQ(on_triangle(shape, 0.25f, 0.5f).colour, glm::vec4(1));
    std::get<TriangleMesh>(shape.geometry).colours = {{1, 0, 0, 1}, {0, 1, 0, 0}, {0, 0, 1, 0.5f}};
    EXPECT_EQ(on_triangle(shape, 0.25f, 0.5f).colour, glm::vec4(0.25f, 0.25f, 0.5f, 0.5f));
  }
}

// Where uv lie on one line the tangents are two perpendicular vectors of the triangle's size.
TEST(SurfaceParameters, DegenerateUvGiveAnyTangentFrame) {
  const SurfaceParameters s = on_triangle(triangle_of({{0, 0}, {1, 1}, {2, 2}}), 0.5f, 0.25f);
  EXPECT_NEAR(glm::length(glm::cross(s.dpdu, s.dpdv)), 4, 1e-5f);
  EXPECT_NEAR(s.dpdu.z, 0, 1e-6f);
}

// Compares dndu and dndv with differences of the shading normal over a step of 1e-2 in barycentrics. The
// second derivative of these normals is below 2, so the error is below 2e-2.
TEST(SurfaceParameters, NormalDerivativesMatchDifferences) {
  const Shape shape = triangle_of({}, {Normal3(-0.3f, 0, 1), Normal3(0.3f, 0, 1), Normal3(0, 0.5f, 1)});
  const auto ns = [&](float b1, float b2) { return make_interaction({shape}, {}, {1, 0, 0, {b1, b2}}).ns; };
  constexpr float kStep = 1e-2f;
  const SurfaceParameters s = on_triangle(shape, 0.25f, 0.25f);
  // Increasing u by one adds 1 to b1; increasing v by one adds 1 to b2 and takes 1 from b1.
  expect_near((ns(0.25f + kStep, 0.25f) - ns(0.25f, 0.25f)) / kStep, s.dndu, 2e-2f);
  expect_near((ns(0.25f - kStep, 0.25f + kStep) - ns(0.25f, 0.25f)) / kStep, s.dndv, 2e-2f);
}

// Compares the derivatives of ellipsoids, hit from inside and outside, with differences over 1e-3 in uv; the
// shifted point is found by the ray to it.
TEST(SurfaceParameters, EllipsoidDerivativesMatchDifferences) {
  const glm::dmat4 m =
      glm::scale(glm::rotate(glm::dmat4(1), 0.4, glm::dvec3(1, 2, 3)), glm::dvec3(1, 2, 0.5));
  for (const bool flip : {false, true}) {
    Shape shape = sphere_of(m);
    shape.flip_normal = flip;
    const auto at = [&](double u, double v) {
      const double phi = 2 * std::numbers::pi * u, theta = std::numbers::pi * (1 - v);
      const glm::dvec3 on(std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta));
      const glm::dvec3 p(glm::dmat3(m) * on);
      return hit_from(shape, Point3(2.0 * p), Vector3(-p));
    };
    const SurfaceInteraction si = at(0.3, 0.4), u = at(0.301, 0.4), v = at(0.3, 0.401);
    const SurfaceParameters s = surface_parameters(shape, si);
    expect_near({s.uv, 0}, {0.3f, 0.4f, 0}, 1e-5f);
    // The second derivatives are below (2 pi)^2 times the axes. The error is half of that times the step,
    // plus float rounding of 1e-6 over the step.
    constexpr float kTolerance = 0.5f * 40 * 2 * 1e-3f + 2e-3f;
    expect_near((u.p - si.p) / 0.001f, s.dpdu, kTolerance);
    expect_near((v.p - si.p) / 0.001f, s.dpdv, kTolerance);
    expect_near((u.ns - si.ns) / 0.001f, s.dndu, 4 * kTolerance);
    expect_near((v.ns - si.ns) / 0.001f, s.dndv, 4 * kTolerance);
  }
}

}  // namespace
}  // namespace kaustik
