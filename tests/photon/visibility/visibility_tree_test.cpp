// Tests the visibility that photons predict, and how often the predictions are wrong.

#include "photon/visibility/visibility_tree.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <random>

#include "photon/visibility/visibility_shoot.h"
#include "tests/photon/support/photon_sets.h"
#include "tests/photon/support/trace_scenes.h"

namespace kaustik::photon {
namespace {

constexpr Normal3 kUp(0, 0, 1);

MortonCube unit_cube() {
  return MortonCube::around({Point3(0), Point3(1)});
}

// Observations spread evenly over the unit square of the floor; seen(p) says whether the photon at p saw the
// light.
template <class Seen>
std::vector<uint64_t> floor_observations(const MortonCube& cube, int count, Seen&& seen, uint32_t light = 0) {
  PhotonMaker make(5);
  std::vector<uint64_t> observations;
  for (int i = 0; i < count; ++i) {
    const Point3 p(make.uniform(), make.uniform(), 0);
    observations.push_back(VisibilityTree::observation(cube, light, p, kUp, seen(p)));
  }
  return observations;
}

bool in_disc(const Point3& p) {
  return std::hypot(p.x - 0.4f, p.y - 0.55f) < 0.2f;
}

TEST(ProbabilityExponent, FourTimesTheObservationsHalveTheProbability) {
  EXPECT_EQ(probability_exponent(0), 0);
  uint64_t least = kObservationsOfFirstStep;
  for (int k = 1; k <= kMostExponent; ++k, least *= 4) {
    EXPECT_EQ(probability_exponent(least - 3), k - 1);
    EXPECT_EQ(probability_exponent(least - 2), k);
  }
  EXPECT_EQ(probability_exponent(uint64_t{1} << 40), kMostExponent);
}

TEST(VisibilityTree, PredictsNothingWithoutObservations) {
  EXPECT_EQ(VisibilityTree().predict(0, Point3(0.5f), kUp).p, 1);
  const VisibilityTree tree(unit_cube(), floor_observations(unit_cube(), 10000, in_disc, 3));
  EXPECT_LT(tree.predict(3, {0.1f, 0.1f, 0}, kUp).p, 1);
  EXPECT_EQ(tree.predict(2, {0.1f, 0.1f, 0}, kUp).p, 1);     // another light
  EXPECT_EQ(tree.predict(3, {0.1f, 0.1f, 0}, -kUp).p, 1);    // the underside
  EXPECT_EQ(tree.predict(3, {0.1f, 0.1f, 0.9f}, kUp).p, 1);  // another place
  EXPECT_EQ(tree.predict(VisibilityTree::kMostLights, {0.1f, 0.1f, 0}, kUp).p, 1);
}

// A cell of which a share a is hidden has only observations of "seen" with probability (1 - a)^n, and is then
// wrong in a share a of its points: a (1 - a)^n <= 1/(e n) for every a. The share of points with p = 2^-k
// whose prediction is wrong is therefore at most 1/(e n) on average, n >= 16 4^(k-1) - 2; the same bound
// holds for "hidden". Twice that leaves room for the scatter of results that few cells decide.
TEST(VisibilityTree, PredictionsAreSeldomWrong) {
  const MortonCube cube = unit_cube();
  for (const int count : {3000, 30000, 300000}) {
    const VisibilityTree tree(cube, floor_observations(cube, count, in_disc));
    PhotonMaker make(6);
    std::array<int, kMostExponent + 1> predicted{}, wrong{};
    constexpr int kPoints = 200000;
    for (int i = 0; i < kPoints; ++i) {
      const Point3 p(make.uniform(), make.uniform(), 0);
      const VisibilityPrediction prediction = tree.predict(0, p, kUp);
      const size_t k = static_cast<size_t>(-std::ilogb(prediction.p));
      ++predicted[k];
      if (k > 0) wrong[k] += (prediction.v != 0) != in_disc(p);
    }
    for (int k = 1; k <= kMostExponent; ++k) {
      const double least = double(kObservationsOfFirstStep) * std::pow(4, k - 1) - 2;
      EXPECT_LE(wrong[size_t(k)], 2 * predicted[size_t(k)] / (M_E * least) + 3)
          << count << " observations, k " << k;
    }
    // The edge is 1.26 long. Of cells of width w it meets about 4/pi 1.26 / w, an area of 1.6 w. Cells are
    // divided down to 32 observations, so w is between sqrt(32 / count) and four times that. Cells beside
    // them have a sixteenth of the observations of a cell that was divided, sometimes too few.
    EXPECT_LT(predicted[0], kPoints * std::min(1.0, 3 * 1.6 * 4 * std::sqrt(32.0 / count))) << count;
  }
}

TEST(VisibilityTree, DoesNotDependOnTheOrderOfObservations) {
  const MortonCube cube = unit_cube();
  std::vector<uint64_t> observations = floor_observations(cube, 20000, in_disc);
  const VisibilityTree one(cube, observations);
  std::shuffle(observations.begin(), observations.end(), std::mt19937(3));
  const VisibilityTree other(cube, observations);
  PhotonMaker make(7);
  for (int i = 0; i < 10000; ++i) {
    const Point3 p(make.uniform(), make.uniform(), 0);
    ASSERT_EQ(one.predict(0, p, kUp).v, other.predict(0, p, kUp).v);
    ASSERT_EQ(one.predict(0, p, kUp).p, other.predict(0, p, kUp).p);
  }
}

// All observations are at one point, so the cell cannot be divided any further.
TEST(VisibilityTree, ContradictingObservationsAtOnePointPredictNothing) {
  const MortonCube cube = unit_cube();
  std::vector<uint64_t> observations;
  for (int i = 0; i < 1000; ++i)
    observations.push_back(VisibilityTree::observation(cube, 0, Point3(0.3f), kUp, i % 2 == 0));
  EXPECT_EQ(VisibilityTree(cube, observations).predict(0, Point3(0.3f), kUp).p, 1);
}

// In this room the glass sphere, the mirror sphere and the tilted parallelogram all hide the light.
VisibilityTree room_tree(const Scene& scene, int threads) {
  const tbb::global_control allow(tbb::global_control::max_allowed_parallelism, size_t(threads));
  return predict_visibility(scene, accel::Bvh(scene, threads), {.seed = 1, .photons = 100000});
}

TEST(PredictVisibility, GlassAndMirrorsHideLights) {
  const Scene scene = test::full_room();
  const VisibilityTree tree = room_tree(scene, 2);
  const Normal3 up(0, 1, 0);
  for (const Point3 p : {Point3(-0.65f, -1, 0.15f), Point3(0.9f, -1, -0.5f)}) {  // under the spheres
    const VisibilityPrediction prediction = tree.predict(0, p, up);
    EXPECT_EQ(prediction.v, 0) << p.x;
    EXPECT_LT(prediction.p, 1) << p.x;
  }
  const VisibilityPrediction lit = tree.predict(0, {-0.5f, -1, 0.8f}, up);
  EXPECT_EQ(lit.v, 1);
  EXPECT_LT(lit.p, 1);
}

TEST(PredictVisibility, DoesNotDependOnThreadsOrScale) {
  const VisibilityTree one = room_tree(test::full_room(), 1), many = room_tree(test::full_room(), 3),
                       large = room_tree(test::full_room(1024), 2);
  PhotonMaker make(8);
  const Normal3 up(0, 1, 0);
  for (int i = 0; i < 20000; ++i) {
    const Point3 p(2 * make.uniform() - 1, -1, 2 * make.uniform() - 1);
    const VisibilityPrediction prediction = one.predict(0, p, up);
    for (const VisibilityPrediction& same : {many.predict(0, p, up), large.predict(0, 1024.0f * p, up)}) {
      ASSERT_EQ(prediction.v, same.v);
      ASSERT_EQ(prediction.p, same.p);
    }
  }
}

TEST(PredictVisibility, PredictsNothingWithoutLights) {
  Scene dark = test::full_room();
  dark.lights.clear();
  for (Shape& shape : dark.shapes) shape.light = kNoIndex;
  finalize_scene(dark);
  EXPECT_EQ(room_tree(dark, 1).predict(0, {0, -1, 0}, {0, 1, 0}).p, 1);
}

}  // namespace
}  // namespace kaustik::photon
