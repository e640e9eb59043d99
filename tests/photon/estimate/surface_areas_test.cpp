// Tests the share of a gather disc on curved surfaces against closed forms for balls and tubes.

#include "photon/estimate/surface_areas.h"

#include <gtest/gtest.h>

#include <numbers>

#include "photon/estimate/radiance_estimate.h"
#include "photon/estimate/walls.h"
#include "tests/photon/support/photon_sets.h"
#include "tests/photon/support/trace_scenes.h"
#include "tests/support/shapes.h"

namespace kaustik::photon {
namespace {

// The surface is cut into pieces, and pieces at the rim of the disc count as a whole. A disc of radius F
// pieces has pi F^2 pieces, 2 pi F of them at the rim, each wrong by a number that is uniform in [-1/2, 1/2],
// so with a variance of 1/12. Where the surface crosses voxels diagonally, pieces are up to sqrt(3) times as
// large and fewer by that factor. The tolerance is four standard errors.
const double kPieceError =
    4 * std::sqrt(std::numbers::sqrt3 * 2 * std::numbers::pi * SurfaceAreas::kFineness / 12) /
    (std::numbers::pi * SurfaceAreas::kFineness * SurfaceAreas::kFineness);

Scene scene_of(std::vector<Shape> shapes) {
  Scene scene;
  scene.shapes = std::move(shapes);
  scene.materials = {Lambertian{Rgb(1)}};
  finalize_scene(scene);
  return scene;
}

SurfaceAreas areas_of(std::vector<Shape> shapes, float radius) {
  const Scene scene = scene_of(std::move(shapes));
  std::vector<SurfaceBend> bends;
  find_boundary_edges(scene.shapes, &bends);
  return SurfaceAreas(scene, bends, radius);
}

SurfaceInteraction at(const Point3& p, const Normal3& n, uint32_t group = 0) {
  SurfaceInteraction si;
  si.p = p;
  si.n = si.ns = n;
  si.surface_group = group;
  return si;
}

Shape ball(float radius) {
  Shape shape;
  shape.geometry = Sphere{Transform::from_matrix(glm::dmat4(glm::dmat3(double(radius))))};
  return shape;
}

// Not round enough for the closed form, and a ball up to far less than kPieceError.
Shape nearly_a_ball(float radius = 1) {
  glm::dmat3 m{double(radius)};
  m[2] *= 1.0001;
  Shape shape;
  shape.geometry = Sphere{Transform::from_matrix(glm::dmat4(m))};
  return shape;
}

// The cap of a sphere within a distance r of its pole has the area of a disc of radius r, up to 60 degrees
// away, where r is the sphere's radius and normals cease to count.
TEST(SurfaceAreas, DiscOnABallIsFullUpToTheBallsRadius) {
  ASSERT_FALSE(std::get<Sphere>(nearly_a_ball().geometry).radius());
  for (const float radius : {0.5f, 0.9f, 1.2f, 2.0f, 5.0f}) {
    const SurfaceAreas closed = areas_of({ball(1)}, radius), pieces = areas_of({nearly_a_ball()}, radius);
    ASSERT_TRUE(closed.covers(0) && pieces.covers(0));
    for (const Normal3& n : {Normal3(0, 0, 1), Normal3(0.6f, 0, -0.8f), glm::normalize(Normal3(1, 2, 3))}) {
      const float expected = std::min(1.0f, 1 / (radius * radius));
      EXPECT_NEAR(closed.share(at(n, n), {}, radius), expected, 1e-6) << radius;
      if (std::abs(n.z) < 0.9f) {  // the strips about a pole reach the limit of normals all at once
        EXPECT_NEAR(pieces.share(at(n, n), {}, radius), expected, kPieceError) << radius;
      }
    }
  }
}

// A wall that stands on the ball hides what is behind it from the points in front. The sum over rings and the
// one over pieces agree. Each ring is met by the wall at two places, each of which is off by half a sector of
// 32 at most.
TEST(SurfaceAreas, WallsHidePartsOfABall) {
  constexpr float kRadius = 0.8f;
  for (const bool inside : {false, true}) {
    Shape round = ball(1), other = nearly_a_ball();
    round.flip_normal = other.flip_normal = inside;
    const SurfaceInteraction si = at({1, 0, 0}, {inside ? -1.0f : 1.0f, 0, 0});
    BoundaryEdge foot;
    foot.a = {1, 0.3f, -2};
    foot.b = {1, 0.3f, 2};
    foot.n = si.n;
    const Walls walls({foot}, {Point3(-2), Point3(2)}, kRadius);
    for (const KernelSpec& kernel :
         {KernelSpec{KernelType::kConstant, 1}, KernelSpec{KernelType::kCone, 1.1f}}) {
      const WallCut cut(walls, si, si.n, si.n, kRadius);
      ASSERT_TRUE(cut.cuts());
      const double share = areas_of({round}, kRadius).share(si, kernel, kRadius, &cut);
      EXPECT_LT(share, 0.9);
      EXPECT_NEAR(share, areas_of({other}, kRadius).share(si, kernel, kRadius, &cut), kPieceError + 1 / 32.0);
    }
  }
}

// Each takes hundreds of pieces, however small it is; balls take none.
TEST(SurfaceAreas, PiecesOfManyQuadricsAreLimited) {
  constexpr uint32_t kShapes = 2000;
  const auto many = [](const Shape& shape) {
    std::vector<Shape> shapes(kShapes, shape);
    for (uint32_t i = 0; i < kShapes; ++i) shapes[i].surface_group = i;
    return shapes;
  };
  const auto balls = many(ball(0.01f)), others = many(nearly_a_ball(0.01f));
  EXPECT_EQ(SurfaceAreas::most_pieces(scene_of(balls)), 0u);
  EXPECT_EQ(SurfaceAreas::most_pieces(scene_of(others)), SurfaceAreas::kMostPieces);
  EXPECT_TRUE(areas_of(balls, 1).covers(kShapes - 1));
  const SurfaceAreas areas = areas_of(others, 1);
  EXPECT_TRUE(areas.covers(0));
  EXPECT_FALSE(areas.covers(kShapes - 1));
}

// The midpoint rule over azimuth and height.
double share_of_tube(double a, const KernelSpec& kernel, double radius) {
  constexpr int kSteps = 2000;
  const KernelTerms terms = kernel_terms(kernel, float(radius));
  double sum = 0;
  for (int i = 0; i < kSteps; ++i) {
    const double phi = std::numbers::pi / 3 * (2 * (i + 0.5) / kSteps - 1), chord = 2 * a * std::sin(phi / 2);
    if (std::abs(chord) >= radius) continue;
    const double half = std::sqrt(radius * radius - chord * chord), step = 2 * half / kSteps;
    for (int j = 0; j < kSteps; ++j) {
      const double z = (j + 0.5) * step - half;
      sum += double(kernel_value(kernel.type, terms, float(chord * chord + z * z))) * step;
    }
  }
  return sum * a * 2 * std::numbers::pi / 3 / kSteps;
}

TEST(SurfaceAreas, DiscOnATubeIsAStrip) {
  constexpr float kTube = 0.25f;
  // With 128 sides the facets' normals are off by 1.4 degrees, which changes up to 1 in 43 of a strip 120
  // degrees wide.
  const double tolerance = kPieceError + 1 / 43.0;
  for (const KernelSpec& kernel :
       {KernelSpec{KernelType::kConstant, 1}, KernelSpec{KernelType::kEpanechnikov, 1}})
    for (const float radius : {0.2f, 0.5f, 1.0f, 2.0f}) {
      const SurfaceAreas areas = areas_of({test::tube(kTube, 8, 128, 16)}, radius);
      ASSERT_TRUE(areas.covers(0)) << radius;
      EXPECT_NEAR(areas.share(at({kTube, 0, 0.1f}, {1, 0, 0}), kernel, radius),
                  share_of_tube(double(kTube), kernel, double(radius)), tolerance)
          << radius;
    }
}

// The outside of an instance is the side that SurfaceInteraction uses, mirrored or not, whether vertex
// normals or the winding define it.
TEST(SurfaceAreas, UseTheOutsideOfInstances) {
  constexpr float kTube = 0.25f, kRadius = 0.5f;
  for (const bool with_normals : {false, true})
    for (const bool flip : {false, true})
      for (const float mirror : {1.0f, -1.0f}) {
        auto mesh = std::get<TriangleMesh>(test::tube(kTube, 8, 128, 16).geometry);
        // The builder turns the vertex normals of a reversed shape over.
        if (with_normals)
          for (const Point3& p : mesh.P)
            mesh.N.push_back((flip ? -1.0f : 1.0f) * glm::normalize(Normal3(p.x, p.y, 0)));
        Shape shape;
        shape.flip_normal = flip;
        const auto to_world = Transform::from_matrix(glm::dmat4(glm::dmat3(double(mirror))));
        shape.geometry = InstancedMesh{
            std::make_shared<const TriangleMesh>(mesh), {{-kTube, -kTube, -4}, {kTube, kTube, 4}}, to_world};
        const Scene scene = scene_of({shape});
        const Ray ray{{2, 0.01f, 0.1f}, {-1, 0, 0}};
        const SurfaceInteraction si = make_interaction(scene.shapes, ray, accel::Bvh(scene).intersect(ray));
        EXPECT_NEAR(si.n.x, flip ? -1 : 1, 0.01f);
        const double tolerance = kPieceError + 1 / 43.0;
        EXPECT_NEAR(areas_of({shape}, kRadius).share(si, {}, kRadius), share_of_tube(kTube, {}, kRadius),
                    tolerance)
            << with_normals << flip << mirror;
      }
}

// A wire under even light of 1 W/m^2 shows 1/pi, gathered with discs five times as wide as the wire.
TEST(SurfaceAreas, KeepTheBrightnessOfAWire) {
  constexpr float kWire = 0.05f, kLength = 4, kRadius = 0.25f;
  constexpr int kPhotons = 200000;
  const float flux = 2 * kPi * kWire * kLength / kPhotons;
  PhotonMaker make(5);
  std::vector<Photon> photons;
  for (int i = 0; i < kPhotons; ++i) {
    const float phi = 2 * kPi * make.uniform();
    const Normal3 n(std::cos(phi), std::sin(phi), 0);
    const Point3 p(kWire * n.x, kWire * n.y, kLength * (make.uniform() - 0.5f));
    photons.push_back({p, n, Rgb(flux), n, 0});
  }
  const PhotonMap map = PhotonMap::build(make_buffer(photons, 0x1p-17f));
  const SurfaceAreas areas = areas_of({test::tube(kWire, kLength, 128, 64)}, kRadius);
  const accel::EdgeIndex edges{{}};
  EstimateSettings settings{kRadius, {}, 0, false, 64, nullptr, &edges, &areas};
  const auto irradiance = [&](const Normal3& n) {
    GatherCounters counters;
    const SurfaceInteraction si = at({kWire * n.x, kWire * n.y, 0.3f}, n);
    return kPi * estimate_radiance(map, si, n, Lambertian{Rgb(1)}, settings, counters).x;
  };
  // The disc holds a strip of 2/3 pi a times 2 r, so 8000 photons: four standard errors are 4.5 %. At the
  // strip's ends the normals decide, in bins of four degrees: another 2 in 60.
  for (const Normal3& n : {Normal3(1, 0, 0), Normal3(0, -1, 0), Normal3(0.6f, 0.8f, 0)})
    EXPECT_NEAR(irradiance(n), 1, 0.045 + 2 / 60.0);
  settings.areas = nullptr;
  EXPECT_LT(irradiance({1, 0, 0}), 0.3);
}

// As for the wire; the disc holds the photons of a quarter of the ball, so 50,000: four standard errors are
// 1.8 %. The normals of photons are off by up to 0.0175 rad; if all were so to one side, the limit of 60
// degrees would move by as much, and the area with it by twice the sine of 60 degrees times that, 3.0 %.
TEST(SurfaceAreas, KeepTheBrightnessOfABall) {
  constexpr float kBall = 0.05f, kRadius = 0.25f;
  constexpr int kPhotons = 200000;
  const float flux = 4 * kPi * kBall * kBall / kPhotons;
  PhotonMaker make(5);
  std::vector<Photon> photons;
  for (int i = 0; i < kPhotons; ++i) {
    const float z = 2 * make.uniform() - 1, phi = 2 * kPi * make.uniform(), r = std::sqrt(1 - z * z);
    const Normal3 n(r * std::cos(phi), r * std::sin(phi), z);
    photons.push_back({kBall * n, n, Rgb(flux), n, 0});
  }
  const PhotonMap map = PhotonMap::build(make_buffer(photons, 0x1p-22f));
  const SurfaceAreas areas = areas_of({ball(kBall)}, kRadius);
  const accel::EdgeIndex edges{{}};
  const EstimateSettings settings{kRadius, {}, 0, false, 64, nullptr, &edges, &areas};
  for (const Normal3& n : {Normal3(1, 0, 0), Normal3(0, -1, 0), glm::normalize(Normal3(1, 2, 3))}) {
    GatherCounters counters;
    const Rgb Lr = estimate_radiance(map, at(kBall * n, n), n, Lambertian{Rgb(1)}, settings, counters);
    EXPECT_NEAR(kPi * Lr.x, 1, 0.018 + 0.03);
  }
}

// A tube whose triangles are there twice, or once more the other way round, has the surface of one.
TEST(SurfaceAreas, CoincidentTrianglesCountOnce) {
  const Shape single = test::tube(0.25f, 8, 64, 16);
  const SurfaceInteraction outside = at({0.25f, 0, 0}, {1, 0, 0}), inside = at({0.25f, 0, 0}, {-1, 0, 0});
  constexpr float kRadius = 0.4f;  // less than the tube is wide, so that its far side is out of reach
  const double expected = areas_of({single}, kRadius).share(outside, {}, kRadius);
  Shape twice = single, both_ways = single;
  auto &copies = std::get<TriangleMesh>(twice.geometry).indices,
       &turned = std::get<TriangleMesh>(both_ways.geometry).indices;
  for (size_t i = 0, end = copies.size(); i < end; ++i) {
    copies.push_back(copies[i]);
    turned.push_back({turned[i][0], turned[i][2], turned[i][1]});
  }
  // Pieces are joined in a few places only, so the sums differ by rounding.
  EXPECT_NEAR(areas_of({twice}, kRadius).share(outside, {}, kRadius), expected, 1e-5);
  const SurfaceAreas areas = areas_of({both_ways}, kRadius);
  EXPECT_NEAR(areas.share(outside, {}, kRadius), expected, 1e-5);
  EXPECT_NEAR(areas.share(inside, {}, kRadius), expected, 1e-5);
}

TEST(SurfaceAreas, LeaveFlatSurfacesToTheirEdges) {
  EXPECT_FALSE(areas_of({ball(1)}, 0.05f).covers(0));
  Shape wall;
  wall.geometry = TriangleMesh{{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {}, {}, {{0, 1, 2}, {0, 2, 3}}};
  EXPECT_FALSE(areas_of({wall}, 10).covers(0));
}

// Where windings differ from facet to facet it is unknown which normals belong together.
TEST(SurfaceAreas, IgnoreMeshesWithMixedWindings) {
  Shape mixed = test::tube(0.25f, 8, 128, 16);
  auto& indices = std::get<TriangleMesh>(mixed.geometry).indices;
  for (size_t i = 0; i < indices.size(); i += 2) std::swap(indices[i][0], indices[i][1]);
  EXPECT_FALSE(areas_of({mixed}, 1).covers(0));
}

TEST(SurfaceAreas, ScaleWithTheScene) {
  const auto share = [](float scale) {
    Shape shape = test::tube(0.25f * scale, 8 * scale, 32, 16);
    return areas_of({shape}, scale).share(at({0.25f * scale, 0, 0}, {1, 0, 0}), {}, scale);
  };
  for (const int k : {-30, 30}) EXPECT_EQ(share(std::ldexp(1.0f, k)), share(1)) << k;
}

}  // namespace
}  // namespace kaustik::photon
