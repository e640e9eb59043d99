// Tests, by exact counters, that only what the scene and the estimators require is traced and stored.

#include <gtest/gtest.h>

#include "tests/render/support/image_statistics.h"

namespace kaustik::render {
namespace {

using namespace test;
using photon::PhotonKind;

RenderStatistics statistics_of(const Scene& scene, RenderSettings settings) {
  settings.spp = 2;
  settings.photons = 5000;
  return render_with_threads(scene, settings).statistics;
}

uint64_t stored(const RenderStatistics& s, PhotonKind kind) {
  return s.photons.stored[size_t(kind)];
}

// The box without glass and mirror.
Scene diffuse_room() {
  Scene scene = cornell(16);
  scene.shapes.erase(scene.shapes.begin() + 6, scene.shapes.begin() + 8);
  finalize_scene(scene);
  return scene;
}

const Method kMethods[] = {Method::kRaytrace, Method::kMc, Method::kHybrid, Method::kPhoton, Method::kAuto};

TEST(Needs, NoCausticRaysWithoutSpecularSurfaces) {
  for (const Method method : kMethods) {
    RenderSettings settings;
    settings.method = method;
    const RenderStatistics s = statistics_of(diffuse_room(), settings);
    EXPECT_EQ(stored(s, PhotonKind::kCaustic), 0u) << name_of(method);
    EXPECT_EQ(s.rays.specular, 0u) << name_of(method);
    EXPECT_EQ(s.caustic_radius, 0) << name_of(method);
  }
  // Caustic photons are requested, but a photon ends at its first, diffuse, surface: there is one ray for
  // each photon and no more.
  RenderSettings settings;
  settings.method = Method::kRaytrace;
  settings.caustics = CausticEstimator::kPhotons;
  const RenderStatistics s = statistics_of(diffuse_room(), settings);
  EXPECT_EQ(s.photons.rays, s.photons.emitted);
  EXPECT_EQ(stored(s, PhotonKind::kCaustic), 0u);
}

TEST(Needs, ShadowPhotonsOnlyForEstimatorsThatUseThem) {
  for (const Method method : kMethods) {
    RenderSettings settings;
    settings.method = method;
    const RenderStatistics s = statistics_of(cornell_with_table(16), settings);
    const bool reads = method == Method::kHybrid;
    EXPECT_EQ(stored(s, PhotonKind::kShadow) > 0, reads) << name_of(method);
    EXPECT_EQ(s.photons.shadow_rays > 0, reads) << name_of(method);
  }
}

TEST(Needs, IndirectOffTracesNoBounce) {
  for (const Method method : kMethods) {
    RenderSettings settings;
    settings.method = method;
    settings.indirect = IndirectEstimator::kOff;
    // Caustic paths bounce, too.
    if (method == Method::kMc) settings.caustics = CausticEstimator::kOff;
    if (method == Method::kAuto) settings.caustics = CausticEstimator::kPhotons;
    const RenderStatistics s = statistics_of(cornell(16), settings);
    EXPECT_EQ(s.rays.bounce, 0u) << name_of(method);
    EXPECT_EQ(stored(s, PhotonKind::kIndirect), 0u) << name_of(method);
  }
  // Photons do not bounce either: in a diffuse room each has one ray.
  RenderSettings settings;
  settings.method = Method::kPhoton;
  settings.indirect = IndirectEstimator::kOff;
  const RenderStatistics s = statistics_of(diffuse_room(), settings);
  EXPECT_EQ(s.photons.rays, s.photons.emitted);
  EXPECT_EQ(stored(s, PhotonKind::kDirect), s.photons.emitted);
}

TEST(Needs, NoPhotonsWithoutAnEstimatorThatUsesThem) {
  for (const Method method : {Method::kRaytrace, Method::kMc}) {
    RenderSettings settings;
    settings.method = method;
    const RenderStatistics s = statistics_of(cornell(16), settings);
    EXPECT_EQ(s.photons.emitted, 0u);
    EXPECT_EQ(s.photons.rays, 0u);
    EXPECT_EQ(s.photon_bytes, 0u);
    EXPECT_EQ(s.gather_queries, 0u);
  }
}

TEST(Needs, NotesNameWhatIsLeftOut) {
  for (const Method method : {Method::kMc, Method::kHybrid, Method::kAuto}) {
    RenderSettings settings;
    settings.method = method;
    const EstimatorPlan plan = make_plan(settings, diffuse_room().needs);
    int savings = 0;
    for (const std::string& note : plan.notes) savings += note.find("; saves ") != std::string::npos;
    EXPECT_GE(savings, 2) << name_of(method);
  }
}

}  // namespace
}  // namespace kaustik::render
