// The feet of walls on floors.

#include "accel/wall_feet.h"

#include <gtest/gtest.h>

#include "accel/bvh.h"
#include "tests/support/shapes.h"

namespace kaustik::accel {
namespace {

using test::parallelogram;

// Each shape is a surface group of its own.
std::vector<BoundaryEdge> feet_of(std::vector<Shape> shapes, std::vector<Material> materials = {},
                                  float gap = 0) {
  Scene scene;
  scene.shapes = std::move(shapes);
  scene.materials = std::move(materials);
  if (scene.materials.empty()) scene.materials = {Lambertian{Rgb(1)}};
  for (uint32_t i = 0; i < scene.shapes.size(); ++i) scene.shapes[i].surface_group = i;
  finalize_scene(scene);
  const Bvh bvh(scene);
  return find_wall_feet(scene, EdgeIndex(without_continued(find_boundary_edges(scene.shapes), bvh)), gap);
}

std::vector<BoundaryEdge> in_group(const std::vector<BoundaryEdge>& feet, uint32_t group) {
  std::vector<BoundaryEdge> found;
  for (const BoundaryEdge& foot : feet)
    if (foot.surface_group == group) found.push_back(foot);
  return found;
}

// Length of the feet on the line from (x0, 0.5) to (x1, 0.5) of the floor, in parts of 1/1000 that any foot
// covers.
double covered(const std::vector<BoundaryEdge>& feet, double x0, double x1) {
  constexpr int kParts = 1000;
  int count = 0;
  for (int i = 0; i < kParts; ++i) {
    const double x = x0 + (x1 - x0) * (i + 0.5) / kParts;
    count += std::any_of(feet.begin(), feet.end(), [&](const BoundaryEdge& e) {
      return x >= double(std::min(e.a.x, e.b.x)) && x <= double(std::max(e.a.x, e.b.x)) && e.a.y == 0.5f &&
             e.b.y == 0.5f && e.a.z == 0 && e.b.z == 0;
    });
  }
  return (x1 - x0) * count / kParts;
}

const Shape kFloor = parallelogram({0, 0, 0}, {1, 0, 0}, {0, 1, 0});

TEST(WallFeet, AWallOnAFloorHasOneOnItsUpperSide) {
  const auto feet = feet_of({kFloor, parallelogram({0.25f, 0.5f, 0}, {0.5f, 0, 0}, {0, 0, 1})});
  EXPECT_TRUE(in_group(feet, 1).empty());  // the wall ends there
  const auto on_floor = in_group(feet, 0);
  EXPECT_NEAR(covered(on_floor, 0.25, 0.75), 0.5, 1e-3);
  EXPECT_EQ(covered(on_floor, 0, 0.249), 0);
  EXPECT_EQ(covered(on_floor, 0.751, 1), 0);
  for (const BoundaryEdge& foot : on_floor) {
    EXPECT_EQ(foot.n, Normal3(0, 0, 1));
    EXPECT_FALSE(foot.both_sides);
  }
}

TEST(WallFeet, AWallThroughAFloorHasOneOnBothSides) {
  const auto feet = feet_of({kFloor, parallelogram({0.25f, 0.5f, -0.5f}, {0.5f, 0, 0}, {0, 0, 1})});
  EXPECT_NEAR(covered(in_group(feet, 0), 0.25, 0.75), 0.5, 1e-3);
  for (const BoundaryEdge& foot : in_group(feet, 0)) EXPECT_TRUE(foot.both_sides);
  // The floor reaches beyond the wall, so it cuts the wall, too.
  EXPECT_FALSE(in_group(feet, 1).empty());
}

// Surfaces that end there, gaps, panes of glass, masked and flat shapes.
TEST(WallFeet, OtherShapesHaveNone) {
  EXPECT_TRUE(feet_of({kFloor, parallelogram({0, 0, 0}, {1, 0, 0}, {0, 0, 1})}).empty());
  EXPECT_TRUE(feet_of({kFloor, parallelogram({0.25f, 0.5f, 0.001f}, {0.5f, 0, 0}, {0, 0, 1})}).empty());
  EXPECT_TRUE(feet_of({kFloor, parallelogram({0.25f, 0.5f, 0}, {0.5f, 0, 0}, {0, 1, 0.1f})}).empty());
  EXPECT_TRUE(feet_of({kFloor, parallelogram({0.25f, 0.5f, 0}, {0.5f, 0, 0}, {0, 0, 1}, 1)},
                      {Lambertian{Rgb(1)}, ThinDielectric{1.5f}})
                  .empty());
  Shape masked = parallelogram({0.25f, 0.5f, 0}, {0.5f, 0, 0}, {0, 0, 1});
  masked.alpha = 0.5f;
  EXPECT_TRUE(feet_of({kFloor, masked}).empty());
}

// A wall in one mesh with two floors that share an edge under it.
TEST(WallFeet, AWallOnASharedEdgeHasOne) {
  TriangleMesh mesh;
  mesh.P = {{0, 0, 0}, {1, 0, 0}, {1, 0.5f, 0}, {0, 0.5f, 0},
            {1, 1, 0}, {0, 1, 0}, {0, 0.5f, 1}, {1, 0.5f, 1}};
  mesh.indices = {{0, 1, 2}, {0, 2, 3}, {3, 2, 4}, {3, 4, 5}, {3, 2, 7}, {3, 7, 6}};
  Shape shape;
  shape.geometry = mesh;
  EXPECT_NEAR(covered(feet_of({shape}), 0, 1), 1, 2e-3);
}

// Many triangles on either side: the join finds what each wall alone would have.
TEST(WallFeet, ManyTrianglesAreJoined) {
  TriangleMesh floor, wall;
  constexpr uint32_t kCells = 40;
  for (uint32_t i = 0; i <= kCells; ++i)
    for (uint32_t j = 0; j <= kCells; ++j) {
      const float x = float(i) / float(kCells), y = float(j) / float(kCells);
      floor.P.push_back({x, y, 0});
      wall.P.push_back({x, 0.5f, y});
    }
  for (uint32_t i = 0; i < kCells; ++i)
    for (uint32_t j = 0; j < kCells; ++j) {
      const uint32_t a = i * (kCells + 1) + j, b = a + kCells + 1;
      floor.indices.push_back({a, b, b + 1}), floor.indices.push_back({a, b + 1, a + 1});
    }
  wall.indices = floor.indices;
  Shape shapes[2];
  shapes[0].geometry = floor;
  shapes[1].geometry = wall;
  EXPECT_NEAR(covered(in_group(feet_of({shapes[0], shapes[1]}), 0), 0, 1), 1, 2e-3);
}

TEST(WallFeet, ScaleWithTheScene) {
  const auto scaled = [](float s) {
    return feet_of({parallelogram({0.1f * s, 0, 0}, {s, 0, 0.2f * s}, {0, s, 0}),
                    parallelogram({0.3f * s, 0.2f * s, -s}, {0.1f * s, 0.5f * s, 0}, {0, 0, 2 * s})});
  };
  const auto one = scaled(1);
  ASSERT_FALSE(one.empty());
  for (const int k : {-20, 20}) {
    const float s = std::ldexp(1.0f, k);
    const auto other = scaled(s);
    ASSERT_EQ(other.size(), one.size());
    for (size_t i = 0; i < one.size(); ++i) {
      EXPECT_EQ(other[i].a, s * one[i].a);
      EXPECT_EQ(other[i].b, s * one[i].b);
    }
  }
}

// A wall from (0.25, 0.5) to (0.75, 0.5) that ends 0.05 above the floor, and stands upright or is tilted by
// 45 degrees: the foot is below its lower edge.
TEST(WallFeet, AWallJustAboveAFloorHasOne) {
  for (const Vector3& up : {Vector3(0, 0, 1), Vector3(0, 1, 1)}) {
    const std::vector<Shape> shapes = {kFloor, parallelogram({0.25f, 0.5f, 0.05f}, {0.5f, 0, 0}, up)};
    const auto near = in_group(feet_of(shapes, {}, 0.0625f), 0);
    EXPECT_NEAR(covered(near, 0.25, 0.75), 0.5, 1e-3);
    EXPECT_EQ(covered(near, 0, 0.249), 0);
    for (const BoundaryEdge& foot : near) EXPECT_EQ(foot.n, Normal3(0, 0, 1));
    EXPECT_TRUE(feet_of(shapes, {}, 0.03f).empty());
  }
  // What lies flat just above the floor is no wall.
  EXPECT_TRUE(feet_of({kFloor, parallelogram({0.25f, 0.25f, 0.05f}, {0.5f, 0, 0}, {0, 0.5f, 0})}, {}, 0.0625f)
                  .empty());
}

// Nothing changes where a tilted wall touches the floor with one corner.
TEST(WallFeet, AWallThatTouchesWithOneCornerHasOneBelowItsEdge) {
  const std::vector<Shape> shapes = {kFloor, parallelogram({0.25f, 0.5f, 0}, {0.5f, 0, 0.03f}, {0, 0, 1})};
  EXPECT_NEAR(covered(in_group(feet_of(shapes, {}, 0.0625f), 0), 0.25, 0.75), 0.5, 1e-3);
}

}  // namespace
}  // namespace kaustik::accel
