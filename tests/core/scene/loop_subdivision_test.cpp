#include "core/scene/shapes/loop_subdivision.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "core/memory/process_memory.h"
#include "tests/support/random.h"
#include "tests/support/shapes.h"

namespace kaustik {
namespace {

TriangleMesh octahedron() {
  TriangleMesh mesh;
  mesh.P = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
  mesh.indices = {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}};
  return mesh;
}

TriangleMesh flat_square(uint32_t n) {
  return test::terrain(n, [](uint32_t, uint32_t) { return 0.0f; });
}

TriangleMesh subdivided(const TriangleMesh& cage, int levels) {
  std::string error;
  auto mesh = subdivide_loop(cage, levels, &error);
  EXPECT_EQ(error, "");
  return mesh.value_or(TriangleMesh{});
}

// The vertices of each level lie on the limit surface, so finer levels keep them.
TEST(LoopSubdivision, EveryLevelLiesOnTheSameSurface) {
  const TriangleMesh coarse = subdivided(octahedron(), 1), fine = subdivided(octahedron(), 4);
  EXPECT_EQ(fine.indices.size(), 8u << 8);
  ASSERT_LT(coarse.P.size(), fine.P.size());
  // Refinement keeps the numbering of the vertices. Positions are computed in double and rounded to float
  // once.
  for (size_t i = 0; i < coarse.P.size(); ++i) {
    EXPECT_LT(glm::distance(coarse.P[i], fine.P[i]), 1e-6f);
    EXPECT_LT(glm::distance(coarse.N[i], fine.N[i]), 1e-5f);
  }
}

// The limit of a vertex of valence 4 is (1 - 4 g) p + g (ring) with g = 1 / (4 + 3 / (8 beta)), beta = 3 /
// 32. The ring sums to zero, so the octahedron's corners move to 1 - 4 / 8.
TEST(LoopSubdivision, OctahedronsCornersReachTheirLimit) {
  const TriangleMesh mesh = subdivided(octahedron(), 0);
  for (size_t i = 0; i < 6; ++i) {
    EXPECT_LT(glm::distance(mesh.P[i], 0.5f * octahedron().P[i]), 1e-6f);
    EXPECT_LT(glm::distance(mesh.N[i], octahedron().P[i]), 1e-6f);  // outward, by the winding
  }
}

// With each level the normals come closer to those of the facets.
TEST(LoopSubdivision, NormalsFitTheFacets) {
  const TriangleMesh mesh = subdivided(octahedron(), 5);
  for (const auto& [a, b, c] : mesh.indices) {
    const Normal3 n = glm::normalize(glm::cross(mesh.P[b] - mesh.P[a], mesh.P[c] - mesh.P[a]));
    for (const uint32_t i : {a, b, c}) ASSERT_GT(glm::dot(n, mesh.N[i]), 0.98f);
  }
}

TEST(LoopSubdivision, FlatMeshesStayFlatToTheirBoundary) {
  const TriangleMesh mesh = subdivided(flat_square(3), 3);
  float right = 0;
  for (size_t i = 0; i < mesh.P.size(); ++i) {
    EXPECT_EQ(mesh.P[i].z, 0);
    EXPECT_LT(glm::distance(mesh.N[i], Normal3(0, 0, 1)), 1e-6f) << i;
    right = std::max(right, mesh.P[i].x);
  }
  EXPECT_NEAR(right, 3, 1e-6);  // straight parts of the boundary do not move
}

TEST(LoopSubdivision, RefusesMeshesWithoutALimit) {
  const auto error_of = [](TriangleMesh cage, int levels = 1) {
    std::string error;
    EXPECT_FALSE(subdivide_loop(cage, levels, &error));
    return error;
  };
  TriangleMesh mesh = octahedron();
  mesh.indices.push_back({0, 2, 1});
  EXPECT_EQ(error_of(mesh), "the edge of vertices 0 and 2 has more than two triangles");
  mesh = octahedron();
  std::swap(mesh.indices[0][0], mesh.indices[0][1]);
  EXPECT_NE(error_of(mesh).find("two triangles of different winding"), std::string::npos);
  mesh = octahedron();
  mesh.indices = {{0, 2, 4}, {0, 3, 5}};
  EXPECT_EQ(error_of(mesh), "several fans of triangles meet at vertex 0");
  mesh.indices = {{0, 2, 4}, {0, 4, 2}};
  EXPECT_EQ(error_of(mesh), "two triangles have the vertices 0, 2 and 4");
  mesh.indices = {{0, 0, 1}};
  EXPECT_EQ(error_of(mesh), "triangle 0 has the same vertex twice");
  EXPECT_NE(error_of(octahedron(), 14).find("exceed the limit"), std::string::npos);
}

TEST(LoopSubdivision, MustFitIntoTheMemoryThatIsLeft) {
  std::string error;
  EXPECT_FALSE(subdivide_loop(octahedron(), 10, &error, MemoryRoom(held_memory() + (1u << 20), "the test")));
  EXPECT_NE(error.find("the test"), std::string::npos) << error;
  EXPECT_TRUE(subdivide_loop(octahedron(), 2, &error, MemoryRoom(held_memory() + (1u << 20), "the test")));
}

// A few triangles of five vertices: most are refused, and many lie on each other.
TEST(LoopSubdivision, AnyCageIsSubdividedOrRefused) {
  test::Random random(1);
  int subdivided = 0;
  for (int i = 0; i < 20'000; ++i) {
    TriangleMesh cage;
    for (int v = 0; v < 5; ++v) cage.P.push_back(random.uniform_3d());
    for (uint32_t t = 0; t < 1 + random.bits() % 5; ++t)
      cage.indices.push_back({random.bits() % 5, random.bits() % 5, random.bits() % 5});
    std::string error;
    const auto mesh = subdivide_loop(cage, 2, &error);
    ASSERT_EQ(mesh.has_value(), error.empty());
    if (!mesh) continue;
    ++subdivided;
    ASSERT_EQ(mesh->indices.size(), 16 * cage.indices.size());
    for (const auto& triangle : mesh->indices)
      for (const uint32_t v : triangle) ASSERT_LT(v, mesh->P.size());
  }
  EXPECT_GT(subdivided, 1000);
}

}  // namespace
}  // namespace kaustik
