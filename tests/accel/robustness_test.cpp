// Tests what rounding must never cause: leaks through a closed mesh, or hits on the surface that a ray starts
// from.

#include <gtest/gtest.h>

#include "accel/bvh.h"
#include "tests/accel/support/random_scenes.h"

namespace kaustik::accel {
namespace {

using test::Placement;
using test::Random;

// Rays from inside a closed, bumpy mesh, where two triangles must share every point of an edge without a gap.
// Embree's robust mode promises this for edges. Around a vertex its edge functions are rounded one by one,
// and a ray aimed exactly at the floats of a vertex slips through once in about ten thousand. A ray that is
// not aimed would have to come within a rounding error of a vertex in two dimensions, and none does.
TEST(Robustness, ClosedMeshIsWatertight) {
  for (const Placement& place : {Placement{}, Placement{1e-5f, {0, 0, 0}}, Placement{1e4f, {0, 0, 0}},
                                 Placement{1, {1000, -500, 2000}}}) {
    SCOPED_TRACE(::testing::Message() << "scale " << place.scale << " offset " << place.offset.x);
    Random random(11);
    TriangleMesh mesh = test::icosphere(3);
    for (Point3& p : mesh.P) p = place.point(random.uniform(0.9f, 1.1f) * p);
    Scene scene;
    Shape shape;
    shape.geometry = mesh;
    scene.shapes.push_back(shape);
    test::finish(scene);
    const Bvh bvh(scene);
    const auto leak = [&](const Vector3& d) {
      return !bvh.occluded({place.point(0.4f * random.in_cube()), d});
    };
    const auto leak_towards = [&](const Point3& target) {
      const Point3 o = place.point(0.4f * random.in_cube());
      return !bvh.occluded({o, target - o}) || !bvh.intersect({o, glm::normalize(target - o)}).valid();
    };
    int at_edges = 0, at_vertices = 0, anywhere = 0;
    for (const auto& triangle : mesh.indices) {
      for (int k = 0; k < 3; ++k) {
        const Point3 a = mesh.P[triangle[k]], b = mesh.P[triangle[(k + 1) % 3]];
        at_edges += leak_towards(0.5f * a + 0.5f * b) + leak_towards(a + random.uniform() * (b - a));
        at_vertices += leak_towards(a);
      }
    }
    for (int i = 0; i < 300000; ++i) anywhere += leak(random.direction());
    EXPECT_EQ(at_edges, 0);
    EXPECT_EQ(anywhere, 0);
    EXPECT_LE(at_vertices, static_cast<int>(3 * mesh.indices.size()) / 500);
  }
}

// A random direction at the angle acos(cosine) from n.
Vector3 tilted(const Normal3& n, float cosine, Random& random) {
  const Frame frame = Frame::from_z(n);
  const float phi = random.uniform(0, 2 * kPi), sine = std::sqrt(1 - cosine * cosine);
  return frame.to_world({sine * std::cos(phi), sine * std::sin(phi), cosine});
}

// From directions near the normal to directions that floats can hardly tell from the plane.
const float kCosines[] = {0.9f, 0.3f, 1e-1f, 1e-2f, 1e-3f, 1e-4f, 1e-5f, 1e-6f};

const Placement kPlaces[] = {Placement{},
                             Placement{1e-6f, {0, 0, 0}},
                             Placement{1e6f, {0, 0, 0}},
                             Placement{1, {1e3f, 0, 0}},
                             Placement{1e-2f, {1e4f, -1e4f, 3e3f}},
                             Placement{1, {0.5f, 1e5f, 0}}};

// In a scene of one triangle, any hit of a ray that left it is a self-hit.
TEST(Robustness, RaysNeverHitTheTriangleTheyLeave) {
  Random random(12);
  int tried = 0;
  for (const Placement& place : kPlaces) {
    for (int round = 0; round < 300; ++round) {
      Scene scene;
      test::add_triangles(scene, random, place, 1, random.uniform(0.01f, 1));
      test::finish(scene);
      const Bvh bvh(scene);
      const auto& P = std::get<TriangleMesh>(scene.shapes[0].geometry).P;
      for (int i = 0; i < 10; ++i) {
        const float b1 = random.uniform(), b2 = random.uniform(0, 1 - b1);
        const Point3 target = (1 - b1 - b2) * P[0] + b1 * P[1] + b2 * P[2];
        const Point3 o = place.point(3.0f * random.in_cube());
        SurfaceInteraction si;
        if (!bvh.intersect({o, glm::normalize(target - o)}, &si)) continue;
        for (float cosine : kCosines) {
          for (float side : {-1.0f, 1.0f}) {
            const Vector3 w = side * tilted(si.n, cosine, random);
            ++tried;
            ASSERT_FALSE(bvh.intersect(si.spawn(w)).valid())
                << "scale " << place.scale << " offset " << place.offset.x << " cosine " << cosine;
          }
        }
      }
    }
  }
  EXPECT_GT(tried, 100000);
}

// A triangle of an instance under any transform: turned, mirrored and scaled unevenly.
TEST(Robustness, RaysNeverHitTheInstanceTheyLeave) {
  Random random(16);
  int tried = 0;
  for (const Placement& place : kPlaces) {
    for (int round = 0; round < 300; ++round) {
      Scene scene;
      test::add_instances(scene, random, place, 1, 1, round % 2 ? 1.0f : 1e3f);
      test::finish(scene);
      const Bvh bvh(scene);
      const auto& instance = std::get<InstancedMesh>(scene.shapes[0].geometry);
      const auto& P = instance.mesh->P;
      for (int i = 0; i < 10; ++i) {
        const float b1 = random.uniform(), b2 = random.uniform(0, 1 - b1);
        const Point3 target = instance.to_world.point((1 - b1 - b2) * P[0] + b1 * P[1] + b2 * P[2]);
        const Point3 o = place.point(3.0f * random.in_cube());
        SurfaceInteraction si;
        if (!bvh.intersect({o, glm::normalize(target - o)}, &si)) continue;
        // The error bound is a few units in the last place of the coordinates, so that the offset stays
        // small.
        ASSERT_LT(si.p_error, 1e-4f * place.scale * (2 + glm::length(place.offset)));
        for (float cosine : kCosines) {
          for (float side : {-1.0f, 1.0f}) {
            ++tried;
            ASSERT_FALSE(bvh.intersect(si.spawn(side * tilted(si.n, cosine, random))).valid())
                << "scale " << place.scale << " offset " << place.offset.x << " cosine " << cosine;
          }
        }
      }
    }
  }
  EXPECT_GT(tried, 50000);
}

// Rays leave outwards; inwards they would meet the far side of a round shape.
TEST(Robustness, RaysNeverHitTheQuadricTheyLeave) {
  Random random(17);
  int tried = 0;
  for (const Placement& place : kPlaces) {
    for (int round = 0; round < 300; ++round) {
      Scene scene;
      test::add_quadrics(scene, random, place, 3);
      std::swap(scene.shapes[0], scene.shapes[size_t(round % 3)]);
      scene.shapes.resize(1);
      test::finish(scene);
      const Bvh bvh(scene);
      const Point3 center = scene.bounds.center();
      for (int i = 0; i < 20; ++i) {
        const Point3 o = place.point(3.0f * random.in_cube());
        SurfaceInteraction si;
        if (!bvh.intersect({o, glm::normalize(center - o)}, &si)) continue;
        for (float cosine : kCosines) {
          ++tried;
          ASSERT_FALSE(bvh.intersect(si.spawn(tilted(si.n, cosine, random))).valid())
              << "scale " << place.scale << " offset " << place.offset.x << " cosine " << cosine;
        }
      }
    }
  }
  EXPECT_GT(tried, 20000);
}

TEST(Robustness, RaysNeverHitTheSphereOrDiskTheyLeave) {
  Random random(13);
  int tried = 0;
  for (const Placement& place : kPlaces) {
    for (int round = 0; round < 300; ++round) {
      Scene scene;
      const bool disk = round % 2 == 0;
      if (disk) {
        test::add_disks(scene, random, place, 1);
      } else {
        test::add_spheres(scene, random, place, 1, round % 4 == 1);
      }
      test::finish(scene);
      const Bvh bvh(scene);
      const Point3 center = scene.bounds.center();
      for (int i = 0; i < 10; ++i) {
        const Point3 o = place.point(3.0f * random.in_cube());
        SurfaceInteraction si;
        if (!bvh.intersect({o, glm::normalize(center - o)}, &si)) continue;
        for (float cosine : kCosines) {
          const Vector3 w = tilted(si.n, cosine, random);
          ++tried;
          ASSERT_FALSE(bvh.intersect(si.spawn(w)).valid())
              << "scale " << place.scale << " offset " << place.offset.x << " cosine " << cosine;
          if (disk) {
            ASSERT_FALSE(bvh.intersect(si.spawn(-w)).valid()) << "cosine " << cosine;
          }
        }
      }
    }
  }
  EXPECT_GT(tried, 50000);
}

// From inside a sphere every ray meets the far side, a chord away, and never its starting point.
TEST(Robustness, RaysInsideASphereMeetItsFarSide) {
  for (const Placement& place :
       {Placement{}, Placement{1e-6f, {0, 0, 0}}, Placement{1e6f, {0, 0, 0}}, Placement{1, {10, -7, 3}}}) {
    Random random(14);
    Scene scene;
    test::add_spheres(scene, random, place, 1, false);
    test::finish(scene);
    const Bvh bvh(scene);
    const Point3 center = scene.bounds.center();
    const float radius = 0.5f * scene.bounds.diagonal().x;
    for (int i = 0; i < 2000; ++i) {
      SurfaceInteraction si;
      ASSERT_TRUE(bvh.intersect({center, random.direction()}, &si));
      for (float cosine : {1.0f, 0.5f, 0.1f, 0.01f}) {
        const Hit far = bvh.intersect(si.spawn(-tilted(si.n, cosine, random)));
        ASSERT_TRUE(far.valid()) << cosine;
        // The chord is 2 r cosine. Its error is that of the cosine, from the float normal and direction, and
        // the offsets of the two points divided by the cosine, each some units in the last place of the
        // coordinates.
        const float error =
            32 * std::numeric_limits<float>::epsilon() * (radius + glm::length(center)) / cosine;
        ASSERT_NEAR(far.t, 2 * radius * cosine, error) << cosine;
      }
    }
  }
}

// Between two surface points only an object placed there may block the segment.
TEST(Robustness, SegmentsBetweenSurfacePointsAreBlockedOnlyByObjectsBetween) {
  for (const Placement& place : kPlaces) {
    Random random(15);
    const auto wall = [&](float z) {
      TriangleMesh mesh;
      for (const Vector2& c : {Vector2(-1, -1), Vector2(1, -1), Vector2(1, 1), Vector2(-1, 1)})
        mesh.P.push_back(place.point({c.x, c.y, z}));
      mesh.indices = {{0, 1, 2}, {0, 2, 3}};
      Shape shape;
      shape.geometry = mesh;
      return shape;
    };
    Scene open, blocked;
    open.shapes = {wall(-1), wall(1)};
    blocked.shapes = {wall(-1), wall(1), wall(0)};
    test::finish(open);
    test::finish(blocked);
    const Bvh open_bvh(open), blocked_bvh(blocked);
    const Point3 middle = place.point({0, 0, 0.5f});
    for (int i = 0; i < 2000; ++i) {
      const auto target = [&](float z) {
        return place.point({random.uniform(-0.9f, 0.9f), random.uniform(-0.9f, 0.9f), z});
      };
      SurfaceInteraction a, b;
      ASSERT_TRUE(blocked_bvh.intersect({middle, target(1) - middle}, &b));
      ASSERT_TRUE(open_bvh.intersect({middle, target(-1) - middle}, &a));
      const Point3 end = b.spawn(a.p - b.p).o;
      const Point3 start = a.spawn(end - a.p).o;
      ASSERT_FALSE(open_bvh.occluded({start, end - start, 1})) << i;
      ASSERT_TRUE(blocked_bvh.occluded({start, end - start, 1})) << i;
    }
  }
}

}  // namespace
}  // namespace kaustik::accel
