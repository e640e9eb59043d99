// Tests the choice of points on rays through media.

#include "render/estimators/beam_sampler.h"

#include <gtest/gtest.h>

#include "tests/render/support/test_scenes.h"
#include "tests/support/random.h"
#include "tests/support/statistics.h"

namespace kaustik::render {
namespace {

using namespace test;

// A scene with some lights in fog.
Scene fog_with(std::vector<Light> lights) {
  Scene scene;
  add_shape(scene, horizontal({0, -3, 0}, 9, 9, true, add_material(scene, Lambertian{Rgb(0.5f)})));
  scene.lights = std::move(lights);
  fill(scene, Rgb(0.05f, 0.1f, 0), Rgb(0.1f, 0.2f, 0.3f));
  return scene;
}

SpotLight spot(const Point3& p, const Vector3& axis, float degrees) {
  const float cosine = std::cos(degrees * kPi / 180);
  SpotLight light;
  light.position = p;
  light.frame = Frame::from_z(glm::normalize(axis));
  light.I = Rgb(3);
  light.cos_falloff_start = light.cos_total_width = cosine;
  return light;
}

// Samples of the parts of the ray estimate the integral of sigma_s T over each, since whatever is chosen is
// divided by its density.
void expect_integrals(const Scene& scene, const Ray& ray, float distance) {
  const Medium& medium = scene.media[scene.camera_medium];
  const BeamSampler points(scene, medium, ray, distance, Rgb(1));
  constexpr int kParts = 5;
  const float least = 0.5f, ends[kParts] = {least, 1, 2, 4, 16};
  constexpr int kSamples = 100'000;
  Random random(1);
  std::vector<std::vector<double>> found(kParts);
  for (int i = 0; i < kSamples; ++i) {
    const BeamSampler::Sample s = points.sample(random.uniform_2d());
    ASSERT_GE(s.t, 0);
    ASSERT_LE(s.t, distance);
    for (int part = 0; part < kParts; ++part) {
      const bool in_part = s.t < ends[part] && (part == 0 || s.t >= ends[part - 1]);
      found[size_t(part)].push_back(in_part ? double(s.weight.y) : 0);
    }
  }
  const double sigma_s = double(medium.sigma_s.y), sigma_t = double(medium.sigma_t().y);
  for (int part = 0; part < kParts; ++part) {
    const double begin = part == 0 ? 0 : double(ends[part - 1]);
    const double end = std::min(double(ends[part]), double(distance));
    const double expected =
        begin < end ? sigma_s / sigma_t * (std::exp(-sigma_t * begin) - std::exp(-sigma_t * end)) : 0;
    const Estimate mean = estimate_of(found[size_t(part)]);
    EXPECT_NEAR(mean.mean, expected, 5 * mean.standard_error + 1e-6) << part;
    EXPECT_LE(mean.standard_error, 0.02 * expected) << part;
  }
}

TEST(BeamSampler, SamplesIntegrateWhatIsScattered) {
  const Ray ray{{0, 0, 0}, {0, 0, 1}};
  const std::vector<std::vector<Light>> cases = {
      {},
      {PointLight{{0.5f, 0, 1.5f}, Rgb(1)}},
      {spot({0, 1, 2}, {0, -1, 0}, 20)},         // across the ray
      {spot({0, 0.5f, -1}, {0, 0, 1}, 30)},      // from behind, along it
      {spot({0, 0.5f, 3}, {0, -0.2f, -1}, 40)},  // towards its start
      {spot({0, 1, 2}, {0, 1, 0}, 20)},          // turned away
      {spot({0, 1, 2}, {0, -1, 0}, 20), spot({1, 0, 3}, {-1, 0, 0}, 10), PointLight{{2, 0, 1}, Rgb(1)}}};
  for (const auto& lights : cases)
    for (const float distance : {3.0f, kInfinity}) {
      SCOPED_TRACE(std::to_string(lights.size()) + " lights, " + std::to_string(distance));
      expect_integrals(fog_with(lights), ray, distance);
    }
}

// Half of the samples are for lights, and all of these lie where the cone crosses the ray: at t = 2, one
// metre below the light, within tan(20 degrees) of that. Of the others, few do.
TEST(BeamSampler, SamplesOfSpotLightsLieInTheirCones) {
  const Scene scene = fog_with({spot({0, 1, 2}, {0, -1, 0}, 20)});
  const Ray ray{{0, 0, 0}, {0, 0, 1}};
  const BeamSampler points(scene, scene.media[scene.camera_medium], ray, 100, Rgb(1));
  const float reach = std::tan(20 * kPi / 180);
  Random random(1);
  constexpr int kSamples = 10'000;
  int lit = 0, for_light = 0;
  for (int i = 0; i < kSamples; ++i) {
    const Point2 u = random.uniform_2d();
    const bool in_cone = std::abs(points.sample(u).t - 2) <= reach * (1 + 1e-5f);
    lit += in_cone;
    for_light += u.x < 0.5f;
    EXPECT_TRUE(in_cone || u.x >= 0.5f) << points.sample(u).t;
  }
  EXPECT_LT(lit, for_light + kSamples / 5);
}

}  // namespace
}  // namespace kaustik::render
