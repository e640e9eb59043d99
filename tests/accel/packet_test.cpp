// Tests packets of rays against single rays.

#include <gtest/gtest.h>

#include <cmath>

#include "accel/bvh.h"
#include "tests/accel/support/random_scenes.h"

namespace kaustik::accel {
namespace {

using test::Placement;
using test::Random;

void expect_same(const Hit& got, const Hit& expected, size_t ray) {
  ASSERT_EQ(got.shape, expected.shape) << ray;
  if (!expected.valid()) return;
  ASSERT_EQ(got.primitive, expected.primitive) << ray;
  ASSERT_EQ(got.t, expected.t) << ray;
  ASSERT_EQ(got.uv, expected.uv) << ray;
}

// Every lane must match a single ray bit for bit, whatever the number of rays and the way in which the
// packets go through the BVH. Random rays do not meet two surfaces at the same distance.
void expect_packets_are_single_rays(const Scene& scene, const Placement& place, Random& random) {
  const Bvh bvh(scene);
  RayLanes rays{};
  // What unused lanes hold must do no harm.
  for (int c = 0; c < 3; ++c)
    for (size_t k = 0; k < kRayLanes; ++k) rays.o[c][k] = k % 2 ? NAN : 1, rays.d[c][k] = 1e30f;
  HitLanes hits{};
  size_t met = 0, traced = 0;
  for (const size_t count : {size_t{1}, size_t{15}, size_t{16}, size_t{17}, size_t{50}, kRayLanes}) {
    for (int round = 0; round < 40; ++round) {
      const Vector3 main = random.direction();
      for (size_t k = 0; k < count; ++k) {
        const Point3 o = place.point(1.5f * random.in_cube());
        const Vector3 d = round % 2 ? random.direction() : main + 0.2f * random.direction();
        for (int c = 0; c < 3; ++c) {
          rays.o[c][k] = o[c];
          rays.d[c][k] = d[c];
        }
      }
      for (const RayOrder order : {RayOrder::kMixed, RayOrder::kNeighbours}) {
        bvh.intersect(rays, count, &hits, order);
        for (size_t k = 0; k < count; ++k) {
          expect_same(hits.get(k), bvh.intersect(rays.get(k)), k);
          met += hits.valid(k);
          ++traced;
        }
      }
    }
  }
  EXPECT_GT(met, traced / 10);
  EXPECT_LT(met, traced);
}

TEST(BvhPackets, MatchSingleRaysInSmallScenes) {
  Random random(11);
  Scene scene;
  test::add_triangles(scene, random, {}, 20, 1.0f);
  test::add_spheres(scene, random, {}, 8, true);
  test::add_disks(scene, random, {}, 8);
  test::finish(scene);
  expect_packets_are_single_rays(scene, {}, random);
}

TEST(BvhPackets, MatchSingleRaysInLargeScenes) {
  Random random(12);
  Scene scene;
  const Placement place{0x1p-15f, {3, -2, 1}};
  test::add_triangles(scene, random, place, 2000, 0.2f);
  test::add_spheres(scene, random, place, 100, true);
  test::add_disks(scene, random, place, 100);
  test::finish(scene);
  expect_packets_are_single_rays(scene, place, random);
}

TEST(BvhPackets, MatchSingleRaysAmongInstancesAndQuadrics) {
  Random random(13);
  Scene scene;
  test::add_instances(scene, random, {}, 20, 40, 3);
  test::add_quadrics(scene, random, {}, 30);
  test::add_triangles(scene, random, {}, 20, 0.5f);
  test::finish(scene);
  expect_packets_are_single_rays(scene, {}, random);
}

TEST(BvhPackets, EmptySceneLetsAllRaysEscape) {
  Scene scene;
  test::finish(scene);
  RayLanes rays{};
  HitLanes hits{};
  Bvh(scene).intersect(rays, kRayLanes, &hits);
  for (size_t k = 0; k < kRayLanes; ++k) EXPECT_FALSE(hits.valid(k));
}

}  // namespace
}  // namespace kaustik::accel
