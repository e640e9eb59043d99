// Tests which estimators a render uses.

#include <gtest/gtest.h>

#include "render/plan/plan.h"
#include "tests/render/support/print_names.h"

namespace kaustik::render {
namespace {

using Direct = DirectEstimator;
using Caustic = CausticEstimator;
using Indirect = IndirectEstimator;

SceneNeeds needs_of(bool specular, bool delta_only = false) {
  SceneNeeds needs;
  needs.specular = needs.delta = specular;
  needs.diffuse = needs.any_light = true;
  needs.only_delta_lights = delta_only;
  return needs;
}

bool mentions(const EstimatorPlan& plan, const std::string& text) {
  for (const std::string& note : plan.notes)
    if (note.find(text) != std::string::npos) return true;
  return false;
}

struct Row {
  Method method;
  Direct direct;
  Caustic caustics;
  Indirect indirect;
};

TEST(Plan, PresetsForASceneThatNeedsEverything) {
  const Row table[] = {
      {Method::kRaytrace, Direct::kShadowRays, Caustic::kOff, Indirect::kOff},
      {Method::kMc, Direct::kShadowRays, Caustic::kPaths, Indirect::kPaths},
      {Method::kHybrid, Direct::kLecture, Caustic::kPhotons, Indirect::kPaths},
      {Method::kPhoton, Direct::kPhotons, Caustic::kPhotons, Indirect::kPhotons},
      {Method::kAuto, Direct::kPredicted, Caustic::kSplit, Indirect::kSplit},
  };
  for (const Row& row : table) {
    RenderSettings settings;
    settings.method = row.method;
    const EstimatorPlan plan = make_plan(settings, needs_of(true));
    EXPECT_EQ(plan.direct, row.direct) << name_of(row.method);
    EXPECT_EQ(plan.caustics, row.caustics) << name_of(row.method);
    EXPECT_EQ(plan.indirect, row.indirect) << name_of(row.method);
    EXPECT_FALSE(plan.notes.empty());
  }
}

TEST(Plan, AutoPredictsVisibilityUnlessTheSkyIsTheOnlyLight) {
  SceneNeeds needs = needs_of(true);
  needs.infinite_light = true;
  EXPECT_EQ(make_plan({}, needs).direct, Direct::kPredicted);
  needs.sky_alone = true;
  EXPECT_EQ(make_plan({}, needs).direct, Direct::kShadowRays);
  EXPECT_EQ(make_plan({}, SceneNeeds{}).direct, Direct::kShadowRays);
  EXPECT_EQ(make_plan({}, needs_of(true)).direct, Direct::kPredicted);
}

TEST(Plan, NoCausticPassWithoutSpecularSurfaces) {
  for (const Method method : {Method::kMc, Method::kHybrid, Method::kPhoton, Method::kAuto}) {
    RenderSettings settings;
    settings.method = method;
    const EstimatorPlan plan = make_plan(settings, needs_of(false));
    EXPECT_EQ(plan.caustics, Caustic::kOff) << name_of(method);
    EXPECT_TRUE(mentions(plan, "no specular surface: no caustic pass"));
  }
}

// Photons come from lights alone.
TEST(Plan, PathsFindWhatMediaEmit) {
  SceneNeeds needs = needs_of(true);
  needs.media = needs.emissive_media = true;
  EXPECT_EQ(make_plan({}, needs).indirect, Indirect::kSplit);
  EXPECT_TRUE(mentions(make_plan({}, needs), "media emit light: paths find it"));
  needs.any_light = false;
  for (const Method method : {Method::kMc, Method::kHybrid, Method::kPhoton, Method::kAuto}) {
    RenderSettings settings;
    settings.method = method;
    const EstimatorPlan plan = make_plan(settings, needs);
    EXPECT_EQ(plan.direct, Direct::kShadowRays) << name_of(method);
    EXPECT_EQ(plan.caustics, Caustic::kPaths) << name_of(method);
    EXPECT_EQ(plan.indirect, Indirect::kPaths) << name_of(method);
    EXPECT_FALSE(kinds_needed(plan).any()) << name_of(method);
    EXPECT_FALSE(mentions(plan, "black")) << name_of(method);
  }
  RenderSettings settings;
  settings.method = Method::kRaytrace;
  EXPECT_EQ(make_plan(settings, needs).indirect, Indirect::kOff);
}

// Paths have all light of fog, unless glass or mirrors make caustics there.
TEST(Plan, PathsBringTheLightOfMedia) {
  SceneNeeds needs = needs_of(false);
  needs.media = needs.scattering = true;
  EXPECT_EQ(make_plan({}, needs).indirect, Indirect::kPaths);
  EXPECT_FALSE(kinds_needed(make_plan({}, needs)).any());
  needs.specular = true;
  EXPECT_EQ(make_plan({}, needs).indirect, Indirect::kPhotons);
  EXPECT_TRUE(make_plan({}, needs).medium_caustics);
}

TEST(Plan, NoPhotonsWithoutDiffuseSurfaces) {
  SceneNeeds needs = needs_of(true);
  needs.diffuse = false;
  const EstimatorPlan plan = make_plan({}, needs);
  EXPECT_EQ(plan.direct, Direct::kShadowRays);
  EXPECT_EQ(plan.caustics, Caustic::kOff);
  EXPECT_EQ(plan.indirect, Indirect::kOff);
  EXPECT_TRUE(mentions(plan, "no diffuse surface: no indirect light"));
  EXPECT_TRUE(mentions(plan, "no photon pass"));
}

TEST(Plan, ExplicitChoicesOverrideThePreset) {
  RenderSettings settings;
  settings.method = Method::kPhoton;
  settings.direct = Direct::kShadowRays;
  settings.caustics = Caustic::kPaths;
  settings.indirect = Indirect::kOff;
  const EstimatorPlan plan = make_plan(settings, needs_of(false));
  EXPECT_EQ(plan.direct, Direct::kShadowRays);
  EXPECT_EQ(plan.caustics, Caustic::kPaths);
  EXPECT_EQ(plan.indirect, Indirect::kOff);
  EXPECT_TRUE(mentions(plan, "no photon pass"));
}

// Each direct estimator has exactly the photons stored that it uses.
TEST(Plan, StoresOnlyThePhotonsThatAreUsed) {
  struct Reads {
    Direct direct;
    bool direct_photons, shadow_photons;
  };
  for (const auto& [direct, direct_photons, shadow_photons] :
       {Reads{Direct::kShadowRays, false, false}, Reads{Direct::kPhotons, true, false},
        Reads{Direct::kLecture, true, true}, Reads{Direct::kPredicted, false, false},
        Reads{Direct::kSigned, false, true}}) {
    RenderSettings settings;
    settings.method = Method::kRaytrace;
    settings.direct = direct;
    const photon::KindMask kinds = kinds_needed(make_plan(settings, needs_of(true)));
    EXPECT_EQ(kinds.direct, direct_photons) << name_of(direct);
    EXPECT_EQ(kinds.shadow, shadow_photons) << name_of(direct);
    EXPECT_FALSE(kinds.caustic || kinds.indirect);
  }
}

TEST(Plan, NotesNameWhatTheImageLacks) {
  RenderSettings settings;
  settings.method = Method::kMc;
  EXPECT_TRUE(mentions(make_plan(settings, needs_of(true, true)), "their caustics are missing"));
  EXPECT_FALSE(mentions(make_plan(settings, needs_of(true, false)), "their caustics are missing"));
  settings.method = Method::kHybrid;
  EXPECT_FALSE(mentions(make_plan(settings, needs_of(true)), "shadow photons are not traced"));
  settings.method = Method::kPhoton;
  EXPECT_TRUE(mentions(make_plan(settings, needs_of(true)), "shadow photons are not traced"));
  settings.direct = Direct::kPredicted;
  EXPECT_FALSE(mentions(make_plan(settings, needs_of(true)), "shadow photons are not traced"));
  settings.direct.reset();
  EXPECT_TRUE(mentions(make_plan(settings, SceneNeeds{}), "no light: the image is black"));
}

}  // namespace
}  // namespace kaustik::render
