// Compares the memory that is forecast for a BVH with what Embree reports of it.

#include "accel/bvh_memory.h"

#include <gtest/gtest.h>

#include "accel/bvh.h"
#include "tests/support/random.h"
#include "tests/support/shapes.h"

namespace kaustik::accel {
namespace {

TriangleMesh wavy_square(uint32_t n) {
  return test::terrain(
      n, [](uint32_t x, uint32_t y) { return std::sin(0.1f * float(x)) * std::cos(0.2f * float(y)); });
}

// The forecast is that of the build's peak, so more than what remains, and less than four times that.
void expect_forecast(Scene scene) {
  scene.materials = {Lambertian{Rgb(1)}};
  finalize_scene(scene);
  const uint64_t forecast = forecast_bytes(scene, estimate_sides(scene.shapes)),
                 empty = forecast_bytes({}, {});
  const Bvh bvh(scene);
  EXPECT_GE(forecast, bvh.memory_bytes());
  EXPECT_LE(forecast - empty, 4 * bvh.memory_bytes());
}

TEST(BvhMemory, IsForecastForTriangles) {
  for (const uint32_t n : {100u, 400u}) {
    Scene scene;
    scene.shapes.emplace_back().geometry = wavy_square(n);
    expect_forecast(std::move(scene));
  }
}

// As leaves of trees, which share no sides.
TEST(BvhMemory, IsForecastForTrianglesApart) {
  TriangleMesh mesh;
  test::Random random(1);
  for (uint32_t i = 0; i < 100'000; i += 4) {
    const Point3 corner = 50.0f * random.uniform_3d();
    const Vector3 a = random.in_cube(), b = random.in_cube();
    for (const Point3& p : {corner, corner + a, corner + a + b, corner + b}) mesh.P.push_back(p);
    mesh.indices.push_back({i, i + 1, i + 2});
    mesh.indices.push_back({i, i + 2, i + 3});
  }
  Scene scene;
  scene.shapes.emplace_back().geometry = std::move(mesh);
  expect_forecast(std::move(scene));
}

TEST(BvhMemory, IsForecastForSpheres) {
  Scene scene;
  for (int i = 0; i < 20'000; ++i) {
    Sphere sphere;
    sphere.to_world.translation = 3.0f * Point3(float(i % 100), float(i / 100), 0);
    scene.shapes.emplace_back().geometry = sphere;
  }
  expect_forecast(std::move(scene));
}

TEST(BvhMemory, SharedMeshesCountOnce) {
  const auto mesh = std::make_shared<const TriangleMesh>(wavy_square(100));
  Scene scene;
  for (int i = 0; i < 1000; ++i) {
    InstancedMesh instance{mesh, {{0, 0, -1}, {100, 100, 1}}, {}};
    instance.to_world.translation = Point3(200.0f * float(i), 0, 0);
    scene.shapes.emplace_back().geometry = instance;
  }
  expect_forecast(std::move(scene));
}

}  // namespace
}  // namespace kaustik::accel
