// Tests the search for edges against a walk over all of them, and the removal of edges across which the
// surface continues.

#include "accel/edge_index.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>

#include "accel/bvh.h"
#include "tests/accel/support/random_scenes.h"

namespace kaustik::accel {
namespace {

using test::Placement;
using test::Random;

std::vector<BoundaryEdge> random_edges(Random& random, const Placement& place, int count) {
  std::vector<BoundaryEdge> edges;
  for (int i = 0; i < count; ++i) {
    const Point3 a = random.in_cube();
    const float size = random.uniform(0.001f, 0.3f);
    BoundaryEdge edge;
    edge.a = place.point(a);
    edge.b = place.point(a + size * random.direction());
    edge.surface_group = uint32_t(3 * random.uniform());
    edges.push_back(edge);
  }
  return edges;
}

// The distance by ternary search, which shares no formula with the index.
double distance(const BoundaryEdge& edge, const Point3& p) {
  const glm::dvec3 a(edge.a), b(edge.b), q(p);
  double low = 0, high = 1;
  for (int i = 0; i < 60; ++i) {
    const double t1 = low + (high - low) / 3, t2 = high - (high - low) / 3;
    (glm::distance(a + t1 * (b - a), q) < glm::distance(a + t2 * (b - a), q) ? high : low) =
        glm::distance(a + t1 * (b - a), q) < glm::distance(a + t2 * (b - a), q) ? t2 : t1;
  }
  return glm::distance(a + low * (b - a), q);
}

TEST(EdgeIndex, MatchesAWalkOverAllEdges) {
  for (const Placement& place : {Placement{}, Placement{1e-6f, {0, 0, 0}}, Placement{3e5f, {2, 0, -1}},
                                 Placement{1, {300, -200, 50}}}) {
    SCOPED_TRACE(place.scale);
    Random random(11);
    const EdgeIndex index(random_edges(random, place, 2000));
    size_t found_in_all = 0;
    for (int i = 0; i < 300; ++i) {
      const Point3 p = place.point(1.2f * random.in_cube());
      const float radius = place.scale * random.uniform(0, 0.3f);
      const uint32_t group = uint32_t(3 * random.uniform());
      std::vector<uint32_t> out(2000), expected;
      out.resize(index.find(p, radius, group, out));
      // The search minimises in double, to about 1e-8 of the edge's length; either answer is right for closer
      // calls.
      for (uint32_t e = 0; e < index.size(); ++e) {
        if (index[e].surface_group != group) continue;
        const double d = distance(index[e], p);
        if (std::abs(d - double(radius)) < 1e-7 * double(place.scale)) continue;
        if (d < double(radius)) expected.push_back(e);
      }
      EXPECT_EQ(out, expected);
      found_in_all += expected.size();
    }
    EXPECT_GT(found_in_all, 300u);
  }
}

TEST(EdgeIndex, ReportsMoreEdgesThanFit) {
  Random random(12);
  const EdgeIndex index(random_edges(random, {}, 500));
  std::vector<uint32_t> all(500);
  const size_t count = index.find({0, 0, 0}, 10, 1, all);
  ASSERT_GT(count, 50u);
  std::vector<uint32_t> exact(count), few(count - 1);
  EXPECT_EQ(index.find({0, 0, 0}, 10, 1, exact), count);
  EXPECT_TRUE(std::equal(exact.begin(), exact.end(), all.begin()));
  EXPECT_EQ(index.find({0, 0, 0}, 10, 1, few), count);  // one more than fit
  EXPECT_EQ(index.find({0, 0, 0}, 10, 1, std::span(few).first(3)), 4u);
}

TEST(EdgeIndex, EmptyIndexFindsNothing) {
  std::vector<uint32_t> out(1);
  EXPECT_EQ(EdgeIndex({}).find({0, 0, 0}, 1, 0, out), 0u);
  BoundaryEdge edge{{0, 0, 0}, {1, 0, 0}};
  edge.surface_group = 1;
  for (const uint32_t group : {0u, 2u, kNoIndex})
    EXPECT_EQ(EdgeIndex({edge}).find({0, 0, 0}, 1, group, out), 0u);
  EXPECT_EQ(EdgeIndex({edge}).find({0, 0, 0}, 1, 1, out), 1u);
}

std::vector<std::array<float, 6>> sorted_ends(const EdgeIndex& index, const std::vector<uint32_t>& found) {
  std::vector<std::array<float, 6>> ends;
  for (const uint32_t i : found) {
    const BoundaryEdge& e = index[i];
    ends.push_back({e.a.x, e.a.y, e.a.z, e.b.x, e.b.y, e.b.z});
  }
  std::sort(ends.begin(), ends.end());
  return ends;
}

// Three groups of about eight edges, which are searched without the tree.
TEST(EdgeIndex, SmallGroupsMatchAWalkOverAllEdges) {
  Random random(13);
  const std::vector<BoundaryEdge> edges = random_edges(random, {}, 24);
  const EdgeIndex few(edges);
  size_t found = 0;
  for (uint32_t group = 0; group < 3; ++group) {
    std::vector<BoundaryEdge> with_far = edges;
    BoundaryEdge far{{50, 0, 0}, {51, 0, 0}};
    far.surface_group = group;
    with_far.insert(with_far.end(), 100, far);
    const EdgeIndex tree(with_far);
    for (int i = 0; i < 200; ++i) {
      const Point3 p = random.in_cube();
      std::vector<uint32_t> a(24), b(24);
      a.resize(few.find(p, 0.7f, group, a));
      b.resize(tree.find(p, 0.7f, group, b));
      EXPECT_EQ(sorted_ends(few, a), sorted_ends(tree, b));
      found += a.size();
    }
  }
  EXPECT_GT(found, 100u);
}

void add_rectangle(Scene& scene, const Point3& p, const Vector3& a, const Vector3& b, uint32_t group) {
  TriangleMesh mesh;
  mesh.P = {p, p + a, p + a + b, p + b};
  mesh.indices = {{0, 1, 2}, {0, 2, 3}};
  Shape shape;
  shape.geometry = std::move(mesh);
  shape.surface_group = group;
  scene.shapes.push_back(std::move(shape));
}

size_t edges_left(Scene& scene) {
  test::finish(scene);
  const Bvh bvh(scene);
  return without_continued(find_boundary_edges(scene.shapes), bvh).size();
}

constexpr Placement kPlaces[] = {{}, {1e-5f, {0, 0, 0}}, {1e4f, {3, -2, 5}}, {0.01f, {10000, 0, 3000}}};

TEST(ContinuedEdges, RectangleKeepsItsFourEdges) {
  for (const Placement& at : kPlaces) {
    Scene scene;
    add_rectangle(scene, at.point({0, 0, 0}), {at.scale, 0, 0}, {0, at.scale, 0}, 0);
    EXPECT_EQ(edges_left(scene), 4u);
  }
}

// One large tile with two small ones along one of its sides.
TEST(ContinuedEdges, TJunctionsAreNotBorders) {
  for (const Placement& at : kPlaces) {
    Scene scene;
    const float s = at.scale;
    add_rectangle(scene, at.point({0, 0, 0}), {s, 0, 0}, {0, s, 0}, 0);
    add_rectangle(scene, at.point({1, 0, 0}), {s, 0, 0}, {0, 0.5f * s, 0}, 0);
    add_rectangle(scene, at.point({1, 0.5f, 0}), {0, 0.5f * s, 0}, {s, 0, 0}, 0);  // the other winding
    // Three edges of the large tile and two of each small one remain; the small tiles share the side between
    // them.
    EXPECT_EQ(edges_left(scene), 7u) << at.scale;
  }
}

TEST(ContinuedEdges, OtherGroupsAreBorders) {
  Scene scene;
  add_rectangle(scene, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}, 0);
  add_rectangle(scene, {1, -1, 0}, {1, 0, 0}, {0, 3, 0}, 1);
  EXPECT_EQ(edges_left(scene), 8u);
}

// A sheet of another group over the seam does not hide the tile behind it.
TEST(ContinuedEdges, IgnoresSurfacesOfOtherGroups) {
  Scene scene;
  add_rectangle(scene, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}, 0);
  add_rectangle(scene, {1, -1, 0}, {1, 0, 0}, {0, 3, 0}, 0);
  add_rectangle(scene, {0.5f, -2, 0x1p-12f}, {1, 0, 0}, {0, 5, 0}, 1);
  // The long tile's left side is continued only around its middle, for a third of its length, so it stays.
  EXPECT_EQ(edges_left(scene), 3u + 4 + 4);
}

TEST(ContinuedEdges, AllStayWhereTheSearchIsCancelled) {
  Scene scene;
  add_rectangle(scene, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}, 0);
  add_rectangle(scene, {1, -1, 0}, {1, 0, 0}, {0, 3, 0}, 0);
  test::finish(scene);
  const Bvh bvh(scene);
  const std::vector<BoundaryEdge> edges = find_boundary_edges(scene.shapes);
  EXPECT_LT(without_continued(edges, bvh, [] { return true; }).size(), edges.size());
  EXPECT_EQ(without_continued(edges, bvh, [] { return false; }).size(), edges.size());
}

}  // namespace
}  // namespace kaustik::accel
