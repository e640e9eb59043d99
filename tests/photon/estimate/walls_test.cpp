// Discs that walls cut: shares against sums over grids, and estimates on both sides of a wall.

#include "photon/estimate/walls.h"

#include <gtest/gtest.h>

#include <functional>

#include "photon/estimate/boundary_correction.h"
#include "photon/estimate/estimate_batch.h"
#include "photon/estimate/radiance_estimate.h"
#include "tests/photon/support/photon_sets.h"

namespace kaustik::photon {
namespace {

constexpr float kRadius = 0.2f;
const Bounds3 kBounds{{0, 0, 0}, {1, 1, 1}};
const Vector3 kUp(0, 0, 1);

// A foot on the floor z = 0.
BoundaryEdge foot(const Point2& a, const Point2& b, const Normal3& n = {0, 0, 1}, bool both_sides = false) {
  BoundaryEdge edge;
  edge.a = {a.x, a.y, 0};
  edge.b = {b.x, b.y, 0};
  edge.n = n;
  edge.both_sides = both_sides;
  return edge;
}

// A border of the floor at which it ends; it lies on the left of the direction from a to b.
BoundaryEdge end(const Point2& a, const Point2& b) {
  BoundaryEdge edge = foot(a, b);
  edge.outward = glm::normalize(Vector3(b.y - a.y, a.x - b.x, 0));
  return edge;
}

SurfaceInteraction at(float x, float y, const Normal3& n = {0, 0, 1}) {
  SurfaceInteraction si;
  si.p = {x, y, 0};
  si.n = si.ns = n;
  return si;
}

// The kernel's mass over the points of a grid that the walls do not hide. A border of the visible part that
// crosses the disc is off by half a cell at most; up to six of length 2 r are there, and the density is below
// two over the disc's area.
constexpr int kCells = 500;
constexpr double kGridError = 6 * 2.0 * (1.0 / kCells) * 2 / 3.14;

double grid_share(const WallCut& cut, const KernelSpec& kernel, const SurfaceInteraction& si,
                  const std::function<bool(double, double)>& on_surface) {
  const KernelTerms terms = kernel_terms(kernel, kRadius);
  const double cell = 2 * double(kRadius) / kCells;
  double sum = 0;
  for (int i = 0; i < kCells; ++i)
    for (int j = 0; j < kCells; ++j) {
      const double x = (i + 0.5) * cell - double(kRadius), y = (j + 0.5) * cell - double(kRadius);
      const float d2 = float(x * x + y * y);
      const Point3 p(double(si.p.x) + x, double(si.p.y) + y, 0);
      if (d2 > kRadius * kRadius || !on_surface(double(p.x), double(p.y)) || cut.hides(p, kUp)) continue;
      sum += double(kernel_value(kernel.type, terms, d2)) * cell * cell;
    }
  return sum;
}

// A wall across the disc, one that ends in it, a corner of two, a box, and a wall near the floor's border.
TEST(WallCut, ShareIsTheMassThatIsNotHidden) {
  const std::vector<std::vector<BoundaryEdge>> cases = {
      {foot({0.5f, 0}, {0.5f, 1})},
      {foot({0.5f, 0.45f}, {0.5f, 1})},
      {foot({0.5f, 0.5f}, {0.5f, 1}), foot({0.5f, 0.5f}, {1, 0.5f})},
      {foot({0.5f, 0.45f}, {0.55f, 0.45f}), foot({0.55f, 0.45f}, {0.55f, 0.5f}),
       foot({0.55f, 0.5f}, {0.5f, 0.5f}), foot({0.5f, 0.5f}, {0.5f, 0.45f})}};
  const auto inside = [](double x, double y) { return x >= 0 && x <= 1 && y >= 0.35 && y <= 1; };
  const accel::EdgeIndex ends(
      {end({0, 0.35f}, {1, 0.35f}), end({1, 0.35f}, {1, 1}), end({1, 1}, {0, 1}), end({0, 1}, {0, 0.35f})});
  for (const auto& feet : cases) {
    const Walls walls(feet, kBounds, kRadius);
    for (const KernelType type : kKernelTypes)
      for (const SurfaceInteraction& si :
           {at(0.42f, 0.47f), at(0.495f, 0.52f), at(0.6f, 0.4f), at(0.45f, 0.36f)}) {
        const KernelSpec kernel{type};
        const WallCut cut(walls, si, kUp, si.n, kRadius);
        EXPECT_TRUE(cut.cuts());
        // A foot may end anywhere between two directions: up to eight ends of feet move by half a step.
        EXPECT_NEAR(cut.share(si, kernel, ends, kRadius), grid_share(cut, kernel, si, inside),
                    kGridError + 8 * 0.5 / WallCut::kDirections)
            << feet.size() << " at " << si.p.x << ' ' << si.p.y;
      }
  }
}

// A straight wall across the whole disc is an edge; the sum over directions has a kink where it leaves the
// disc.
TEST(WallCut, AStraightWallIsAnEdge) {
  const Walls walls({foot({0.5f, -9}, {0.5f, 9})}, kBounds, kRadius);
  for (const KernelType type : kKernelTypes)
    for (const float d : {0x1p-20f, 0.01f, 0.1f, 0.19f}) {
      const SurfaceInteraction si = at(0.5f - d, 0.5f);
      const WallCut cut(walls, si, kUp, si.n, kRadius);
      EXPECT_NEAR(cut.share(si, {type}, accel::EdgeIndex({}), kRadius),
                  1 - mass_behind_edge({type}, double(d / kRadius), -99, 99), 1.0 / WallCut::kDirections);
    }
}

TEST(WallCut, NothingPassesBetweenFeetThatMeet) {
  std::vector<BoundaryEdge> feet;
  test::Random random(5);
  Point2 from(0.5f, -0.1f);
  while (from.y < 1.1f) {
    const Point2 to(0.5f + 0.01f * random.uniform(), from.y + 0.05f * random.uniform());
    feet.push_back(foot(from, to));
    from = to;
  }
  const Walls walls(feet, kBounds, kRadius);
  for (int i = 0; i < 20000; ++i) {
    const SurfaceInteraction si = at(0.499f - 0.1f * random.uniform(), 0.3f + 0.4f * random.uniform());
    const WallCut cut(walls, si, kUp, si.n, kRadius);
    // Straight through the ends of two feet, too.
    const Point3 joint = feet[size_t(random.uniform() * float(feet.size()))].b;
    EXPECT_TRUE(cut.hides({0.512f, si.p.y + 0.1f * (random.uniform() - 0.5f), 0}, kUp));
    const Point3 beyond = si.p + 1.5f * (joint - si.p);
    if (!(beyond.x > 0.511f && glm::distance(beyond, si.p) < kRadius)) continue;
    EXPECT_TRUE(cut.hides(beyond, kUp));
  }
}

TEST(WallCut, HoldsOnTheSideOfTheWallOnly) {
  const Walls one({foot({0.5f, 0}, {0.5f, 1})}, kBounds, kRadius),
      both({foot({0.5f, 0}, {0.5f, 1}, kUp, true)}, kBounds, kRadius);
  const SurfaceInteraction si = at(0.45f, 0.5f);
  EXPECT_TRUE(WallCut(one, si, kUp, kUp, kRadius).cuts());
  EXPECT_FALSE(WallCut(one, si, -kUp, -kUp, kRadius).cuts());
  EXPECT_TRUE(WallCut(both, si, -kUp, -kUp, kRadius).cuts());
}

// Points on the wall's line are on the side from which they are seen.
TEST(WallCut, SightTellsTheSideOfPointsAtTheFoot) {
  const Walls walls({foot({0.5f, 0}, {0.5f, 1})}, kBounds, kRadius);
  SurfaceInteraction si = at(0.5f, 0.5f);
  si.p_error = 0x1p-22f;
  const Vector3 left = glm::normalize(Vector3(-1, 0, 1)), right = glm::normalize(Vector3(1, 0, 1));
  for (const float rounding : {-0x1p-24f, 0.0f, 0x1p-24f}) {
    si.p.x = 0.5f + rounding;
    EXPECT_FALSE(WallCut(walls, si, left, kUp, kRadius).hides({0.4f, 0.5f, 0}, left));
    EXPECT_TRUE(WallCut(walls, si, left, kUp, kRadius).hides({0.6f, 0.5f, 0}, right));
    EXPECT_FALSE(WallCut(walls, si, right, kUp, kRadius).hides({0.6f, 0.5f, 0}, right));
    EXPECT_TRUE(WallCut(walls, si, right, kUp, kRadius).hides({0.5f + rounding, 0.55f, 0}, left));
  }
}

TEST(Walls, NearFindsEveryFootInReach) {
  test::Random random(6);
  std::vector<BoundaryEdge> feet;
  for (int i = 0; i < 30; ++i) {
    BoundaryEdge edge;
    edge.a = Point3(random.uniform(), random.uniform(), random.uniform());
    edge.b = Point3(random.uniform(), random.uniform(), random.uniform());
    feet.push_back(edge);
  }
  constexpr float kSmall = 0.01f;
  const Walls walls(feet, kBounds, kSmall);
  int far = 0;
  for (int i = 0; i < 20000; ++i) {
    const Point3 p(random.uniform(), random.uniform(), random.uniform());
    uint32_t found[30];
    const bool in_reach = walls.feet().find(p, kSmall, 0, found) > 0;
    EXPECT_TRUE(walls.near(p) || !in_reach);
    far += !walls.near(p);
  }
  EXPECT_GT(far, 10000);
  EXPECT_FALSE(Walls({foot({0.5f, 0}, {0.5f, 1})}, kBounds, kSmall).near({0.6f, 0.5f, 0}));
}

// One half of a floor under even light of 1 W/m^2, behind a wall from the other. On the lit side every point
// shows 1 W/m^2 up to the wall, on the other none; by estimates one by one and in batches.
class LitHalf : public testing::Test {
 protected:
  static constexpr int kPhotons = 100000;

  LitHalf() : walls_({foot({0.5f, 0}, {0.5f, 1})}, kBounds, kRadius), edges_({}) {
    PhotonMaker make(9);
    std::vector<Photon> photons;
    for (int i = 0; i < kPhotons; ++i)
      photons.push_back({{0.5f * make.uniform(), make.uniform(), 0}, kUp, Rgb(0.5f / kPhotons), kUp, 0});
    map_ = PhotonMap::build(make_buffer(photons, 0x1p-17f));
    settings_.radius = kRadius;
    settings_.edges = &edges_;
    settings_.walls = &walls_;
  }

  Walls walls_;
  accel::EdgeIndex edges_;
  PhotonMap map_;
  EstimateSettings settings_;
};

TEST_F(LitHalf, IsEvenlyLitAndTheOtherDark) {
  for (const bool leaf : {false, true})
    for (const float d : {0x1p-20f, 0.01f, 0.1f, 0.19f}) {
      settings_.leaf = leaf;
      GatherCounters counters;
      const Bsdf white = Lambertian{Rgb(1)};
      EXPECT_EQ(estimate_radiance(map_, at(0.5f + d, 0.5f), kUp, white, settings_, counters), Rgb(0));
      EXPECT_EQ(counters.accepted, 0u);
      if (leaf) continue;
      const double E =
          double(kPi * estimate_radiance(map_, at(0.5f - d, 0.5f), kUp, white, settings_, counters).x);
      // At least half of the disc holds 12,600 photons: four standard errors are 3.6 %, of which fluxes
      // rounded to 1/511 and the sum over directions take little.
      EXPECT_NEAR(E, 1, 0.036 + 1 / 511.0 + 1.0 / WallCut::kDirections) << d;
    }
}

// Points of one pixel share a gather, but not across the wall.
TEST_F(LitHalf, BatchesDoNotReachThroughTheWall) {
  EstimateBatch batch;
  batch.begin_block();
  batch.begin_pixel(0);
  Rgb lit(0), dark(0), lit_again(0);
  float photons = 0;
  const Bsdf white = Lambertian{Rgb(1)};
  const SurfaceInteraction left = at(0.499f, 0.5f), right = at(0.501f, 0.5f), next = at(0.498f, 0.5f);
  batch.add(map_, left, kUp, white, settings_, Rgb(1), &lit, &photons);
  batch.add(map_, right, kUp, white, settings_, Rgb(1), &dark, &photons);
  batch.add(map_, next, kUp, white, settings_, Rgb(1), &lit_again, &photons);
  EXPECT_EQ(batch.gathers(), 2u);
  GatherCounters counters;
  batch.flush(counters);
  EXPECT_EQ(dark, Rgb(0));
  EXPECT_GT(lit.x, 0);
  EXPECT_EQ(lit_again, lit);
}

}  // namespace
}  // namespace kaustik::photon
