#include "core/scene/build/surface_groups.h"

#include <gtest/gtest.h>

#include <numeric>
#include <random>

namespace kaustik {
namespace {

// Two triangles over the parallelogram p, p + u, p + u + v, p + v.
Shape tile(const Point3& p, const Vector3& u, const Vector3& v, bool turned = false) {
  TriangleMesh mesh;
  mesh.P = {p, p + u, p + u + v, p + v};
  mesh.indices = {{0, 1, 2}, {0, 2, 3}};
  if (turned) mesh.indices = {{0, 2, 1}, {0, 3, 2}};
  Shape shape;
  shape.geometry = mesh;
  return shape;
}

std::vector<uint32_t> groups(std::vector<Shape> shapes, std::vector<std::string> names = {}) {
  names.resize(shapes.size());
  assign_surface_groups(shapes, names);
  std::vector<uint32_t> out;
  for (const Shape& s : shapes) out.push_back(s.surface_group);
  return out;
}

using Groups = std::vector<uint32_t>;
const Vector3 kX(1, 0, 0), kY(0, 1, 0), kZ(0, 0, 1);

TEST(SurfaceGroups, TilesOfAFloorShareAGroup) {
  EXPECT_EQ(groups({tile({0, 0, 0}, kX, kZ), tile({1, 0, 0}, kX, kZ), tile({2, 0, 0}, kX, kZ, true)}),
            Groups({0, 0, 0}));
}

TEST(SurfaceGroups, FloorAndWallAreSeparateGroups) {
  EXPECT_EQ(groups({tile({0, 0, 0}, kX, kZ), tile({0, 0, 0}, kX, kY)}), Groups({0, 1}));
}

TEST(SurfaceGroups, TheAngleAtTheEdgeDecides) {
  const auto bent = [&](float degrees) {
    const float a = glm::radians(degrees);
    return groups({tile({0, 0, 0}, kX, kZ), tile({1, 0, 0}, {std::cos(a), std::sin(a), 0}, kZ)});
  };
  EXPECT_EQ(bent(25), Groups({0, 0}));  // cos 25 = 0.906
  EXPECT_EQ(bent(27), Groups({0, 1}));  // cos 27 = 0.891
}

// Pages of a book, at random angles around their common edge: those that are alike, or that others between
// them join, share a group. The comparison looks at all pairs.
TEST(SurfaceGroups, AnyNumberOfTrianglesMeetAtAnEdge) {
  std::mt19937 random(5);
  std::uniform_real_distribution<float> any(0, 2 * kPi);
  for (int round = 0; round < 200; ++round) {
    std::vector<float> angles(3 + random() % 5);
    for (float& a : angles) a = any(random);
    std::vector<Shape> shapes;
    for (const float a : angles) shapes.push_back(tile({0, 0, 0}, {std::cos(a), std::sin(a), 0}, kZ));
    Groups expected(angles.size());
    std::iota(expected.begin(), expected.end(), 0u);
    for (size_t k = 0; k < angles.size(); ++k)  // paths of up to as many steps
      for (size_t i = 0; i < angles.size(); ++i)
        for (size_t j = 0; j < angles.size(); ++j)
          if (std::abs(std::cos(angles[i] - angles[j])) > 0.9f)
            expected[i] = std::min(expected[i], expected[j]);
    const Groups found = groups(shapes);
    for (size_t i = 0; i < angles.size(); ++i)
      for (size_t j = 0; j < angles.size(); ++j)
        ASSERT_EQ(found[i] == found[j], expected[i] == expected[j]) << "round " << round;
  }
}

// With a comparison of all pairs this would take minutes.
TEST(SurfaceGroups, APileOfEqualTrianglesIsOneGroup) {
  const std::vector<Shape> pile(50'000, tile({0, 0, 0}, kX, kZ));
  EXPECT_EQ(groups(pile), Groups(pile.size(), 0u));
}

TEST(SurfaceGroups, ACommonCornerOrANearEdgeDoesNotJoin) {
  EXPECT_EQ(groups({tile({0, 0, 0}, kX, kZ), tile({1, 0, 1}, kX, kZ)}), Groups({0, 1}));
  EXPECT_EQ(groups({tile({0, 0, 0}, kX, kZ), tile({std::nextafter(1.0f, 2.0f), 0, 0}, kX, kZ)}),
            Groups({0, 1}));
}

TEST(SurfaceGroups, MinusZeroMatchesZero) {
  EXPECT_EQ(groups({tile({-1, 0, 0}, kX, kZ), tile({-0.0f, -0.0f, -0.0f}, kX, kZ)}), Groups({0, 0}));
}

TEST(SurfaceGroups, InnerEdgesDoNotJoin) {
  // The second tile stands on the diagonal of the first, which is not a boundary edge of it.
  Shape on_diagonal = tile({0, 0, 0}, {1, 0, 1}, {-1, 0, 1});
  EXPECT_EQ(groups({tile({0, 0, 0}, kX, kZ), on_diagonal}), Groups({0, 1}));
}

TEST(SurfaceGroups, NamesJoinAndSeparate) {
  const std::vector<Shape> floor = {tile({0, 0, 0}, kX, kZ), tile({1, 0, 0}, kX, kZ),
                                    tile({9, 0, 0}, kX, kZ)};
  EXPECT_EQ(groups(floor, {"a", "b", "a"}), Groups({0, 1, 0}));
  EXPECT_EQ(groups(floor, {"a", "", ""}), Groups({0, 1, 2}));
  Shape sphere;
  sphere.geometry = Sphere{};
  EXPECT_EQ(groups({sphere, sphere, floor[0]}, {"", "s", "s"}), Groups({0, 1, 1}));
}

}  // namespace
}  // namespace kaustik
