// Tests frames, transforms and bounds.

#include "core/math/frame.h"

#include <gtest/gtest.h>

#include "core/math/bounds.h"
#include "core/math/transform.h"
#include "tests/core/support/chi_square.h"
#include "tests/support/random.h"
#include "tests/support/shapes.h"

namespace kaustik {
namespace {

TEST(Frame, IsOrthonormalForEveryNormal) {
  std::vector<Normal3> normals = {{0, 0, 1},
                                  {0, 0, -1},
                                  {1, 0, 0},
                                  {0, -1, 0},
                                  {0, 1, -0.0f},
                                  glm::normalize(Vector3(1e-4f, -1e-4f, -1)),
                                  glm::normalize(Vector3(-1e-7f, 1e-7f, -1)),
                                  glm::normalize(Vector3(1e-20f, 0, -1)),
                                  glm::normalize(Vector3(1, 1, -1e-8f))};
  test::Random random(1);
  for (int i = 0; i < 10000; ++i) normals.push_back(random.direction());
  for (const Normal3& n : normals) {
    const Frame f = Frame::from_z(n);
    // Each is a product of a few roundings of numbers near one (Duff et al. report the same size).
    constexpr float kTolerance = 16 * 0x1p-24f;
    EXPECT_EQ(f.z, n);
    EXPECT_NEAR(glm::dot(f.x, f.x), 1, kTolerance);
    EXPECT_NEAR(glm::dot(f.y, f.y), 1, kTolerance);
    EXPECT_NEAR(glm::dot(f.x, f.y), 0, kTolerance);
    EXPECT_NEAR(glm::dot(f.x, f.z), 0, kTolerance);
    EXPECT_NEAR(glm::dot(f.y, f.z), 0, kTolerance);
    EXPECT_GT(glm::dot(glm::cross(f.x, f.y), f.z), 0.999f);
  }
}

TEST(Frame, LocalAndWorldAreInverse) {
  test::Random random(2);
  for (int i = 0; i < 1000; ++i) {
    const Frame f = Frame::from_z(random.direction());
    const Vector3 v = random.direction();
    EXPECT_LT(glm::distance(f.to_world(f.to_local(v)), v), 16 * 0x1p-24f);
  }
}

TEST(Transform, TransformsPointsVectorsAndNormals) {
  const Transform t = Transform::from_matrix(test::affine({2, 0, 0, 1, 4, 0, 0, 0, -8}, {1, 2, 3}));
  EXPECT_EQ(t.point({1, 1, 1}), Point3(4, 6, -5));
  EXPECT_EQ(t.vector({1, 1, 1}), Vector3(3, 4, -8));
  EXPECT_EQ(t.inverse_point({4, 6, -5}), Point3(1, 1, 1));
  EXPECT_EQ(t.inverse_vector({3, 4, -8}), Vector3(1, 1, 1));
  // A transformed normal stays perpendicular to transformed tangents.
  EXPECT_EQ(glm::dot(t.normal({1, -1, 0}), t.vector({1, 1, 0})), 0);
  EXPECT_TRUE(t.invertible());
}

TEST(Transform, SingularIsNotInvertible) {
  const auto invertible = [](const glm::dmat3& m) {
    return Transform::from_matrix(test::affine(m, {0, 0, 0})).invertible();
  };
  EXPECT_FALSE(invertible({1, 0, 0, 0, 1, 0, 0, 0, 0}));
  EXPECT_FALSE(invertible({1, 2, 3, 4, 5, 6, 7, 8, 9}));  // determinant zero, or its rounding
  EXPECT_FALSE(invertible(glm::dmat3(std::numeric_limits<double>::quiet_NaN())));
  EXPECT_TRUE(invertible(glm::dmat3(1e-9)));
  EXPECT_TRUE(invertible(glm::dmat3(1e9)));
}

TEST(Bounds, EmptyUntilAdded) {
  Bounds3 b;
  EXPECT_TRUE(b.empty());
  EXPECT_EQ(b.diagonal(), Vector3(0));
  b.add(Point3(1, 2, 3));
  b.add(Point3(-1, 4, 3));
  EXPECT_FALSE(b.empty());
  EXPECT_EQ(b.center(), Point3(0, 3, 3));
  EXPECT_FLOAT_EQ(b.radius(), std::sqrt(2.0f));
}

}  // namespace
}  // namespace kaustik
