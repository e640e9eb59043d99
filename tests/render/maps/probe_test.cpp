// What the live page says of an estimate is what the estimate has read.

#include "render/maps/probe.h"

#include <gtest/gtest.h>

#include "render/camera/shading_point.h"
#include "render/maps/pass_photons.h"
#include "render/plan/pass_share.h"
#include "tests/render/support/test_scenes.h"

namespace kaustik::render {
namespace {

class ProbeTest : public ::testing::Test {
 protected:
  // The maps of a Cornell box with glass, a mirror and a table.
  void shoot(RenderSettings settings) {
    settings_ = std::move(settings);
    plan_ = make_plan(settings_, scene_.needs);
    RenderStatistics statistics;
    ASSERT_TRUE(photons_.make(input(), pass_share(0, 1, settings_.photons, 1), {}, &statistics));
  }
  RenderInput input() const { return {scene_, bvh_, settings_, plan_}; }
  Probe probe(int x, int y) const { return probe_pixel(input(), photons_.maps(), x, y); }

  Scene scene_ = test::cornell_with_table(64);
  accel::Bvh bvh_{scene_, 2};
  RenderSettings settings_;
  EstimatorPlan plan_;
  PassPhotons photons_;
};

RenderSettings settings_of(Method method, DirectEstimator direct) {
  RenderSettings settings;
  settings.method = method;
  settings.direct = direct;
  settings.photons = 100'000;
  return settings;
}

// In the middle of a diffuse wall: Lr = rho / pi times the sum of flux K(d), Jensen 2001, equation 7.6.
TEST_F(ProbeTest, PhotonsAndWeightsGiveTheRadiance) {
  shoot(settings_of(Method::kPhoton, DirectEstimator::kPhotons));
  const Probe found = probe(32, 24);  // the back wall
  ASSERT_TRUE(found.point);
  EXPECT_GT(found.distance, 0);
  bool any = false;
  for (const ProbedMap& map : found.maps) {
    Rgb sum(0);
    for (const ProbedPhoton& p : map.photons) {
      EXPECT_LE(p.distance, map.radius);
      EXPECT_NEAR(p.distance, glm::distance(p.photon.p, found.point->p), 1e-5 * map.radius + 1e-6);
      sum += p.weight * p.photon.flux;
    }
    const ShadingPoint x(scene_, *found.point,
                         glm::normalize(scene_.camera.generate_ray({32.5f, 24.5f}).o - found.point->p));
    const Rgb wanted = albedo(*x.bsdf) * kInvPi * sum;
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(map.radiance[c], wanted[c], 1e-4f * max_component(wanted));
    any |= map.photons.size() > 20;
  }
  EXPECT_TRUE(any) << "no map has photons there";
  EXPECT_FALSE(found.cell) << "there are no shadow photons in this plan";
}

TEST_F(ProbeTest, TellsTheLecturesTest) {
  shoot(settings_of(Method::kHybrid, DirectEstimator::kLecture));
  int trusted = 0, refused = 0;
  for (int y = 2; y < 64; y += 6)
    for (int x = 2; x < 64; x += 6) {
      const Probe found = probe(x, y);
      if (!found.point || !found.cell) continue;
      const ProbedCell& cell = *found.cell;
      const Point3 p = found.point->p;
      for (int axis = 0; axis < 3; ++axis) {
        EXPECT_LE(cell.bounds.min[axis], p[axis] + 1e-4f);
        EXPECT_GE(cell.bounds.max[axis], p[axis] - 1e-4f);
      }
      const bool uses_photons = cell.answer.use_photons();
      EXPECT_TRUE(!uses_photons || cell.shadow == 0) << "a cell with shadow photons is not trusted";
      EXPECT_EQ(cell.shadow > 0, cell.answer.outcome == photon::LectureOutcome::kShadow)
          << "the cell that is shown is the one that the reason is about";
      EXPECT_EQ(cell.direct <= settings_.min_photons && cell.shadow == 0,
                cell.answer.outcome == photon::LectureOutcome::kFew);
      (uses_photons ? trusted : refused) += 1;
    }
  EXPECT_GT(trusted, 0);
  EXPECT_GT(refused, 0);
}

const ProbedMap* find(const Probe& probe, photon::PhotonKind kind) {
  for (const ProbedMap& map : probe.maps)
    if (map.kind == kind) return &map;
  return nullptr;
}

TEST_F(ProbeTest, SaysWhatThePictureMakesOfAnEstimate) {
  using photon::PhotonKind;
  shoot(settings_of(Method::kHybrid, DirectEstimator::kLecture));
  for (int x = 2; x < 64; x += 6) {
    const Probe found = probe(x, 50);
    if (!found.cell) continue;
    EXPECT_EQ(find(found, PhotonKind::kDirect)->use == ProbeUse::kAdded, found.cell->answer.use_photons());
    EXPECT_EQ(find(found, PhotonKind::kShadow)->use, ProbeUse::kTested);
  }
  shoot(settings_of(Method::kPhoton, DirectEstimator::kSigned));
  const Probe subtracted = probe(32, 24);
  EXPECT_EQ(find(subtracted, PhotonKind::kShadow)->use, ProbeUse::kSubtracted);
  EXPECT_EQ(find(subtracted, PhotonKind::kIndirect)->use, ProbeUse::kAdded);
  EXPECT_FALSE(find(subtracted, PhotonKind::kDirect)) << "`signed` does not gather them";
}

TEST_F(ProbeTest, FollowsMirrorsAndGlass) {
  shoot(settings_of(Method::kAuto, DirectEstimator::kShadowRays));
  int followed = 0;
  for (int y = 0; y < 64; y += 4)
    for (int x = 0; x < 64; x += 4) {
      const Probe found = probe(x, y);
      followed += found.specular > 0 && found.point;
    }
  EXPECT_GT(followed, 5);
}

}  // namespace
}  // namespace kaustik::render
