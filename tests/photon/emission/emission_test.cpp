#include "photon/emission/emission.h"

#include <gtest/gtest.h>

#include <memory>

#include "photon/emission/emission_lanes.h"
#include "tests/photon/support/trace_scenes.h"
#include "tests/support/shapes.h"
#include "tests/support/statistics.h"

namespace kaustik::photon {
namespace {

constexpr uint64_t kCount = 1 << 14;

struct Emitted {
  std::vector<EmissionSample> samples;
  glm::dvec3 sum{0};
  test::Mean flux[3];  // by channel; samples without a photon count as zero
};

Emitted emit_all(const Scene& scene, EmissionMode mode = EmissionMode::kCosine, uint64_t total = kCount) {
  Emitted e;
  for (uint64_t i = 0; i < kCount; ++i) {
    Sampler sampler(99, i);
    const auto sample = emit_photon(scene, emission_numbers(scene, sampler), total, mode);
    const Rgb flux = sample ? sample->flux : Rgb(0);
    for (int c = 0; c < 3; ++c) e.flux[c].add(double(flux[c]));
    if (!sample) continue;
    e.samples.push_back(*sample);
    e.sum += glm::dvec3(sample->flux);
  }
  return e;
}

Scene with_light(Light light) {
  Scene scene;
  scene.materials = {Lambertian{}};
  test::add_box(scene, 1);
  scene.lights = {std::move(light)};
  finalize_scene(scene);
  return scene;
}

// Standard error of the sum of independent draws; an upper bound here, since the points are stratified.
double standard_error(const Emitted& e, int channel) {
  return double(kCount) * e.flux[channel].standard_error();
}

void expect_power(const Scene& scene, EmissionMode mode = EmissionMode::kCosine) {
  glm::dvec3 expected(0);
  for (const Light& light : scene.lights) expected += glm::dvec3(power(light));
  const Emitted e = emit_all(scene, mode);
  // The tolerance is four standard errors and some units in the last place for the rounding of each float
  // flux.
  for (int c = 0; c < 3; ++c) {
    EXPECT_NEAR(e.sum[c], expected[c], 4 * standard_error(e, c) + 1e-6 * expected[c]) << "channel " << c;
  }
}

TEST(Emission, SumOfFluxIsThePowerOfEveryLightType) {
  expect_power(with_light(PointLight{{0.1f, 0.2f, 0.3f}, {1, 2, 3}}));
  expect_power(with_light(SpotLight{{0, 0, 0}, Frame::from_z({0, -1, 0}), {3, 2, 1}, 0.9f, 0.7f}));
  expect_power(with_light(DistantLight{glm::normalize(Vector3(1, 2, 3)), {1, 1, 2}}));
  expect_power(with_light(InfiniteLight{{0.5f, 1, 2}}));
  expect_power(test::lit_room(Rgb(0.5f), {1, 2, 3}));
  expect_power(test::lit_room(Rgb(0.5f), {1, 2, 3}), EmissionMode::kUniformAngle);
}

// The expected values are the literature's, not our power(): pi L A (Lambert), 4 pi I (point).
TEST(Emission, SumOfFluxMatchesTheClosedForm) {
  const Emitted area = emit_all(test::lit_room(Rgb(0.5f), {1, 2, 3}));
  EXPECT_NEAR(area.sum.x, M_PI * 0.25, 1e-6 * M_PI);
  EXPECT_NEAR(area.sum.z, M_PI * 0.75, 1e-6 * M_PI);
  const Emitted point = emit_all(with_light(PointLight{{0, 0, 0}, {1, 2, 3}}));
  EXPECT_NEAR(point.sum.y, 8 * M_PI, 8e-6 * M_PI);
}

TEST(Emission, LightsAreChosenByPowerWithEqualFlux) {
  Scene scene = test::lit_room(Rgb(0.5f), {1, 1, 1});
  scene.lights.emplace_back(PointLight{{0, 0, 0}, Rgb(0.5f)});
  scene.lights.emplace_back(PointLight{{0.5f, 0, 0}, Rgb(0)});
  finalize_scene(scene);
  const Emitted e = emit_all(scene);
  const double area = M_PI / 4, point = 2 * M_PI, p = point / (area + point);
  uint64_t from_point = 0;
  for (const auto& s : e.samples) {
    EXPECT_NEAR(s.flux.x, (area + point) / kCount, 1e-5 / kCount);  // the flux is the same from either light
    if (s.ray.o == Point3(0)) ++from_point;
    EXPECT_NE(s.ray.o, Point3(0.5f, 0, 0));  // no photon from the black light
  }
  EXPECT_EQ(e.samples.size(), kCount);
  EXPECT_NEAR(double(from_point), kCount * p, 4 * std::sqrt(kCount * p * (1 - p)));
}

TEST(Emission, AreaLightEmitsFromItsSurfaceByTheCosine) {
  const Emitted e = emit_all(test::lit_room(Rgb(0.5f), {1, 2, 3}));
  double mean_cosine = 0;
  for (const auto& s : e.samples) {
    EXPECT_LE(std::abs(s.ray.o.x), 0.2501f);
    EXPECT_LE(std::abs(s.ray.o.z), 0.2501f);
    EXPECT_LE(s.ray.o.y, 0.9f);
    EXPECT_GT(s.ray.o.y, 0.8999f);
    EXPECT_LT(s.ray.d.y, 0);
    EXPECT_NEAR(glm::length(s.ray.d), 1, 1e-6);
    mean_cosine -= static_cast<double>(s.ray.d.y) / kCount;
  }
  // The cosine c has the density 2 c on [0, 1]: mean 2/3, variance 1/18.
  EXPECT_NEAR(mean_cosine, 2.0 / 3, 4 * std::sqrt(1.0 / 18 / kCount));
}

TEST(Emission, UniformAngleIsUniformInTheta) {
  const Emitted e = emit_all(test::lit_room(Rgb(0.5f), {1, 2, 3}), EmissionMode::kUniformAngle);
  double mean_theta = 0;
  for (const auto& s : e.samples) mean_theta += std::acos(-static_cast<double>(s.ray.d.y)) / kCount;
  EXPECT_NEAR(mean_theta, M_PI / 4, 4 * M_PI / 2 / std::sqrt(12.0 * kCount));
}

TEST(Emission, FluxIsDividedByTheTotalExactly) {
  const Scene scene = test::lit_room(Rgb(0.5f), {1, 2, 3});
  const Emitted one = emit_all(scene, EmissionMode::kCosine, 1000),
                two = emit_all(scene, EmissionMode::kCosine, 2000);
  ASSERT_EQ(one.samples.size(), two.samples.size());
  for (size_t i = 0; i < one.samples.size(); ++i) ASSERT_EQ(one.samples[i].flux, 2.0f * two.samples[i].flux);
  // Totals beyond 32 bits must divide exactly, too.
  const Emitted many = emit_all(scene, EmissionMode::kCosine, uint64_t{1} << 34);
  EXPECT_FLOAT_EQ(many.samples[0].flux.x, static_cast<float>(M_PI / 4 / 17179869184.0));
}

TEST(Emission, EmitsNothingWithoutLightsOrPower) {
  Scene dark;
  dark.materials = {Lambertian{}};
  test::add_box(dark, 1);
  finalize_scene(dark);
  EXPECT_TRUE(emit_all(dark).samples.empty());
  const Emitted black = emit_all(with_light(PointLight{{0, 0, 0}, Rgb(0)}));
  EXPECT_EQ(black.sum, glm::dvec3(0));
}

// Several kinds of light, among them a two-sided one of many triangles.
Scene many_lights() {
  Scene scene = test::lit_room(Rgb(0.5f), {1, 2, 3});
  TriangleMesh mesh;
  for (int i = 0; i <= 40; ++i) {
    const float x = -0.5f + 0.025f * float(i);
    mesh.P.push_back({x, 0.1f * std::sin(9 * x), -0.2f});
    mesh.P.push_back({x, 0.1f * std::sin(7 * x), 0.2f});
  }
  for (uint32_t i = 0; i + 3 < mesh.P.size(); ++i) mesh.indices.push_back({i, i + 1, i + 2});
  Shape shape;
  shape.geometry = mesh;
  scene.lights.emplace_back(*DiffuseAreaLight::make(shape, {3, 1, 2}, true));
  scene.lights.emplace_back(*DiffuseAreaLight::make(test::sphere({0, 0.5f, 0}, 0.1f, 0), Rgb(5), false));
  scene.lights.emplace_back(PointLight{{0.1f, 0.2f, 0.3f}, {1, 2, 3}});
  scene.lights.emplace_back(DistantLight{glm::normalize(Vector3(1, 2, 3)), {1, 1, 2}});
  finalize_scene(scene);
  return scene;
}

void expect_lanes_are_emit_photon(const Scene& scene, EmissionMode mode, std::optional<uint32_t> only = {}) {
  auto lanes = std::make_unique<EmissionLanes>();
  uint64_t in_any = 0;
  for (const size_t count : {size_t{1}, size_t{37}, kPhotonLanes}) {
    for (uint64_t first = 0; first < 2048; first += kPhotonLanes) {
      std::vector<std::optional<EmissionSample>> expected;
      for (size_t k = 0; k < count; ++k) {
        Sampler sampler(7, first + k);
        const EmissionNumbers u = emission_numbers(scene, sampler);
        const float numbers[] = {u.position.x, u.position.y, u.direction.x, u.direction.y};
        for (int d = 0; d < 4; ++d) lanes->position_direction.u[d][k] = numbers[d];
        lanes->u_light[k] = u.light;
        expected.push_back(emit_photon(scene, u, kCount, mode, only));
      }
      emit_lanes(scene, kCount, mode, count, *lanes, only);
      for (size_t k = 0; k < count; ++k) {
        ASSERT_EQ(lanes->emitted[k] != 0, expected[k].has_value());
        if (!expected[k]) continue;
        ++in_any;
        ASSERT_EQ(lanes->ray.get(k).o, expected[k]->ray.o);
        ASSERT_EQ(lanes->ray.get(k).d, expected[k]->ray.d);
        ASSERT_EQ(get_lane(lanes->flux, k), expected[k]->flux);
      }
    }
  }
  EXPECT_GT(in_any, 3000u);
}

TEST(EmissionLanes, MatchEmitPhotonBitForBit) {
  for (const EmissionMode mode : {EmissionMode::kCosine, EmissionMode::kUniformAngle}) {
    expect_lanes_are_emit_photon(test::lit_room(Rgb(0.5f), {1, 2, 3}), mode);
    expect_lanes_are_emit_photon(with_light(PointLight{{0, 0, 0}, {1, 2, 3}}), mode);
    expect_lanes_are_emit_photon(many_lights(), mode);
    for (uint32_t light = 0; light < 4; ++light) expect_lanes_are_emit_photon(many_lights(), mode, light);
  }
}

TEST(EmissionLanes, DarkScenesEmitNothing) {
  Scene dark;
  finalize_scene(dark);
  auto lanes = std::make_unique<EmissionLanes>();
  lanes->emitted[3] = 1;
  emit_lanes(dark, kCount, EmissionMode::kCosine, 8, *lanes);
  for (size_t k = 0; k < 8; ++k) EXPECT_EQ(lanes->emitted[k], 0);
}

}  // namespace
}  // namespace kaustik::photon
