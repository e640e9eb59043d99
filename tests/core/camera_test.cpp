#include "core/camera/perspective.h"

#include <gtest/gtest.h>

#include "tests/core/statistics.h"
#include "tests/core/test_tracer.h"

namespace kaustik {
namespace {

PerspectiveCamera camera(int width, int height, float fov) {
  PerspectiveCamera c;
  c.width = width;
  c.height = height;
  c.fov_degrees = fov;
  c.set_default_screen_window();
  return c;
}

TEST(PerspectiveCamera, LooksAlongZWithRowZeroOnTop) {
  const PerspectiveCamera c = camera(200, 100, 90);
  EXPECT_EQ(c.generate_ray({100, 50}).d, Vector3(0, 0, 1));
  // The full angle of the shorter axis is the fov: the top edge rises by tan 45 = 1.
  const Vector3 top = c.generate_ray({100, 0}).d;
  EXPECT_NEAR(top.y / top.z, 1, 1e-6);
  const Vector3 right = c.generate_ray({200, 50}).d;
  EXPECT_NEAR(right.x / right.z, 2, 1e-6);
  const Vector3 tall = camera(100, 200, 90).generate_ray({100, 0}).d;
  EXPECT_NEAR(tall.x / tall.z, 1, 1e-6);
  EXPECT_NEAR(tall.y / tall.z, 2, 1e-6);
}

TEST(PerspectiveCamera, ProjectInvertsGenerateRay) {
  PerspectiveCamera c = camera(640, 480, 35);
  // A mirrored, scaled frame, as scene files often give.
  c.to_world = Transform::from_matrix(test::affine({-2, 0, 0, 0, 1.6, 1.2, 0, -1.2, 1.6}, {3, -4, 5}));
  test::IndependentRandom random(1);
  for (int i = 0; i < 10000; ++i) {
    const Point2 raster(random.between(1, 639), random.between(1, 479));
    const Ray ray = c.generate_ray(raster);
    ASSERT_NEAR(glm::length(ray.d), 1, 1e-6);
    Point2 back;
    ASSERT_TRUE(c.project(ray.at(random.between(1, 100)), &back));
    // World coordinates of about 10 and a focal length of 760 pixels: 760 * 10 * 2^-24 * a few.
    ASSERT_LT(glm::distance(back, raster), 4e-3f);
  }
}

TEST(PerspectiveCamera, ProjectRejectsBehindAndBeside) {
  const PerspectiveCamera c = camera(100, 100, 60);
  Point2 raster;
  EXPECT_TRUE(c.project({0, 0, 1}, &raster));
  EXPECT_FLOAT_EQ(raster.x, 50);
  EXPECT_FALSE(c.project({0, 0, -1}, &raster));
  EXPECT_FALSE(c.project({0, 0, 0}, &raster));
  EXPECT_FALSE(c.project({5, 0, 1}, &raster));
}

}  // namespace
}  // namespace kaustik
