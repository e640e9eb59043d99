// Tests that edges in pieces become whole ones, and no others.

#include "core/geometry/merge_edges.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "tests/support/shapes.h"

namespace kaustik {
namespace {

// A mesh of n x n quads over [0, 1]^2.
Shape grid(uint32_t n, const std::function<Point3(float, float)>& place) {
  TriangleMesh mesh;
  for (uint32_t j = 0; j <= n; ++j)
    for (uint32_t i = 0; i <= n; ++i) mesh.P.push_back(place(float(i) / float(n), float(j) / float(n)));
  for (uint32_t j = 0; j < n; ++j)
    for (uint32_t i = 0; i < n; ++i) {
      const uint32_t a = j * (n + 1) + i, b = a + 1, c = a + n + 1, d = c + 1;
      mesh.indices.insert(mesh.indices.end(), {{a, b, c}, {b, d, c}});
    }
  return test::mesh_shape(std::move(mesh));
}

Shape flat_grid(uint32_t n, const Vector3& u, const Vector3& v, const Point3& corner = Point3(0)) {
  return grid(n, [=](float s, float t) { return corner + s * u + t * v; });
}

double length_of(const std::vector<BoundaryEdge>& edges) {
  double sum = 0;
  for (const BoundaryEdge& edge : edges) sum += glm::distance(glm::dvec3(edge.a), glm::dvec3(edge.b));
  return sum;
}

std::vector<BoundaryEdge> merged(const std::vector<Shape>& shapes) {
  return merge_edges(find_boundary_edges(shapes));
}

TEST(MergeEdges, SidesOfAGridBecomeFourEdges) {
  for (const uint32_t n : {1u, 2u, 7u, 32u}) {
    const std::vector<Shape> shapes = {flat_grid(n, {2, 0, 0}, {0, 0, 1})};
    ASSERT_EQ(find_boundary_edges(shapes).size(), 4 * n);
    const std::vector<BoundaryEdge> edges = merged(shapes);
    ASSERT_EQ(edges.size(), 4u) << n;
    EXPECT_FLOAT_EQ(float(length_of(edges)), 6) << n;
    for (const BoundaryEdge& edge : edges) {
      const Point3 middle = 0.5f * (edge.a + edge.b);
      EXPECT_GT(glm::dot(edge.outward, middle - Point3(1, 0, 0.5f)), 0) << n;
      EXPECT_EQ(edge.beyond, Normal3(0)) << n;
    }
  }
}

// The points of a slanting grid are rounded, each by up to half a unit in the last place.
TEST(MergeEdges, RoundedPointsOfAStraightLineAreMerged) {
  EXPECT_EQ(merged({flat_grid(24, {1.7f, 0.3f, -0.4f}, {0.2f, 1.1f, 0.7f}, {3.1f, -2.3f, 0.9f})}).size(), 4u);
}

TEST(MergeEdges, BothSidesOfABendBecomeOneEdgeEach) {
  const Shape roof = grid(16, [](float s, float t) { return Point3(s, t, std::abs(s - 0.5f)); });
  const std::vector<BoundaryEdge> edges = merged({roof});
  const auto bends = std::count_if(edges.begin(), edges.end(),
                                   [](const BoundaryEdge& edge) { return edge.beyond != Normal3(0); });
  EXPECT_EQ(bends, 2);
  EXPECT_EQ(edges.size(), 2u + 6u);  // each gable has two sides
}

TEST(MergeEdges, PolygonsStayAsTheyAre) {
  Shape disk;
  disk.geometry = Disk{};
  const std::vector<BoundaryEdge> rim = find_boundary_edges({disk});
  EXPECT_EQ(merge_edges(rim).size(), rim.size());
}

// An arc of facets so fine that each joint alone is straight within the tolerance: the edge must follow it.
TEST(MergeEdges, FineArcsAreFollowed) {
  const Shape ring = grid(64, [](float s, float t) {
    const float angle = 0.02f * s, radius = 1 + 0.1f * t;
    return Point3(radius * std::cos(angle), radius * std::sin(angle), 0);
  });
  const std::vector<BoundaryEdge> pieces = find_boundary_edges({ring}), edges = merge_edges(pieces);
  EXPECT_LT(edges.size(), pieces.size());
  for (const BoundaryEdge& piece : pieces) {
    const glm::dvec3 p(piece.a);
    double nearest = HUGE_VAL;
    for (const BoundaryEdge& edge : edges) {
      const glm::dvec3 a(edge.a), along = glm::dvec3(edge.b) - a;
      const double t = std::clamp(glm::dot(p - a, along) / glm::dot(along, along), 0.0, 1.0);
      nearest = std::min(nearest, glm::distance(p, a + t * along));
    }
    EXPECT_LE(nearest, 1.1 * 0x1p-19);
  }
}

TEST(MergeEdges, GapsAndOtherSurfacesKeepEdgesApart) {
  Shape near = flat_grid(4, {1, 0, 0}, {0, 1, 0}), far = flat_grid(4, {1, 0, 0}, {0, 1, 0}, {1.5f, 0, 0});
  EXPECT_EQ(merged({near, far}).size(), 8u);
  Shape next = flat_grid(4, {1, 0, 0}, {0, 1, 0}, {1, 0, 0});
  EXPECT_EQ(merged({near, next}).size(), 4u);  // one rectangle
  next.surface_group = 1;
  EXPECT_EQ(merged({near, next}).size(), 8u);
}

TEST(MergeEdges, ScaleByAPowerOfTwoScalesTheResult) {
  const auto scaled = [](float scale) {
    return merged({grid(9, [scale](float s, float t) {
      return scale * Point3(1.3f * s + 0.1f * t, 0.7f * t, 0.2f * s * s * s);
    })});
  };
  const std::vector<BoundaryEdge> one = scaled(1), small = scaled(0x1p-30f);
  ASSERT_EQ(one.size(), small.size());
  for (size_t i = 0; i < one.size(); ++i) {
    EXPECT_EQ(one[i].a * 0x1p-30f, small[i].a);
    EXPECT_EQ(one[i].b * 0x1p-30f, small[i].b);
  }
}

TEST(MergeEdges, NothingStaysNothing) {
  EXPECT_TRUE(merge_edges({}).empty());
}

}  // namespace
}  // namespace kaustik
