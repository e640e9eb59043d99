// Tests the share of a gather disc that lies on the surface: closed forms against sums over grids, and
// estimates of even light up to the borders.

#include "photon/estimate/boundary_correction.h"

#include <gtest/gtest.h>

#include <functional>

#include "accel/bvh.h"
#include "core/geometry/merge_edges.h"
#include "photon/estimate/radiance_estimate.h"
#include "tests/photon/support/photon_sets.h"
#include "tests/photon/support/trace_scenes.h"
#include "tests/support/packed_flux.h"
#include "tests/support/shapes.h"

namespace kaustik::photon {
namespace {

// Every kernel, the stretched ones with another slope as well.
std::vector<KernelSpec> kernels() {
  std::vector<KernelSpec> specs;
  for (const KernelRow& row : kKernels) {
    specs.push_back({row.type, 1});
    if (row.stretched) specs.push_back({row.type, 2.5f});
  }
  return specs;
}

// The midpoint rule in polar coordinates over the part of the disc behind the segment from (d, t1) to (d,
// t2), seen from the origin.
double integrated_mass(const KernelSpec& kernel, double d, double t1, double t2) {
  constexpr int kAngles = 2000, kRadii = 400;
  const KernelTerms terms = kernel_terms(kernel, 1);
  const double from = std::atan2(t1, d), step = (std::atan2(t2, d) - from) / kAngles;
  double sum = 0;
  for (int i = 0; i < kAngles; ++i) {
    const double near = d / std::cos(from + (i + 0.5) * step);
    if (near >= 1) continue;
    const double cell = (1 - near) / kRadii;
    for (int j = 0; j < kRadii; ++j) {
      const double rho = near + (j + 0.5) * cell;
      sum += double(kernel_value(kernel.type, terms, float(rho * rho))) * rho * cell * step;
    }
  }
  return sum;
}

// The integrand falls to zero with a finite slope at the rim, in one of 2000 cells at each end: an error of
// less than (pi/2000)^2. The float kernel adds 1e-7.
constexpr double kMidpointError = 4e-6;

TEST(MassBehindEdge, MatchesTheKernelsIntegral) {
  const double segments[][2] = {{-9, 9}, {-0.4, 0.7}, {0.1, 0.3}, {-0.9, -0.2}, {0.3, 5}, {0.99, 1.5}};
  for (const KernelSpec& kernel : kernels())
    for (const double d : {0.0, 1e-9, 0.05, 0.3, 0.7, 0.95})
      for (const auto& [t1, t2] : segments)
        EXPECT_NEAR(mass_behind_edge(kernel, d, t1, t2), integrated_mass(kernel, d, t1, t2), kMidpointError)
            << int(kernel.type) << ": " << d << " from " << t1 << " to " << t2;
}

TEST(MassBehindEdge, IsHalfAtTheEdgeAndZeroOutOfReach) {
  for (const KernelSpec& kernel : kernels()) {
    EXPECT_NEAR(mass_behind_edge(kernel, 0, -2, 2), 0.5, 1e-15);
    EXPECT_NEAR(mass_behind_edge(kernel, 0, 0, 2), 0.25, 1e-15);
    EXPECT_EQ(mass_behind_edge(kernel, 1, -2, 2), 0);
    EXPECT_EQ(mass_behind_edge(kernel, 0.8, 0.7, 2), 0);
  }
}

accel::EdgeIndex edges_of(Scene& scene) {
  if (scene.materials.empty()) scene.materials = {Lambertian{Rgb(1)}};
  finalize_scene(scene);
  const accel::Bvh bvh(scene);
  return accel::EdgeIndex(merge_edges(accel::without_continued(find_boundary_edges(scene.shapes), bvh)));
}

SurfaceInteraction at(const Point3& p, const Normal3& n = {0, 0, 1}) {
  SurfaceInteraction si;
  si.p = p;
  si.n = si.ns = n;
  return si;
}

// The kernel's disc about p in the plane z = 0, summed over a grid.
double grid_share(const KernelSpec& kernel, double radius, const Point3& p,
                  const std::function<bool(double, double)>& on_surface) {
  constexpr int kCells = 1000;
  const KernelTerms terms = kernel_terms(kernel, float(radius));
  const double cell = 2 * radius / kCells;
  double sum = 0;
  for (int i = 0; i < kCells; ++i)
    for (int j = 0; j < kCells; ++j) {
      const double x = (i + 0.5) * cell - radius, y = (j + 0.5) * cell - radius;
      const double d2 = x * x + y * y;
      if (d2 > radius * radius || !on_surface(double(p.x) + x, double(p.y) + y)) continue;
      sum += double(kernel_value(kernel.type, terms, float(d2))) * cell * cell;
    }
  return sum;
}

// A grid decides on whole cells: straight borders along the axes are off by at most half a cell each. About
// four borders of length 2 cross the disc, and the kernel's density is below one.
constexpr double kGridError = 4 * 2 * 0.5 * 2.0 / 1000;

const Point3 kPointsOfSquare[] = {{0.001f, 0.002f, 0}, {0.999f, 0.9995f, 0}, {0.5f, 0.5f, 0}, {0.5f, 0, 0},
                                  {0.1f, 0.3f, 0},     {0.97f, 0.95f, 0},    {0.75f, 0.5f, 0}};

void expect_shares(const accel::EdgeIndex& edges, double radius,
                   const std::function<bool(double, double)>& on_surface) {
  for (const KernelSpec& kernel : kernels())
    for (const Point3& p : kPointsOfSquare) {
      if (!on_surface(double(p.x), double(p.y))) continue;
      const double expected = grid_share(kernel, radius, p, on_surface);
      for (const float side : {1.0f, -1.0f})
        EXPECT_NEAR(surface_share(edges, at(p, {0, 0, side}), kernel, float(radius)), expected, kGridError)
            << int(kernel.type) << " at " << p.x << ' ' << p.y;
    }
}

bool in_square(double x, double y) {
  return x >= 0 && x <= 1 && y >= 0 && y <= 1;
}

TEST(SurfaceShare, SquareMatchesTheGrid) {
  Scene scene;
  scene.shapes = {test::parallelogram({0, 0, 0}, {1, 0, 0}, {0, 1, 0})};
  const accel::EdgeIndex edges = edges_of(scene);
  EXPECT_EQ(edges.size(), 4u);
  for (const double radius : {0.2, 0.6}) expect_shares(edges, radius, in_square);
}

// Copies of a surface's triangles in either winding, split along the other diagonal too, leave its border as
// it is.
TEST(SurfaceShare, CoincidentTrianglesCountOnce) {
  using Triangles = std::vector<std::array<uint32_t, 3>>;
  const Triangles square = {{0, 1, 2}, {0, 2, 3}};
  const auto edges_with = [&](const Triangles& more, bool in_one_mesh) {
    Scene scene;
    scene.shapes.resize(in_one_mesh ? 1 : 2);
    TriangleMesh mesh;
    mesh.P = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
    mesh.indices = in_one_mesh ? square : more;
    if (in_one_mesh) mesh.indices.insert(mesh.indices.end(), more.begin(), more.end());
    scene.shapes.back().geometry = mesh;
    mesh.indices = square;
    if (!in_one_mesh) scene.shapes.front().geometry = mesh;
    return edges_of(scene);
  };
  const accel::EdgeIndex single = edges_with({}, true);
  for (const Triangles& more : {square,
                                {{0, 2, 1}, {0, 3, 2}},
                                {{0, 1, 2}},
                                {{0, 1, 3}, {1, 2, 3}},
                                Triangles{{0, 1, 2}, {0, 2, 1}, {0, 2, 3}, {0, 3, 2}}})
    for (const bool in_one_mesh : {true, false}) {
      const accel::EdgeIndex edges = edges_with(more, in_one_mesh);
      EXPECT_EQ(edges.size(), 4u);
      for (const Point3& p : kPointsOfSquare)
        for (const float side : {1.0f, -1.0f})
          EXPECT_EQ(surface_share(edges, at(p, {0, 0, side}), {}, 0.2f),
                    surface_share(single, at(p, {0, 0, side}), {}, 0.2f))
              << p.x << ' ' << p.y;
    }
}

// The lower face of a wedge of 30 degrees ends at the common edge, but it is no part of the upper one's
// plane.
TEST(SurfaceShare, AWedgeHasOneEdgeForEachFace) {
  Scene scene;
  TriangleMesh mesh;
  mesh.P = {{0, 0, 0}, {0, 1, 0}, {1, 0, 0}, {1, 1, 0}, {0.866f, 0, -0.5f}, {0.866f, 1, -0.5f}};
  mesh.indices = {{0, 2, 3}, {0, 3, 1}, {0, 5, 4}, {0, 1, 5}};
  scene.shapes.resize(1);
  scene.shapes[0].geometry = mesh;
  const accel::EdgeIndex edges = edges_of(scene);
  EXPECT_NEAR(surface_share(edges, at({0, 0.5f, 0}), {}, 0.2f), 0.5, 1e-6);
}

// This shape is not star-shaped: the far sides of the hole come back within reach. It has eight tiles, every
// second one wound the other way.
TEST(SurfaceShare, SquareWithAHoleMatchesTheGrid) {
  Scene scene;
  for (int i = 0; i < 9; ++i) {
    if (i == 4) continue;
    const Vector3 x(0.25f, 0, 0), y(0, 0.25f, 0);
    const Point3 corner(0.125f + 0.25f * float(i % 3), 0.125f + 0.25f * float(i / 3), 0);
    scene.shapes.push_back(i % 2 ? test::parallelogram(corner, y, x) : test::parallelogram(corner, x, y));
  }
  const accel::EdgeIndex edges = edges_of(scene);
  EXPECT_EQ(edges.size(), 16u);
  const auto on_surface = [](double x, double y) {
    const double u = std::abs(x - 0.5), v = std::abs(y - 0.5);
    return std::max(u, v) <= 0.375 && std::max(u, v) >= 0.125;
  };
  for (const double radius : {0.2, 0.35}) {
    expect_shares(edges, radius, on_surface);
    const Point3 p(0.25f, 0.5f, 0);
    EXPECT_NEAR(surface_share(edges, at(p), {}, float(radius)), grid_share({}, radius, p, on_surface),
                kGridError);
  }
}

// The rim's polygon is within 1 - cos(pi/64) = 0.0012 of the rim's radius of the circle, here 0.012 of the
// gather disc's radius.
TEST(SurfaceShare, DiskMatchesTheGrid) {
  Scene scene;
  Shape shape;
  shape.geometry = Disk{Transform::from_matrix(glm::dmat4(1)), 0.5f};
  scene.shapes = {shape};
  const accel::EdgeIndex edges = edges_of(scene);
  EXPECT_EQ(edges.size(), 128u);
  const auto on_surface = [](double x, double y) { return std::hypot(x, y) <= 1 && std::hypot(x, y) >= 0.5; };
  for (const KernelSpec& kernel : kernels())
    for (const float x : {0.5f, 0.55f, 0.75f, 0.92f, 1.0f})
      EXPECT_NEAR(surface_share(edges, at({x, 0, 0}), kernel, 0.1f),
                  grid_share(kernel, 0.1, {x, 0, 0}, on_surface), 0.012 + kGridError)
          << x;
}

TEST(SurfaceShare, IsOneAtSeamsWithinASurface) {
  Scene scene;
  scene.shapes = {test::parallelogram({0, 0, 0}, {1, 0, 0}, {0, 1, 0}),
                  test::parallelogram({1, 0, 0}, {0, 1, 0}, {1, 0, 0}),  // shares a side, wound the other way
                  test::parallelogram({0, 1, 0}, {2, 0, 0}, {0, 1, 0}),  // T-junction with both
                  test::parallelogram({0, -1, 0}, {2, 0, 0}, {0, 0.99999994f, 0})};  // unwelded by rounding
  const accel::EdgeIndex edges = edges_of(scene);
  for (const Point3 p : {Point3(1, 0.5f, 0), Point3(1, 1, 0), Point3(0.5f, 1, 0), Point3(1, 0, 0)})
    EXPECT_EQ(surface_share(edges, at(p), {}, 0.3f), 1) << p.x << ' ' << p.y;
  EXPECT_NEAR(surface_share(edges, at({0, 1, 0}), {}, 0.3f), 0.5, 1e-6);
}

// Floor and wall belong to one mesh; each ends at the crease.
TEST(SurfaceShare, EndsAtCreasesOnBothSides) {
  TriangleMesh mesh;
  mesh.P = {{-1, 0, 0}, {1, 0, 0}, {0.999f, 0.9995f, 0}, {-1, 1, 0}, {1, 0, 1}, {-1, 0, 1}};
  for (const bool same_winding : {true, false}) {
    mesh.indices = {{0, 1, 2}, {0, 2, 3}, {0, 4, 1}, {0, 5, 4}};
    if (!same_winding) mesh.indices = {{0, 1, 2}, {0, 2, 3}, {0, 1, 4}, {0, 4, 5}};
    Scene scene;
    scene.shapes.resize(1);
    scene.shapes[0].geometry = mesh;
    const accel::EdgeIndex edges = edges_of(scene);
    EXPECT_EQ(edges.size(), 6u + 2u);
    for (const float d : {0.0f, 0.05f, 0.15f}) {
      const double expected = 1 - mass_behind_edge({}, double(d / 0.2f), -9, 9);
      const float wall_normal = same_winding ? 1.0f : -1.0f;
      EXPECT_NEAR(surface_share(edges, at({0, d, 0}), {}, 0.2f), expected, 1e-6);
      EXPECT_NEAR(surface_share(edges, at({0, 0, d}, {0, wall_normal, 0}), {}, 0.2f), expected, 1e-6);
    }
    // A surface turned by 45 degrees against both accepts photons of both, so the crease is no edge for it.
    const Normal3 between = glm::normalize(Normal3(0, 1, 1));
    EXPECT_EQ(surface_share(edges, at({0, 0, 0}, between), {}, 0.2f), 1);
  }
}

// The lower rim of a thin slab is within reach of its top, but is not part of the top.
TEST(SurfaceShare, EachSideOfAThinSlabHasOneRim) {
  TriangleMesh mesh;
  for (int i = 0; i < 8; ++i) mesh.P.push_back({float(i & 1), float(i >> 1 & 1), (i >> 2) ? 0.02f : 0.0f});
  mesh.indices = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                  {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
  Scene scene;
  scene.shapes.resize(1);
  scene.shapes[0].geometry = mesh;
  const accel::EdgeIndex edges = edges_of(scene);
  EXPECT_EQ(edges.size(), 24u);  // twelve edges, each counted for both of its faces
  EXPECT_NEAR(surface_share(edges, at({0.5f, 0, 0.02f}), {}, 0.2f), 0.5, 1e-6);
  EXPECT_NEAR(surface_share(edges, at({0.5f, 0, 0}, {0, 0, -1}), {}, 0.2f), 0.5, 1e-6);
}

// Both sides of a wall that is thin beside the disc, modelled with their outsides alike, end at its rim. No
// photon that counts on one of them lies on the other. The facets bend by 3.75 degrees.
TEST(SurfaceShare, EachSideOfAThinShellEndsOnce) {
  const auto edges_with = [](const std::vector<float>& radii) {
    Scene scene;
    for (const float radius : radii) scene.shapes.push_back(test::tube(radius, 2, 96, 1));
    return edges_of(scene);
  };
  const accel::EdgeIndex both = edges_with({1, 0.98f}), outer = edges_with({1}), inner = edges_with({0.98f});
  const float phi = kPi / 96, middle = std::cos(phi);
  const Normal3 n(std::cos(phi), std::sin(phi), 0);
  for (const float above_rim : {0.001f, 0.05f, 0.2f}) {
    const Vector3 z(0, 0, above_rim - 1);
    const Point3 of_outer = middle * n + z, of_inner = 0.98f * middle * n + z;
    EXPECT_LT(surface_share(outer, at(of_outer, n), {}, 0.3f), 0.95);
    EXPECT_NEAR(surface_share(both, at(of_outer, n), {}, 0.3f),
                surface_share(outer, at(of_outer, n), {}, 0.3f), 1e-12);
    EXPECT_NEAR(surface_share(both, at(of_inner, n), {}, 0.3f),
                surface_share(inner, at(of_inner, n), {}, 0.3f), 1e-12);
  }
}

// The edge of a box is bevelled by a strip that is narrow beside the disc. Photons on the strip count on the
// top, those on the side do not, so the disc ends between the borders of the strip.
TEST(SurfaceShare, EndsAtABevel) {
  constexpr float kBevel = 0.004f, kRadius = 0.3f;
  TriangleMesh mesh;
  for (const float y : {-2.0f, 2.0f})
    mesh.P.insert(mesh.P.end(), {{-2, y, 0}, {0, y, 0}, {kBevel, y, -kBevel}, {kBevel, y, -2}});
  for (const uint32_t i : {0u, 1u, 2u})
    mesh.indices.insert(mesh.indices.end(), {{i, i + 1, i + 5}, {i, i + 5, i + 4}});
  Scene scene;
  scene.shapes.push_back(test::mesh_shape(std::move(mesh)));
  const accel::EdgeIndex edges = edges_of(scene);
  for (const float from_edge : {0.01f, 0.1f, 0.2f}) {
    const double share = surface_share(edges, at({-from_edge, 0, 0}), {}, kRadius);
    const auto ending_at = [](float distance) {
      return 1 - mass_behind_edge({}, double(distance / kRadius), -2 / kRadius, 2 / kRadius);
    };
    EXPECT_GE(share, ending_at(from_edge) - 1e-4) << from_edge;  // rounding of the strip's height
    EXPECT_LE(share, ending_at(from_edge + kBevel) + 1e-4) << from_edge;
  }
}

// The border of a strip is cut into 1,000 pieces, which become one edge. Where they do not, the disc meets
// too many edges, and those within a part of it decide. A disc of 0.2 at the border meets 400 of them, one of
// half the radius 200, one of a quarter 100; at a distance of 0.06, half the radius meets 160.
TEST(SurfaceShare, ManyEdgesCountNearThePoint) {
  constexpr uint32_t kPieces = 1000;
  TriangleMesh mesh;
  for (uint32_t i = 0; i <= kPieces; ++i)
    for (const float y : {0.0f, 1.0f}) mesh.P.push_back({float(i) / kPieces, y, 0});
  for (uint32_t a = 0; a < 2 * kPieces; a += 2)
    mesh.indices.insert(mesh.indices.end(), {{a, a + 2, a + 3}, {a, a + 3, a + 1}});
  Scene scene;
  scene.shapes.push_back(test::mesh_shape(std::move(mesh)));
  const accel::EdgeIndex whole = edges_of(scene), pieces(find_boundary_edges(scene.shapes));
  const auto expect_share = [](const accel::EdgeIndex& edges, float y, double d) {
    EXPECT_NEAR(surface_share(edges, at({0.5f, y, 0}), {}, 0.2f), 1 - mass_behind_edge({}, d, -9, 9), 1e-4)
        << edges.size() << " edges, at " << y;
  };
  for (const float y : {0.0f, 0.02f, 0.06f}) expect_share(whole, y, double(y) / 0.2);
  expect_share(pieces, 0, 0);
  expect_share(pieces, 0.02f, 0.4);
  expect_share(pieces, 0.06f, 0.6);
}

TEST(SurfaceShare, ScalesByPowersOfTwo) {
  for (const int exponent : {-20, -1, 20}) {
    const float s = std::ldexp(1.0f, exponent);
    Scene scene, scaled;
    scene.shapes = {test::parallelogram({0.3f, 0, 0}, {1, 0.2f, 0.1f}, {0, 1, 0.4f})};
    scaled.shapes = {test::parallelogram({s * 0.3f, 0, 0}, {s, s * 0.2f, s * 0.1f}, {0, s, s * 0.4f})};
    const Normal3 n = glm::normalize(glm::cross(Vector3(1, 0.2f, 0.1f), Vector3(0, 1, 0.4f)));
    const accel::EdgeIndex a = edges_of(scene), b = edges_of(scaled);
    for (const float t : {0.01f, 0.1f, 0.3f}) {
      const Point3 p = Point3(0.3f, 0, 0) + t * Vector3(1, 0.2f, 0.1f) + 0.2f * Vector3(0, 1, 0.4f);
      for (const KernelSpec& kernel : kernels())
        EXPECT_EQ(surface_share(a, at(p, n), kernel, 0.25f),
                  surface_share(b, at(s * p, n), kernel, s * 0.25f));
    }
  }
}

// A unit square under even light of 1 W/m^2. With the correction every point of it shows 1/pi; without it the
// border would show one half of that and the corner one quarter. The number of photons in reach is binomial.
// The tolerance is four standard errors, for kernels whose K^2 integrates to at most 3/2 of the constant
// one's, and the rounding of packed fluxes.
TEST(CorrectedEstimate, IsEvenUpToTheBorder) {
  constexpr int kPhotons = 200000;
  PhotonMaker make(77);
  std::vector<Photon> photons;
  for (int i = 0; i < kPhotons; ++i)
    photons.push_back({{make.uniform(), make.uniform(), 0}, {0, 0, 1}, Rgb(1.0f / kPhotons), {0, 0, 1}, 0});
  const PhotonMap map = PhotonMap::build(make_buffer(photons, 0x1p-17f));
  Scene scene;
  scene.shapes = {test::parallelogram({0, 0, 0}, {1, 0, 0}, {0, 1, 0})};
  const accel::EdgeIndex edges = edges_of(scene);
  const struct {
    Point3 p;
    double share;
  } cases[] = {{{0.5f, 0.5f, 0}, 1},
               {{0.5f, 0, 0}, 0.5},
               {{1, 0.3f, 0}, 0.5},
               {{0x1p-12f, 0x1p-11f, 0}, 0.25},
               {{1 - 0x1p-12f, 0x1p-12f, 0}, 0.25}};
  const Vector3 viewer = glm::normalize(Vector3(0.3f, -0.2f, 0.8f));
  for (const KernelSpec& kernel : kernels())
    for (const uint32_t nearest : {0u, 2000u})
      for (const auto& [p, share] : cases) {
        EstimateSettings settings{0.1f, kernel, nearest, false, 64};
        const auto irradiance = [&] {
          GatherCounters counters;
          return double(estimate_radiance(map, at(p), viewer, Lambertian{Rgb(1)}, settings, counters).x) *
                 double(kPi);
        };
        const double in_reach = nearest ? nearest : kPhotons * double(kPi) * 0.01 * share;
        const double error = 4 * std::sqrt(1.5 / in_reach) + test::kPackedFluxError;
        EXPECT_NEAR(irradiance(), share, share * error) << p.x << ' ' << p.y;
        settings.edges = &edges;
        EXPECT_NEAR(irradiance(), 1, error) << p.x << ' ' << p.y;
        settings.leaf = true;
        EXPECT_LE(irradiance(), share * (1 + error));  // uncorrected: a cell never adds photons
      }
}

}  // namespace
}  // namespace kaustik::photon
