// Tests light samples against the closed form of polygons: many lights, of which few samples compete for one
// shadow ray, and points beside a light, where a BSDF sample takes its share.

#include <gtest/gtest.h>

#include "render/estimators/path_integrator.h"
#include "tests/render/support/closed_forms.h"
#include "tests/render/support/image_statistics.h"

namespace kaustik::render {
namespace {

using namespace test;

constexpr float kReflectance = 0.5f, kLight = 2;

// A floor under lights of different heights, which face down.
class LitFloor {
 public:
  // The i-th light is a square of this half side at the height, centred at (x, z).
  struct Square {
    float x, z, height, half;
  };

  explicit LitFloor(const std::vector<Square>& lights)
      : lights_(lights), scene_(make(lights)), bvh_(scene_) {}

  // Radiance that the floor reflects at the origin.
  double expected() const {
    double irradiance = 0;
    for (const Square& l : lights_) {
      const glm::dvec3 c(l.x, l.height, l.z);
      const double h = l.half;
      irradiance += lambert_polygon({c + glm::dvec3(-h, 0, -h), c + glm::dvec3(h, 0, -h),
                                     c + glm::dvec3(h, 0, h), c + glm::dvec3(-h, 0, h)},
                                    glm::dvec3(0), {0, 1, 0}, kLight);
    }
    return kReflectance * irradiance / double(kPi);
  }

  // Estimates of the same; shared: with BSDF samples.
  std::vector<double> estimates(bool shared, uint64_t count, TileCounters* counters) const {
    const PhotonMaps maps;
    RenderSettings settings;
    const EstimatorPlan plan;
    const RenderContext ctx{{scene_, bvh_, settings, plan}, maps};
    const ShadingPoint x = at_origin();
    std::vector<double> values;
    for (uint64_t i = 0; i < count; ++i) {
      Sampler sampler(11, i);
      const LightWeight weight = shared ? LightWeight::kMis : LightWeight::kAlone;
      Rgb sum = sample_direct(ctx, x, weight, sampler, *counters);
      if (shared) sum += trace_path(ctx, x, PathReach::kLights, sampler, *counters).direct;
      values.push_back(double(sum.x));
    }
    return values;
  }

  bool needs_bsdf_sample() const { return direct_needs_bsdf_sample(scene_, at_origin()); }

 private:
  static Scene make(const std::vector<Square>& lights) {
    Scene scene;
    const uint32_t white = add_material(scene, Lambertian{Rgb(kReflectance)});
    add_shape(scene, horizontal({0, 0, 0}, 4, 4, true, white));
    for (const Square& l : lights)
      make_light(scene, add_shape(scene, horizontal({l.x, l.height, l.z}, l.half, l.half, false, white)),
                 Rgb(kLight));
    look_at(scene, {-3, 0.02f, 0}, {0, 0, 0}, {0, 1, 0}, 1, 8, 8);
    finalize_scene(scene);
    return scene;
  }

  ShadingPoint at_origin() const {
    SurfaceInteraction si;
    EXPECT_TRUE(bvh_.intersect({{-3, 0.02f, 0}, {3, -0.02f, 0}}, &si));
    return {scene_, si, glm::normalize(Vector3(-3, 0.02f, 0))};
  }

  std::vector<Square> lights_;
  Scene scene_;
  accel::Bvh bvh_;
};

// 25 lights whose contributions at the origin differ by a factor of hundreds.
std::vector<LitFloor::Square> many_lights() {
  std::vector<LitFloor::Square> lights;
  for (int i = 0; i < 25; ++i)
    lights.push_back({float(i % 5) - 1.7f, float(i / 5) - 2.2f, 0.5f + 0.1f * float(i % 7), 0.05f});
  return lights;
}

constexpr uint64_t kCount = 1 << 16;

// Points of a low-discrepancy sequence scatter less than independent ones, so the standard errors are upper
// bounds.
TEST(ManyLightsByOneRay, AreUnbiasedByAnyWeight) {
  const LitFloor floor(many_lights());
  for (const bool shared : {false, true}) {
    TileCounters counters;
    const Estimate found = estimate_of(floor.estimates(shared, kCount, &counters));
    EXPECT_NEAR(found.mean, floor.expected(), 4 * found.standard_error);
    EXPECT_LT(found.standard_error, 0.01 * floor.expected());  // the test can fail
    EXPECT_EQ(counters.rays.shadow, shared ? 2 * kCount : kCount);
  }
}

// A light of side 1, 2 cm above the floor, whose nearest hundredth gives half of the light.
TEST(BesideALight, BsdfSamplesTakeTheNoiseOfLightSamples) {
  const LitFloor floor({{0.3f, 0.1f, 0.02f, 0.5f}});
  EXPECT_TRUE(floor.needs_bsdf_sample());
  TileCounters counters;
  const Estimate alone = estimate_of(floor.estimates(false, kCount, &counters));
  const Estimate shared = estimate_of(floor.estimates(true, kCount, &counters));
  EXPECT_NEAR(shared.mean, floor.expected(), 4 * shared.standard_error);
  EXPECT_NEAR(alone.mean, floor.expected(), 4 * alone.standard_error);
  EXPECT_LT(shared.standard_error, 0.1 * alone.standard_error);
}

TEST(BesideALight, OnlyLightsThatFillMuchOfTheViewAreNear) {
  EXPECT_FALSE(LitFloor({{0, 0, 1, 0.5f}}).needs_bsdf_sample());    // diagonal 1.41, at 1
  EXPECT_TRUE(LitFloor({{0, 0, 0.7f, 0.5f}}).needs_bsdf_sample());  // at 0.7
  EXPECT_FALSE(LitFloor(many_lights()).needs_bsdf_sample());
}

// A closed room [-2, 2] x [0, 1] x [-2, 2] under an even sky of radiance kLight, with a window of side 0.4 in
// its roof, centred above (0.5, 0).
Scene room_with_window() {
  Scene scene;
  const uint32_t white = add_material(scene, Lambertian{Rgb(kReflectance)});
  add_shape(scene, horizontal({0, 0, 0}, 2, 2, true, white));
  add_shape(scene, horizontal({-0.85f, 1, 0}, 1.15f, 2, false, white));
  add_shape(scene, horizontal({1.35f, 1, 0}, 0.65f, 2, false, white));
  add_shape(scene, horizontal({0.5f, 1, -1.1f}, 0.2f, 0.9f, false, white));
  add_shape(scene, horizontal({0.5f, 1, 1.1f}, 0.2f, 0.9f, false, white));
  for (const float side : {-2.0f, 2.0f}) {
    add_shape(scene, quad({side, 0, -2}, {side, 1, -2}, {side, 1, 2}, {side, 0, 2}, white));
    add_shape(scene, quad({-2, 0, side}, {-2, 1, side}, {2, 1, side}, {2, 0, side}, white));
  }
  scene.lights.push_back(InfiniteLight{Rgb(kLight), {0, 0, 0}, 4});
  look_at(scene, {-1.5f, 0.5f, 0}, {0, 0, 0}, {0, 1, 0}, 40, 128, 128);
  finalize_scene(scene);
  return scene;
}

// The guide finds the window, whose share of the hemisphere is a fortieth, and leaves the mean as it is.
TEST(SkyThroughAWindow, GuidedSamplesAreUnbiasedAndLessNoisy) {
  const Scene scene = room_with_window();
  const accel::Bvh bvh(scene);
  const RenderSettings settings;
  const EstimatorPlan plan;
  const RenderInput input{scene, bvh, settings, plan};
  const SkyGuide guide(input);
  ASSERT_TRUE(guide.useful());
  SurfaceInteraction si;
  ASSERT_TRUE(bvh.intersect({{-1.5f, 0.5f, 0}, {1.5f, -0.5f, 0}}, &si));
  const ShadingPoint x(scene, si, glm::normalize(Vector3(-1.5f, 0.5f, 0)));
  const double expected = kReflectance / double(kPi) *
                          lambert_polygon({{0.3, 1, -0.2}, {0.7, 1, -0.2}, {0.7, 1, 0.2}, {0.3, 1, 0.2}},
                                          glm::dvec3(0), {0, 1, 0}, kLight);
  const PhotonMaps maps;
  const auto estimate = [&](const SkyGuide* sky, bool shared) {
    const RenderContext ctx{input, maps, nullptr, sky};
    TileCounters counters;
    std::vector<double> values;
    for (uint64_t i = 0; i < kCount; ++i) {
      Sampler sampler(11, i);
      Rgb sum = sample_direct(ctx, x, shared ? LightWeight::kMis : LightWeight::kAlone, sampler, counters);
      if (shared) sum += trace_path(ctx, x, PathReach::kLights, sampler, counters).direct;
      values.push_back(double(sum.x));
    }
    return estimate_of(values);
  };
  const Estimate plain = estimate(nullptr, false), guided = estimate(&guide, false),
                 both = estimate(&guide, true);
  EXPECT_NEAR(plain.mean, expected, 4 * plain.standard_error);
  EXPECT_NEAR(guided.mean, expected, 4 * guided.standard_error);
  EXPECT_NEAR(both.mean, expected, 4 * both.standard_error);
  EXPECT_LT(guided.standard_error, plain.standard_error / 2);
}

TEST(SkyThroughAWindow, AnOpenSkyNeedsNoGuide) {
  Scene scene;
  add_shape(scene, horizontal({0, 0, 0}, 2, 2, true, add_material(scene, Lambertian{Rgb(kReflectance)})));
  scene.lights.push_back(InfiniteLight{Rgb(kLight), {0, 0, 0}, 4});
  look_at(scene, {-1.5f, 0.5f, 0}, {0, 0, 0}, {0, 1, 0}, 40, 32, 32);
  finalize_scene(scene);
  const accel::Bvh bvh(scene);
  const RenderSettings settings;
  const EstimatorPlan plan;
  EXPECT_FALSE(SkyGuide({scene, bvh, settings, plan}).useful());
}

}  // namespace
}  // namespace kaustik::render
