#include "core/camera/camera.h"

#include <gtest/gtest.h>

#include "core/sampling/warp.h"
#include "tests/core/support/statistics.h"
#include "tests/core/support/test_tracer.h"

namespace kaustik {
namespace {

Camera camera(int width, int height, float fov) {
  Camera c;
  c.width = width;
  c.height = height;
  c.projection = PerspectiveProjection{fov, {}};
  c.set_default_screen_window();
  return c;
}

TEST(PerspectiveCamera, LooksAlongZWithRowZeroOnTop) {
  const Camera c = camera(200, 100, 90);
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
  Camera c = camera(640, 480, 35);
  // A mirrored, scaled frame, as scene files often give.
  c.to_world = Transform::from_matrix(test::affine({-2, 0, 0, 0, 1.6, 1.2, 0, -1.2, 1.6}, {3, -4, 5}));
  test::IndependentRandom random(1);
  for (int i = 0; i < 10000; ++i) {
    const Point2 raster(random.between(1, 639), random.between(1, 479));
    const Ray ray = c.generate_ray(raster);
    ASSERT_NEAR(glm::length(ray.d), 1, 1e-6);
    Point2 back;
    Point3 eye;
    ASSERT_TRUE(c.project(ray.at(random.between(1, 100)), &back, &eye));
    // World coordinates of about 10 and a focal length of 760 pixels: 760 * 10 * 2^-24 * a few.
    ASSERT_LT(glm::distance(back, raster), 4e-3f);
  }
}

TEST(PerspectiveCamera, ProjectRejectsBehindAndBeside) {
  const Camera c = camera(100, 100, 60);
  Point2 raster;
  Point3 eye;
  EXPECT_TRUE(c.project({0, 0, 1}, &raster, &eye));
  EXPECT_FLOAT_EQ(raster.x, 50);
  EXPECT_FALSE(c.project({0, 0, -1}, &raster, &eye));
  EXPECT_FALSE(c.project({0, 0, 0}, &raster, &eye));
  EXPECT_FALSE(c.project({5, 0, 1}, &raster, &eye));
}

// A ray through any part of the lens meets the one through its middle at the focal distance; elsewhere they
// are apart by lens |1 - z / f|, the circle of confusion.
TEST(ThinLens, CircleOfConfusionIsThatOfTheClosedForm) {
  constexpr float kRadius = 0.1f, kFocal = 4;
  for (const Projection& projection : {Projection{PerspectiveProjection{40, {kRadius, kFocal}}},
                                       Projection{OrthographicProjection{{kRadius, kFocal}}}}) {
    Camera c = camera(320, 240, 40);
    c.projection = projection;
    EXPECT_EQ(c.lens_radius(), kRadius);
    const RayGenerator generate(c);
    test::IndependentRandom random(2);
    for (int i = 0; i < 1000; ++i) {
      const Point2 raster(random.between(0, 320), random.between(0, 240));
      const Point2 lens = sample_uniform_disk_concentric(random.next_2d());
      const Ray middle = generate(raster), ray = generate.through(raster, lens);
      ASSERT_NEAR(glm::length(ray.d), 1, 1e-6);
      for (const float z : {1.0f, kFocal, 9.0f}) {
        const Vector3 apart = ray.at((z - ray.o.z) / ray.d.z) - middle.at((z - middle.o.z) / middle.d.z);
        const Point2 expected = kRadius * (1 - z / kFocal) * lens;
        // Coordinates up to 9, a few roundings each.
        ASSERT_NEAR(apart.x, expected.x, 1e-5f);
        ASSERT_NEAR(apart.y, expected.y, 1e-5f);
      }
    }
  }
}

TEST(OrthographicCamera, RaysAreParallelAndProjectInverts) {
  Camera c = camera(200, 100, 90);
  c.projection = OrthographicProjection{};
  c.screen_window = {-3, 1, -1, 1};
  EXPECT_EQ(c.generate_ray({0, 0}).o, Point3(-3, 1, 0));
  EXPECT_EQ(c.generate_ray({200, 100}).o, Point3(1, -1, 0));
  EXPECT_EQ(c.generate_ray({10, 20}).d, Vector3(0, 0, 1));
  Point2 raster;
  Point3 eye;
  ASSERT_TRUE(c.project({0, 0.5f, 7}, &raster, &eye));
  EXPECT_EQ(raster, Point2(150, 25));
  EXPECT_EQ(eye, Point3(0, 0.5f, 0));
  EXPECT_FALSE(c.project({0, 0, -1}, &raster, &eye));
  EXPECT_FALSE(c.project({2, 0, 1}, &raster, &eye));
}

TEST(SphericalCamera, ShowsEveryDirectionOnce) {
  for (const auto mapping : {SphericalMapping::kEquirectangular, SphericalMapping::kEqualArea}) {
    Camera c = camera(400, 200, 90);
    c.projection = SphericalProjection{mapping};
    test::IndependentRandom random(3);
    for (int i = 0; i < 10000; ++i) {
      const Vector3 d = random.direction();
      Point2 raster;
      Point3 eye;
      ASSERT_TRUE(c.project(5.0f * d, &raster, &eye));
      const Ray ray = c.generate_ray(raster);
      // Raster positions up to 400, rounded to 2^-16: 2e-5 of a turn's 2 pi; the square roots at the poles
      // and at the equal-area map's folds double its digits.
      ASSERT_LT(glm::distance(ray.d, d), 2e-3f);
    }
  }
}

// pbrt's places: +y is up; rows of the equirectangular map run from +y to -y, columns from +x over +z.
TEST(SphericalCamera, LooksWherePbrtDoes) {
  Camera c = camera(400, 200, 90);
  c.projection = SphericalProjection{SphericalMapping::kEquirectangular};
  const auto expect_direction = [&](const Point2& raster, const Vector3& d) {
    EXPECT_LT(glm::distance(c.generate_ray(raster).d, d), 1e-6f);
  };
  expect_direction({0, 100}, {1, 0, 0});
  expect_direction({100, 100}, {0, 0, 1});
  expect_direction({200, 100}, {-1, 0, 0});
  expect_direction({50, 0}, {0, 1, 0});
  expect_direction({50, 200}, {0, -1, 0});
  c.projection = SphericalProjection{SphericalMapping::kEqualArea};
  expect_direction({200, 100}, {0, 1, 0});
  expect_direction({0, 0}, {0, -1, 0});
  expect_direction({400, 100}, {1, 0, 0});
  expect_direction({200, 200}, {0, 0, 1});
  // A pixel filter reaches beyond the image: the sphere goes on.
  expect_direction({-1, 60}, c.generate_ray({1, 140}).d);
}

}  // namespace
}  // namespace kaustik
