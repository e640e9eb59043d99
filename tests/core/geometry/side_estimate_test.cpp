// Compares estimates of how triangles hang together with the edges that are found, and with counts by hand.

#include "core/geometry/side_estimate.h"

#include <gtest/gtest.h>

#include "core/geometry/boundary_edges.h"
#include "tests/support/random.h"
#include "tests/support/shapes.h"

namespace kaustik {
namespace {

// Columns from `rough` on have heights of several cells at random.
TriangleMesh square(uint32_t n, uint32_t rough) {
  test::Random random(1);
  return test::terrain(n, [&](uint32_t x, uint32_t) { return x < rough ? 0.0f : 9 * random.uniform(); });
}

// The mesh with vertices of its own for each triangle, as files without shared vertices have.
TriangleMesh taken_apart(const TriangleMesh& from) {
  TriangleMesh mesh;
  for (const auto& triangle : from.indices) {
    const auto at = static_cast<uint32_t>(mesh.P.size());
    for (const uint32_t i : triangle) mesh.P.push_back(from.P[i]);
    mesh.indices.push_back({at, at + 1, at + 2});
  }
  return mesh;
}

std::vector<Shape> one(TriangleMesh mesh) {
  return {test::mesh_shape(std::move(mesh))};
}

// Of the border, each side belongs to one triangle; two triangles in corners have two such sides.
TEST(SideEstimate, SmoothMeshesEndAtTheirBorder) {
  for (const TriangleMesh& mesh : {square(50, 99), taken_apart(square(50, 99))}) {
    const SideEstimate sides = estimate_sides(one(mesh));
    EXPECT_EQ(sides.open, 4 * 50);
    EXPECT_NEAR(sides.apart, ((4 * 50 - 4) * 1 + 2 * 4) / 9.0, 1e-9);
  }
}

TEST(SideEstimate, TrianglesThatTouchNoOtherLieApart) {
  TriangleMesh mesh;
  test::Random random(2);
  for (uint32_t i = 0; i < 3000; ++i) {
    mesh.P.push_back(random.uniform_3d());
    if (i % 3 == 2) mesh.indices.push_back({i - 2, i - 1, i});
  }
  const SideEstimate sides = estimate_sides(one(mesh));
  EXPECT_EQ(sides.open, 3000);
  EXPECT_NEAR(sides.apart, 1000, 1e-9);
}

// As pages of a book, whose number must not cost its square.
TEST(SideEstimate, ManyTrianglesMayHaveOneSide) {
  constexpr uint32_t kPages = 16'000;
  TriangleMesh mesh;
  mesh.P = {{0, 0, 0}, {0, 0, 1}};
  for (uint32_t i = 0; i < kPages; ++i) {
    const float phi = 2 * kPi * float(i) / kPages;
    mesh.P.push_back({std::cos(phi), std::sin(phi), 0});
    mesh.indices.push_back({0, 1, i + 2});
  }
  const SideEstimate sides = estimate_sides(one(mesh));
  EXPECT_EQ(sides.open, 3 * kPages);
  EXPECT_NEAR(sides.apart, kPages * 4 / 9.0, 1e-6);
}

TEST(SideEstimate, AgreesWithTheEdgesThatAreFound) {
  for (const uint32_t rough : {0u, 30u}) {
    const std::vector<Shape> shapes = one(square(60, rough));
    EXPECT_EQ(estimate_sides(shapes).open, double(find_boundary_edges(shapes).size()));
  }
}

// Some 30 of 45,000 sampled sides are at the border. Of those of the rough half, two thirds bend, which
// neighbours do together: the standard error is that of the triangles.
TEST(SideEstimate, IsMadeFromAFewTriangles) {
  const std::vector<Shape> shapes = one(square(500, 250));
  ASSERT_GT(primitive_count(shapes[0]), 20 * kSampledTriangles);
  const double found = double(find_boundary_edges(shapes).size());
  EXPECT_NEAR(estimate_sides(shapes).open, found, 4 * found / std::sqrt(double(kSampledTriangles) / 2));
}

TEST(SideEstimate, InstancesHaveEdgesOfTheirOwnUpToALimit) {
  const auto mesh = std::make_shared<const TriangleMesh>(square(50, 99));
  std::vector<Shape> shapes;
  const auto add = [&](size_t count) {
    for (size_t i = 0; i < count; ++i)
      shapes.emplace_back().geometry = InstancedMesh{mesh, {{0, 0, 0}, {50, 50, 0}}, {}};
  };
  add(10);
  EXPECT_EQ(estimate_sides(shapes).open, 200 + 10 * 200);
  add(kMostInstanceEdges / 200);
  EXPECT_EQ(estimate_sides(shapes).open, 200) << "beyond the limit, none are kept";
}

}  // namespace
}  // namespace kaustik
