#include "core/camera/camera.h"

#include <gtest/gtest.h>

#include "core/sampling/warp.h"
#include "tests/core/support/chi_square.h"
#include "tests/support/random.h"
#include "tests/support/shapes.h"

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
  // The fov is the full angle of the shorter axis: the top edge rises by tan 45 = 1.
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
  // A mirrored and scaled frame, which scene files often give.
  c.to_world = Transform::from_matrix(test::affine({-2, 0, 0, 0, 1.6, 1.2, 0, -1.2, 1.6}, {3, -4, 5}));
  test::Random random(1);
  for (int i = 0; i < 10000; ++i) {
    const Point2 raster(random.uniform(1, 639), random.uniform(1, 479));
    const Ray ray = c.generate_ray(raster);
    ASSERT_NEAR(glm::length(ray.d), 1, 1e-6);
    Point2 back;
    Point3 eye;
    ASSERT_TRUE(c.project(ray.at(random.uniform(1, 100)), &back, &eye));
    // World coordinates are about 10 and the focal length is 760 pixels: 760 * 10 * 2^-24 times a few
    // roundings.
    ASSERT_LT(glm::distance(back, raster), 4e-3f);
  }
}

TEST(PerspectiveCamera, ProjectRejectsPointsBehindAndBesideTheImage) {
  const Camera c = camera(100, 100, 60);
  Point2 raster;
  Point3 eye;
  EXPECT_TRUE(c.project({0, 0, 1}, &raster, &eye));
  EXPECT_FLOAT_EQ(raster.x, 50);
  EXPECT_FALSE(c.project({0, 0, -1}, &raster, &eye));
  EXPECT_FALSE(c.project({0, 0, 0}, &raster, &eye));
  EXPECT_FALSE(c.project({5, 0, 1}, &raster, &eye));
}

// Rays through all parts of the lens meet at the focal distance; at depth z they are apart by lens |1 - z /
// f|, the circle of confusion.
TEST(ThinLens, CircleOfConfusionMatchesTheClosedForm) {
  constexpr float kRadius = 0.1f, kFocal = 4;
  for (const Projection& projection : {Projection{PerspectiveProjection{40, {kRadius, kFocal}}},
                                       Projection{OrthographicProjection{{kRadius, kFocal}}}}) {
    Camera c = camera(320, 240, 40);
    c.projection = projection;
    EXPECT_EQ(c.lens_radius(), kRadius);
    const RayGenerator generate(c);
    test::Random random(2);
    for (int i = 0; i < 1000; ++i) {
      const Point2 raster(random.uniform(0, 320), random.uniform(0, 240));
      const Point2 lens = sample_uniform_disk_concentric(random.uniform_2d());
      const Ray middle = generate(raster), ray = generate.through(raster, lens);
      ASSERT_NEAR(glm::length(ray.d), 1, 1e-6);
      for (const float z : {1.0f, kFocal, 9.0f}) {
        const Vector3 apart = ray.at((z - ray.o.z) / ray.d.z) - middle.at((z - middle.o.z) / middle.d.z);
        const Point2 expected = kRadius * (1 - z / kFocal) * lens;
        // Coordinates are at most 9 and are rounded a few times.
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
    test::Random random(3);
    for (int i = 0; i < 10000; ++i) {
      const Vector3 d = random.direction();
      Point2 raster;
      Point3 eye;
      ASSERT_TRUE(c.project(5.0f * d, &raster, &eye));
      const Ray ray = c.generate_ray(raster);
      // Raster positions up to 400 are rounded to 2^-16, which is 2e-5 of a turn of 2 pi. The square roots at
      // the poles and at the folds of the equal-area map take the square root of that.
      ASSERT_LT(glm::distance(ray.d, d), 2e-3f);
    }
  }
}

// pbrt's convention: +y is up; rows of the equirectangular map run from +y to -y, columns from +x over +z.
TEST(SphericalCamera, DirectionsFollowPbrtsConvention) {
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
  // A pixel filter reaches beyond the image, where the map continues around the sphere.
  expect_direction({-1, 60}, c.generate_ray({1, 140}).d);
}

}  // namespace
}  // namespace kaustik
