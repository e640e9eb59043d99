// Properties that every analytic shape must have, run over the examples of all of them.

#include "core/geometry/analytic/analytic_shape.h"

#include <gtest/gtest.h>

#include "core/geometry/interaction.h"
#include "core/geometry/surface_parameters.h"
#include "core/geometry/tessellate.h"
#include "tests/core/support/chi_square.h"
#include "tests/core/support/shape_examples.h"
#include "tests/core/support/test_tracer.h"
#include "tests/support/random.h"
#include "tests/support/statistics.h"

namespace kaustik {
namespace {

using test::analytic_shapes;
using test::Random;

// Calls fn(shape, swept) for every example.
template <class Fn>
void for_each_example(const Fn& fn) {
  for (const Shape& shape : analytic_shapes()) {
    SCOPED_TRACE(::testing::Message() << name_of(shape) << " " << (&shape - analytic_shapes().data()));
    std::visit([&](const auto& swept) { fn(shape, swept); }, *swept_of(shape));
  }
}

float size_of(const Shape& shape) {
  return bounds_of(shape).radius();
}

Shape triangles_of(const Shape& shape) {
  Shape mesh;
  mesh.geometry = tessellated(shape);
  return mesh;
}

bool holds(const Bounds3& box, const Point3& p, float room) {
  return glm::all(glm::greaterThanEqual(p, box.min - room)) &&
         glm::all(glm::lessThanEqual(p, box.max + room));
}

TEST(AnalyticShape, BoundsHoldThePoints) {
  for_each_example([](const Shape& shape, const auto& swept) {
    Random random(1);
    const Bounds3 local = std::visit(
        []<class G>(const G& g) {
          if constexpr (AnalyticShape<G>) return g.local_bounds();
          return Bounds3();
        },
        shape.geometry);
    for (int i = 0; i < 2000; ++i) {
      const glm::dvec3 p = swept.point_at(double(random.uniform()), swept.turn() * double(random.uniform()));
      EXPECT_TRUE(holds(local, Point3(p), 1e-6f));
      EXPECT_TRUE(holds(bounds_of(shape), swept.to_world.point(Point3(p)), 0));
      EXPECT_NEAR(glm::length(swept.normal_at(p)), 1, 1e-6);
    }
  });
}

// The triangles' corners lie on the surface, 96 to a turn, so that they miss a share of about (pi / 96)^2 / 3
// of a round one's area, and of distances along rays.
TEST(AnalyticShape, AreaIsThatOfItsTriangles) {
  for_each_example([](const Shape& shape, const auto& /*swept*/) {
    const double area = surface_area(shape);
    EXPECT_NEAR(surface_area(triangles_of(shape)), area, 2e-3 * area);
  });
}

// Rays at the shape and at its triangles meet both or neither, but for a band along edges and silhouettes
// about as wide as the triangles are off: 5e-4 of the size. Hits lie on the ray, and their normal is the
// surface's.
TEST(AnalyticShape, RaysMeetWhatItsTrianglesShow) {
  for_each_example([](const Shape& shape, const auto& swept) {
    Random random(2);
    const std::vector<Shape> exact = {shape}, triangles = {triangles_of(shape)};
    const Bounds3 box = bounds_of(shape);
    const float size = size_of(shape);
    constexpr int kRays = 1500;
    int hits = 0, different = 0;
    for (int i = 0; i < kRays; ++i) {
      const Point3 from = box.center() + 2 * size * random.direction();
      const Point3 at = box.center() + 0.7f * size * random.direction();
      const Ray ray{from, glm::normalize(at - from)};
      const Hit hit = test::brute_force(exact, ray), of_mesh = test::brute_force(triangles, ray);
      different +=
          hit.valid() != of_mesh.valid() || (hit.valid() && std::abs(hit.t - of_mesh.t) > 0.05f * size);
      if (!hit.valid()) continue;
      ++hits;
      const SurfaceInteraction si = make_interaction(exact, ray, hit);
      EXPECT_LT(glm::distance(si.p, ray.at(hit.t)), 1e-4f * size);
      const Point3 local = local_point(swept, si.p, si.hit_uv);
      const Normal3 n = glm::normalize(swept.to_world.normal(Normal3(swept.normal_at(glm::dvec3(local)))));
      EXPECT_NEAR(glm::dot(n, si.n), 1, 1e-5);
    }
    EXPECT_GT(hits, kRays / 20);
    EXPECT_LT(different, kRays / 50);
  });
}

// An open end has a rim; a closed one is a single point, or is joined to the other end.
TEST(AnalyticShape, EndsWithoutARimAreClosed) {
  for_each_example([](const Shape& /*shape*/, const auto& swept) {
    for (const int end : {0, 1}) {
      if (swept.has_rim(end)) continue;
      double to_first = 0, to_other = 0;
      for (int i = 0; i < 16; ++i) {
        const double phi = swept.turn() * i / 16;
        const glm::dvec3 p = swept.point_at(end, phi);
        to_first = std::max(to_first, glm::distance(p, swept.point_at(end, 0)));
        to_other = std::max(to_other, glm::distance(p, swept.point_at(1 - end, phi)));
      }
      EXPECT_LT(std::min(to_first, to_other), 1e-6);
    }
  });
}

// Uniform samples have the centroid of the local surface, and lead back to their numbers and to the uv of the
// point.
TEST(AnalyticShape, SamplesAreUniformAndInvertible) {
  for_each_example([](const Shape& shape, const auto& swept) {
    auto local = swept;
    local.to_world = Transform();
    Shape in_own_space;
    in_own_space.geometry = local;
    const TriangleMesh mesh = tessellated(in_own_space);
    EXPECT_EQ(triangle_count(shape), mesh.indices.size());
    EXPECT_EQ(triangle_count(shape, 24), tessellated(shape, 24).indices.size());
    glm::dvec3 centroid(0);
    double area = 0;
    for (const auto& [a, b, c] : mesh.indices) {
      const glm::dvec3 p(mesh.P[a]), q(mesh.P[b]), r(mesh.P[c]);
      const double part = 0.5 * glm::length(glm::cross(q - p, r - p));
      area += part;
      centroid += part * (p + q + r) / 3.0;
    }
    centroid /= area;
    Random random(3);
    test::Mean mean[3];
    for (int i = 0; i < 20000; ++i) {
      const Point2 u = random.uniform_2d();
      const Point3 p = swept.sample_uniform(u);
      for (int c = 0; c < 3; ++c) mean[c].add(double(p[c]));
      const Point2 back = swept.square_of(p);
      EXPECT_NEAR(back.x, u.x, 1e-4);
      EXPECT_NEAR(back.y, u.y, 1e-4);
      const LocalParameters parameters = swept.parameters(p);
      EXPECT_NEAR(parameters.uv.x, u.y, 1e-4);
      EXPECT_NEAR(parameters.uv.y, swept.v_of(u.x), 1e-3);
    }
    // Triangles miss up to 2e-3 of the area.
    for (int c = 0; c < 3; ++c)
      EXPECT_NEAR(mean[c].mean, centroid[c], 4.5 * mean[c].standard_error() + 4e-3) << name_of(shape);
  });
}

// Derivatives against differences along u and v, away from the poles. Steps of 1e-3 turn the tangents by
// about as much.
TEST(AnalyticShape, TangentsAreDifferencesOfPoints) {
  for_each_example([](const Shape& /*shape*/, const auto& swept) {
    Random random(4);
    for (int i = 0; i < 200; ++i) {
      const Point2 u(random.uniform(0.1f, 0.9f), random.uniform(0.05f, 0.95f));
      const Point3 p = swept.sample_uniform(u);
      const LocalParameters at = swept.parameters(p);
      for (const Point2& step : {Point2(1e-3f, 0), Point2(0, 1e-3f)}) {
        const Point3 q = swept.sample_uniform(u + step);
        const Point2 duv = swept.parameters(q).uv - at.uv;
        const Vector3 expected = duv.x * at.dpdu + duv.y * at.dpdv, found = q - p;
        EXPECT_LT(glm::distance(expected, found), 0.02f * glm::length(found) + 1e-5f);
      }
    }
  });
}

}  // namespace
}  // namespace kaustik
