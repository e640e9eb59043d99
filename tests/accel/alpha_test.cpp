// Tests surfaces with alpha: single rays, packets and shadow rays must give the same answers.

#include <gtest/gtest.h>

#include "accel/bvh.h"
#include "core/sampling/sampler.h"

namespace kaustik::accel {
namespace {

// A triangle, a sphere and a disk one behind another along z; rays meet them from below.
Scene three_layers(float alpha) {
  Scene scene;
  scene.materials = {Lambertian{}};
  Shape triangle, sphere, disk;
  TriangleMesh mesh;
  mesh.P = {{-4, -4, 1}, {4, -4, 1}, {0, 8, 1}};
  mesh.indices = {{0, 1, 2}};
  triangle.geometry = mesh;
  glm::dmat4 at(1);
  at[3] = {0, 0, 3, 1};
  sphere.geometry = Sphere{Transform::from_matrix(at)};
  at[3] = {0, 0, 5, 1};
  disk.geometry = Disk{Transform::from_matrix(at), 0};
  for (Shape* shape : {&triangle, &sphere, &disk}) {
    shape->alpha = alpha;
    scene.shapes.push_back(*shape);
  }
  finalize_scene(scene);
  return scene;
}

Ray ray_of(uint64_t k) {
  Sampler sampler(11, k);
  const Point2 u = sampler.next_2d(), v = sampler.next_2d();
  return {{0.8f * u.x - 0.4f, 0.8f * u.y - 0.4f, -1}, {0.1f * v.x - 0.05f, 0.1f * v.y - 0.05f, 1}};
}

// Two instances of one mesh along z, and a third instance, of a mesh of its own, which is opaque.
Scene three_instances(float alpha) {
  Scene scene;
  scene.materials = {Lambertian{}};
  TriangleMesh mesh;
  mesh.P = {{-4, -4, 0}, {4, -4, 0}, {0, 8, 0}};
  mesh.indices = {{0, 1, 2}};
  const auto shared = std::make_shared<const TriangleMesh>(mesh),
             own = std::make_shared<const TriangleMesh>(mesh);
  for (int i = 0; i < 3; ++i) {
    glm::dmat4 at(1);
    at[3] = {0, 0, 1 + i, 1};
    Shape shape;
    shape.geometry =
        InstancedMesh{i < 2 ? shared : own, {{-4, -4, 0}, {4, 8, 0}}, Transform::from_matrix(at)};
    shape.alpha = i < 2 ? alpha : 1;
    scene.shapes.push_back(std::move(shape));
  }
  finalize_scene(scene);
  return scene;
}

// Each of the four surfaces stops a ray with probability 1/4, so their shares are 1/4, 3/16, 9/64 (the
// sphere's second wall) and so on. With 4096 rays the standard deviations are below 28, and five of them are
// 140.
TEST(Alpha, EachLayerStopsItsShare) {
  const Scene scene = three_layers(0.25f);
  const Bvh bvh(scene);
  constexpr int kRays = 4096;
  int front = 0, far_wall = 0, by[3] = {}, missed = 0;
  for (uint64_t k = 0; k < kRays; ++k) {
    const Hit hit = bvh.intersect(ray_of(k));
    if (!hit.valid()) {
      ++missed;
      continue;
    }
    ++by[hit.shape];
    if (hit.shape == 1) ++(hit.t < 4 ? front : far_wall);
  }
  EXPECT_NEAR(by[0], kRays * 0.25, 140);
  EXPECT_NEAR(front, kRays * 0.75 * 0.25, 140);
  EXPECT_NEAR(far_wall, kRays * 0.75 * 0.75 * 0.25, 140);
  EXPECT_NEAR(by[2], kRays * 0.421875 * 0.25, 140);
  EXPECT_NEAR(missed, kRays * 0.31640625, 140);
}

void expect_the_same_answers(const Scene& scene) {
  const Bvh bvh(scene);
  for (uint64_t group = 0; group < 20; ++group) {
    RayLanes rays{};
    HitLanes hits{};
    for (size_t k = 0; k < kRayLanes; ++k) {
      const Ray ray = ray_of(group * kRayLanes + k);
      for (int c = 0; c < 3; ++c) {
        rays.o[c][k] = ray.o[c];
        rays.d[c][k] = ray.d[c];
      }
    }
    bvh.intersect(rays, kRayLanes, &hits);
    for (size_t k = 0; k < kRayLanes; ++k) {
      const Ray ray = ray_of(group * kRayLanes + k);
      const Hit one = bvh.intersect(ray), many = hits.get(k);
      ASSERT_EQ(one.shape, many.shape);
      ASSERT_EQ(one.valid(), bvh.occluded(ray));
      if (!one.valid()) continue;
      ASSERT_EQ(one.t, many.t);
    }
  }
}

TEST(Alpha, PacketsAndShadowRaysAgreeWithSingleRays) {
  expect_the_same_answers(three_layers(0.5f));
  expect_the_same_answers(three_instances(0.5f));
}

// Instances of one mesh decide independently: the shares are 1/4, 3/16 and, for the opaque one, 9/16. With
// 4096 rays five standard deviations are below 160.
TEST(Alpha, EachInstanceStopsItsShare) {
  const Scene scene = three_instances(0.25f);
  const Bvh bvh(scene);
  constexpr int kRays = 4096;
  int by[3] = {};
  for (uint64_t k = 0; k < kRays; ++k) {
    const Hit hit = bvh.intersect(ray_of(k));
    ASSERT_TRUE(hit.valid());
    ++by[hit.shape];
  }
  EXPECT_NEAR(by[0], kRays * 0.25, 160);
  EXPECT_NEAR(by[1], kRays * 0.1875, 160);
  EXPECT_NEAR(by[2], kRays * 0.5625, 160);
}

TEST(Alpha, AlphaZeroIsInvisible) {
  const Scene scene = three_layers(0);
  const Bvh bvh(scene);
  for (uint64_t k = 0; k < 100; ++k) EXPECT_FALSE(bvh.occluded(ray_of(k)));
}

}  // namespace
}  // namespace kaustik::accel
