// Tests the BVH against the brute-force oracle, and its contract: ranges, scale, threads.

#include "accel/bvh.h"

#include <gtest/gtest.h>

#include <cfenv>

#include "tests/accel/support/brute_force.h"
#include "tests/accel/support/random_scenes.h"
#include "tests/core/support/shape_examples.h"

namespace kaustik::accel {
namespace {

using test::BruteForce;
using test::Placement;
using test::Random;

// The oracle's answers for a ray and for its six neighbours, whose origins are moved by delta along the axes.
struct Neighbourhood {
  BruteForce::Nearest nearest;
  bool ambiguous = false;  // a neighbour meets another primitive: rounding may decide
  double t_spread = 0;     // largest change of t among the neighbours
};

Neighbourhood look(const BruteForce& oracle, const Ray& ray, double delta) {
  Neighbourhood n;
  n.nearest = oracle.intersect(ray);
  for (int axis = 0; axis < 3; ++axis) {
    for (double sign : {-1.0, 1.0}) {
      glm::dvec3 o = ray.o;
      o[axis] += sign * delta;
      const auto other = oracle.intersect(o, ray.d);
      n.ambiguous |= other.shape != n.nearest.shape || other.primitive != n.nearest.primitive;
      if (n.nearest.valid()) n.t_spread = std::max(n.t_spread, std::abs(other.t - n.nearest.t));
    }
  }
  return n;
}

// Float rounding moves a ray or a surface by a few units in the last place of the coordinates; delta is 64 of
// them. Where all neighbours of a ray meet the same primitive, the BVH must find it too, with a t within the
// spread of theirs.
void expect_matches_oracle(const Scene& scene, const Placement& place, Random& random, int rays) {
  const Bvh bvh(scene);
  const BruteForce oracle(scene);
  const float extent = place.scale * (2 + glm::length(place.offset));
  const double delta = 64.0 * std::numeric_limits<float>::epsilon() * extent;
  int compared = 0, hits = 0;
  for (int i = 0; i < rays; ++i) {
    const Ray ray{place.point(1.5f * random.in_cube()), random.direction()};
    const Neighbourhood expected = look(oracle, ray, delta);
    if (expected.ambiguous) continue;
    ++compared;
    const Hit hit = bvh.intersect(ray);
    ASSERT_EQ(hit.valid(), expected.nearest.valid()) << "ray " << i;
    const float t_max = place.scale * random.uniform(0.05f, 2);
    if (std::abs(t_max - expected.nearest.t) > expected.t_spread) {
      EXPECT_EQ(bvh.occluded({ray.o, ray.d, t_max}), expected.nearest.t < t_max) << "ray " << i;
      EXPECT_EQ(bvh.intersect({ray.o, ray.d, t_max}).valid(), expected.nearest.t < t_max) << "ray " << i;
    }
    if (!hit.valid()) continue;
    ++hits;
    EXPECT_EQ(hit.shape, expected.nearest.shape) << "ray " << i;
    EXPECT_EQ(hit.primitive, expected.nearest.primitive) << "ray " << i;
    EXPECT_NEAR(hit.t, expected.nearest.t, expected.t_spread) << "ray " << i;
  }
  EXPECT_GT(compared, rays * 8 / 10);
  EXPECT_GT(hits, rays / 10);
}

TEST(Bvh, MatchesBruteForceOnTriangles) {
  Random random(1);
  Scene scene;
  test::add_triangles(scene, random, {}, 300, 0.3f);
  test::finish(scene);
  expect_matches_oracle(scene, {}, random, 3000);
}

TEST(Bvh, MatchesBruteForceOnSpheres) {
  Random random(2);
  Scene scene;
  test::add_spheres(scene, random, {}, 150, false);
  test::add_spheres(scene, random, {}, 150, true);
  test::finish(scene);
  expect_matches_oracle(scene, {}, random, 3000);
}

TEST(Bvh, MatchesBruteForceOnDisks) {
  Random random(3);
  Scene scene;
  test::add_disks(scene, random, {}, 300);
  test::finish(scene);
  expect_matches_oracle(scene, {}, random, 3000);
}

TEST(Bvh, MatchesBruteForceOnQuadrics) {
  Random random(5);
  Scene scene;
  test::add_quadrics(scene, random, {}, 300);
  test::finish(scene);
  expect_matches_oracle(scene, {}, random, 3000);
}

glm::dmat4 matrix_of(const Transform& t) {
  glm::dmat4 m(glm::dmat3(t.linear));
  m[3] = glm::dvec4(glm::dvec3(t.translation), 1);
  return m;
}

// Copies of every example of every analytic shape, so that none is traced without being compared.
TEST(Bvh, MatchesBruteForceOnExamplesOfAllAnalyticShapes) {
  Random random(7);
  Scene scene;
  const Placement place;
  for (const Shape& example : kaustik::test::analytic_shapes()) {
    for (int copy = 0; copy < 15; ++copy) {
      Shape& shape = scene.shapes.emplace_back(example);
      const Frame frame = Frame::from_z(random.direction());
      const Transform to_place =
          place.transform(random.in_cube(), frame, Vector3(random.uniform(0.1f, 0.4f)));
      std::visit(
          [&]<class G>(G& g) {
            if constexpr (AnalyticShape<G>)
              g.to_world = Transform::from_matrix(matrix_of(to_place) * matrix_of(g.to_world));
          },
          shape.geometry);
    }
  }
  test::finish(scene);
  expect_matches_oracle(scene, place, random, 3000);
}

// Meshes of any size of their own, placed by maps of any kind.
TEST(Bvh, MatchesBruteForceOnInstances) {
  for (const float size : {1.0f, 1e-4f, 3e5f}) {
    for (const Placement& place : {Placement{}, Placement{1e-4f, {0, 0, 0}}, Placement{1, {100, -200, 50}}}) {
      SCOPED_TRACE(::testing::Message() << size << " scale " << place.scale << " offset " << place.offset.x);
      Random random(9);
      Scene scene;
      test::add_instances(scene, random, place, 20, 30, size);
      test::add_triangles(scene, random, place, 20, 0.3f);
      test::add_quadrics(scene, random, place, 20);
      test::add_instances(scene, random, place, 10, 15, 2 * size);
      test::finish(scene);
      expect_matches_oracle(scene, place, random, 1500);
    }
  }
}

TEST(Bvh, MatchesBruteForceOnMixedShapesAnywhere) {
  for (const Placement& place : {Placement{}, Placement{1e-4f, {0, 0, 0}}, Placement{3e4f, {0, 0, 0}},
                                 Placement{1, {100, -200, 50}}, Placement{1e-3f, {-500, 10, 1000}}}) {
    SCOPED_TRACE(::testing::Message() << "scale " << place.scale << " offset " << place.offset.x);
    Random random(4);
    Scene scene;
    test::add_triangles(scene, random, place, 50, 0.3f);
    test::add_spheres(scene, random, place, 50, false);
    test::add_triangles(scene, random, place, 50, 0.1f);
    test::add_disks(scene, random, place, 50);
    test::finish(scene);
    expect_matches_oracle(scene, place, random, 1500);
  }
}

TEST(Bvh, ScalingByPowersOfTwoScalesHitsExactly) {
  for (int k : {-40, -20, -19, -7, -1, 1, 2, 13, 20, 40}) {
    Random random(5), same(5);
    Scene scene, scaled;
    const float s = std::ldexp(1.0f, k);
    const auto fill = [](Scene& out, Random& r, const Placement& place) {
      test::add_triangles(out, r, place, 100, 0.3f);
      test::add_spheres(out, r, place, 50, true);
      test::add_disks(out, r, place, 50);
      test::finish(out);
    };
    const Placement place{1, {0.3f, 5, -2}};
    fill(scene, random, place);
    fill(scaled, same, {s, place.offset});
    const Bvh a(scene), b(scaled);
    int hits = 0;
    for (int i = 0; i < 2000; ++i) {
      const Ray ray{place.point(1.5f * random.in_cube()), random.direction()};
      SurfaceInteraction si, si_scaled;
      const bool hit = a.intersect(ray, &si);
      ASSERT_EQ(b.intersect({s * ray.o, ray.d}, &si_scaled), hit);
      if (!hit) continue;
      ++hits;
      const Hit h = a.intersect(ray), h_scaled = b.intersect({s * ray.o, ray.d});
      ASSERT_EQ(s * h.t, h_scaled.t) << "k = " << k;
      ASSERT_EQ(h.uv, h_scaled.uv);
      ASSERT_EQ(h.shape, h_scaled.shape);
      ASSERT_EQ(h.primitive, h_scaled.primitive);
      ASSERT_EQ(s * si.p, si_scaled.p);
      ASSERT_EQ(s * si.p_error, si_scaled.p_error);
      ASSERT_EQ(si.n, si_scaled.n);
    }
    EXPECT_GT(hits, 200);
  }
}

// Coincident triangles and shared edges give hits of equal t; which one wins must not depend on the number of
// threads that built the BVH.
TEST(Bvh, SameHitsForAnyNumberOfBuildThreads) {
  Random random(6);
  Scene scene;
  test::add_triangles(scene, random, {}, 50000, 0.1f);
  auto& mesh = std::get<TriangleMesh>(scene.shapes[0].geometry);
  const auto once = mesh.indices;
  for (int copy = 0; copy < 3; ++copy) mesh.indices.insert(mesh.indices.end(), once.begin(), once.end());
  scene.shapes.push_back(scene.shapes[0]);
  test::finish(scene);
  std::vector<std::vector<Hit>> results;
  for (int threads : {1, 2, 3, 8, 0, 1}) {
    const Bvh bvh(scene, threads);
    Random rays(7);
    auto& hits = results.emplace_back();
    for (int i = 0; i < 5000; ++i) hits.push_back(bvh.intersect({1.5f * rays.in_cube(), rays.direction()}));
  }
  for (size_t r = 1; r < results.size(); ++r) {
    for (size_t i = 0; i < results[0].size(); ++i) {
      const Hit &a = results[0][i], &b = results[r][i];
      ASSERT_EQ(a.t, b.t) << "run " << r << " ray " << i;
      ASSERT_EQ(a.shape, b.shape) << "run " << r << " ray " << i;
      ASSERT_EQ(a.primitive, b.primitive) << "run " << r << " ray " << i;
      ASSERT_EQ(a.uv, b.uv) << "run " << r << " ray " << i;
    }
  }
}

Scene unit_wall() {
  Scene scene;
  TriangleMesh mesh;
  mesh.P = {{-1, -1, 0}, {3, -1, 0}, {-1, 3, 0}};
  mesh.indices = {{0, 1, 2}};
  Shape shape;
  shape.geometry = mesh;
  scene.shapes.push_back(shape);
  test::finish(scene);
  return scene;
}

// A t_max up to the hit's distance blocks nothing; one float more does.
void expect_open_range(const Bvh& bvh, const Ray& ray) {
  const float t = bvh.intersect(ray).t;
  const std::pair<float, bool> cases[] = {
      {t, false}, {std::nextafter(t, kInfinity), true}, {0.0f, false}, {-1.0f, false}, {kInfinity, true}};
  for (const auto& [t_max, blocked] : cases) {
    EXPECT_EQ(bvh.intersect({ray.o, ray.d, t_max}).valid(), blocked) << t_max;
    EXPECT_EQ(bvh.occluded({ray.o, ray.d, t_max}), blocked) << t_max;
  }
}

TEST(Bvh, RangeIsOpenAtBothEndsOnTriangles) {
  const Scene scene = unit_wall();
  const Bvh bvh(scene);
  EXPECT_FLOAT_EQ(bvh.intersect({{0, 0, 2}, {0, 0, -1}}).t, 2.0f);
  EXPECT_FLOAT_EQ(bvh.intersect({{0, 0, 2}, {0, 0, -4}}).t, 0.5f);  // t is in units of |d|
  expect_open_range(bvh, {{0, 0, 2}, {0, 0, -1}});
  EXPECT_FALSE(bvh.intersect({{0, 0, 0}, {0, 0, -1}}).valid());  // t = 0 does not count
  EXPECT_FALSE(bvh.occluded({{0, 0, 0}, {0, 0, -1}}));
}

TEST(Bvh, RangeIsOpenAtBothEndsOnSpheresAndDisks) {
  Scene scene;
  scene.shapes.resize(2);
  scene.shapes[0].geometry = Sphere{};
  glm::dmat4 behind(1);
  behind[3] = {0, 0, -9, 1};
  scene.shapes[1].geometry = Disk{Transform::from_matrix(behind), 0};
  test::finish(scene);
  const Bvh bvh(scene);
  EXPECT_FLOAT_EQ(bvh.intersect({{0, 0, 3}, {0, 0, -1}}).t, 2.0f);
  expect_open_range(bvh, {{0, 0, 3}, {0, 0, -1}});
  EXPECT_FLOAT_EQ(bvh.intersect({{0, 0, -4}, {0, 0, -1}}).t, 5.0f);
  expect_open_range(bvh, {{0, 0, -4}, {0, 0, -1}});
}

TEST(Bvh, EmptySceneAndEmptyMeshHitNothing) {
  Scene scene;
  test::finish(scene);
  EXPECT_FALSE(Bvh(scene).intersect({{0, 0, 0}, {0, 0, 1}}).valid());
  Shape shape;
  shape.geometry = TriangleMesh{};
  scene.shapes.push_back(shape);
  EXPECT_FALSE(Bvh(scene).occluded({{0, 0, 0}, {0, 0, 1}}));
}

// Builds of Embree with assertions would end the program if such rays reached it.
TEST(Bvh, RaysOutOfReachMeetNothing) {
  const Scene scene = unit_wall();
  const Bvh bvh(scene);
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
  const Ray rays[] = {{{0, 0, 1e20f}, {0, 0, -1}},     {{0, -kInfinity, 2}, {0, 0, -1}},
                      {{kNan, 0, 2}, {0, 0, -1}},      {{0, 0, 2}, {0, 0, -2e18f}},
                      {{0, 0, 2}, {kInfinity, 0, -1}}, {{0, 0, 2}, {0, kNan, -1}}};
  RayLanes lanes{};
  for (size_t i = 0; i < std::size(rays); ++i) {
    EXPECT_FALSE(bvh.intersect(rays[i]).valid()) << i;
    EXPECT_FALSE(bvh.occluded(rays[i])) << i;
    for (int c = 0; c < 3; ++c) lanes.o[c][i] = rays[i].o[c], lanes.d[c][i] = rays[i].d[c];
  }
  const Ray met{{0, 0, 2}, {0, 0, -1}};
  for (int c = 0; c < 3; ++c) lanes.o[c][6] = met.o[c], lanes.d[c][6] = met.d[c];
  for (const RayOrder order : {RayOrder::kMixed, RayOrder::kNeighbours}) {
    HitLanes hits{};
    bvh.intersect(lanes, 7, &hits, order);
    for (size_t i = 0; i < 6; ++i) EXPECT_FALSE(hits.valid(i)) << i;
    EXPECT_EQ(hits.t[6], bvh.intersect(met).t);
    EXPECT_FLOAT_EQ(hits.t[6], 2);  // processors differ in how Embree rounds it
  }
}

TEST(Bvh, BuildLeavesDenormalsAloneAndReportsMemory) {
  const Scene scene = unit_wall();
  const Bvh bvh(scene);
  bvh.intersect({{0, 0, 2}, {0, 0, -1}});
  volatile float tiny = std::numeric_limits<float>::min();
  EXPECT_GT(tiny * 0.5f, 0.0f);
  EXPECT_GT(bvh.memory_bytes(), 0u);
}

TEST(Bvh, CanBeMoved) {
  const Scene scene = unit_wall();
  Bvh first(scene);
  const Bvh second = std::move(first);
  EXPECT_TRUE(second.occluded({{0, 0, 2}, {0, 0, -1}}));
}

}  // namespace
}  // namespace kaustik::accel
