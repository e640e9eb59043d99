// Tests the properties that every light must have, on instances of all types.

#include "core/light/light.h"

#include <gtest/gtest.h>

#include <set>

#include "tests/core/light/light_cases.h"
#include "tests/core/support/chi_square.h"
#include "tests/support/random.h"
#include "tests/support/shapes.h"
#include "tests/support/statistics.h"

namespace kaustik {
namespace {

using test::LightCase;
using test::Random;

TEST(Light, CasesCoverEveryTypeAndSurface) {
  std::set<size_t> types, surfaces;
  for (const LightCase& c : test::light_cases()) {
    types.insert(c.light.index());
    if (const auto* area = std::get_if<DiffuseAreaLight>(&c.light)) surfaces.insert(area->surface.index());
  }
  EXPECT_EQ(types.size(), std::variant_size_v<Light>);
  EXPECT_EQ(surfaces.size(), std::variant_size_v<decltype(DiffuseAreaLight::surface)>);
}

TEST(Light, MeanEmittedFluxIsThePower) {
  for (const LightCase& c : test::light_cases()) {
    for (const EmissionMode mode : {EmissionMode::kCosine, EmissionMode::kUniformAngle}) {
      SCOPED_TRACE(c.name);
      Random random(1);
      test::Mean flux;
      for (int i = 0; i < 50000; ++i) {
        const auto s = test::sample_Le(c.light, random, mode);
        flux.add(s ? luminance(s->flux) : 0);
        if (s) {
          ASSERT_NEAR(glm::length(s->ray.d), 1, 1e-6);
        }
      }
      // Emission with equal flux has no variance; only float rounding remains.
      const double power_y = luminance(power(c.light));
      EXPECT_NEAR(flux.mean, power_y, 4.5 * flux.standard_error() + 1e-5 * power_y);
    }
  }
}

// Compares the flux of photons through a disk with the irradiance on it, from sample_Li at random points of
// the disk: two ways through different code that must give the same flux. Both are independent means.
TEST(Light, PhotonsAndIrradianceCarryTheSameFlux) {
  for (const LightCase& c : test::light_cases()) {
    for (const EmissionMode mode : {EmissionMode::kCosine, EmissionMode::kUniformAngle}) {
      SCOPED_TRACE(c.name);
      Random random(2);
      const test::Receiver receiver = test::receiver_of(c);
      test::Mean photons, irradiance;
      for (int i = 0; i < 400000; ++i) {
        const auto s = test::sample_Le(c.light, random, mode);
        photons.add(s && receiver.meets(s->ray) ? luminance(s->flux) : 0);
      }
      for (int i = 0; i < 100000; ++i) {
        const Point3 p = receiver.point(random.uniform_2d());
        const auto s = test::sample_Li(c.light, {p, receiver.normal, false}, random);
        const float cosine = s ? glm::dot(s->wi, receiver.normal) : 0;
        irradiance.add(cosine > 0 ? luminance(s->Li) * cosine / s->pdf * receiver.area() : 0);
      }
      ASSERT_GT(irradiance.mean, 0);
      EXPECT_NEAR(
          photons.mean, irradiance.mean,
          4.5 * std::hypot(photons.standard_error(), irradiance.standard_error()) + 1e-5 * irradiance.mean);
    }
  }
}

// Wherever a light brings something, its bounds find it important, and what arrives is no brighter than
// brightness() says: the cases' lights are of the size of a scene of radius one, and no receiver is nearer
// than 2^-10 of that.
TEST(Light, BoundsAndBrightnessHoldForWhatArrives) {
  for (const LightCase& c : test::light_cases()) {
    SCOPED_TRACE(c.name);
    const std::optional<LightBounds> bounds = bounds_of(c.light);
    const double brightest = brightness(c.light, 1);
    Random random(20);
    int arriving = 0;
    for (int i = 0; i < 20000; ++i) {
      LightReceiver x{3.0f * Point3(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1))};
      x.n = random.direction();
      x.two_sided = random.uniform() < 0.5f;
      const auto s = test::sample_Li(c.light, x, random);
      if (!s || is_black(s->Li) || (!x.two_sided && !(glm::dot(x.n, s->wi) > 0))) continue;
      ++arriving;
      ASSERT_TRUE(!bounds || bounds->importance(x) > 0);
      ASSERT_LE(double(max_component(s->Li)), brightest * (1 + 8 * 0x1p-24));
    }
    EXPECT_GT(arriving, 100);
  }
}

// sample_Li's directions against pdf_Li, evaluated where rays meet the light: chi-square, and mass one.
TEST(Light, DirectionsFollowTheirDensity) {
  std::vector<test::SquareCase> cases;
  for (const LightCase& c : test::light_cases()) {
    if (is_delta(c.light)) continue;
    for (const Point3& ref : c.refs) {
      cases.push_back(test::direction_square(c, {ref}));
      // For skies the receiver's normal also affects the choice.
      if (is_infinite(c.light))
        cases.push_back(test::direction_square(c, {ref, glm::normalize(Vector3(1, -2, 0.5f)), false}));
    }
  }
  // A light's outline crosses bins: 40 subdivisions of each of 16 bins resolve its area to better than a
  // percent.
  test::expect_all_accepted(cases, 40000, 0.01);
}

TEST(Light, SampledDensityEqualsPdfLi) {
  for (const LightCase& c : test::light_cases()) {
    const auto* area = std::get_if<DiffuseAreaLight>(&c.light);
    if (!area) continue;
    for (const Point3& ref : c.refs) {
      SCOPED_TRACE(c.name);
      Random random(3);
      int compared = 0, other_cell = 0;
      for (int i = 0; i < 2000; ++i) {
        const auto s = area->sample_Li(ref, random.uniform_2d());
        if (!s) continue;
        const Ray ray{ref, s->wi};
        const Hit hit = test::brute_force(c.shapes, ray);
        if (!hit.valid()) continue;  // missed at the rim
        const SurfaceInteraction on_light = make_interaction(c.shapes, ray, hit);
        // Where another part of the light hides the sampled point, the densities belong to different points.
        if (glm::distance(on_light.p, s->p_light) > 1e-4f * glm::distance(ref, s->p_light)) continue;
        // The cosine at the light loses relative precision at grazing angles.
        const float cosine = abs_dot(on_light.n, s->wi);
        const float found = area->pdf_Li(ref, s->wi, on_light), error = std::abs(found - s->pdf);
        ++compared;
        if (error <= s->pdf * (1e-5f + 2e-6f / cosine)) continue;
        EXPECT_TRUE(area->image) << found << " for " << s->pdf;
        ++other_cell;
      }
      EXPECT_GT(compared, 500);
      // For an image, rounding may move the point over the edge of its cell, which is about a millionth of
      // the cell away.
      EXPECT_LE(other_cell, 2);
    }
  }
}

// The shadow ray ends on the side of the light that shines on the point, so no part of the light is between
// them.
TEST(Light, SampledPointIsNotBehindItsOwnLight) {
  for (const LightCase& c : test::light_cases()) {
    const auto* area = std::get_if<DiffuseAreaLight>(&c.light);
    if (!area || std::holds_alternative<TriangleEmitter>(area->surface)) continue;
    for (const Point3& ref : c.refs) {
      Random random(4);
      for (int i = 0; i < 20000; ++i) {
        const auto s = area->sample_Li(ref, random.uniform_2d());
        if (!s) continue;
        const Vector3 d = s->p_light - ref;
        ASSERT_FALSE(test::brute_force(c.shapes, Ray{ref, d, 1}).valid()) << c.name << " " << i;
      }
    }
  }
}

TEST(Light, EmittedRaysDoNotMeetTheirConvexLight) {
  for (const LightCase& c : test::light_cases()) {
    const auto* area = std::get_if<DiffuseAreaLight>(&c.light);
    const auto* sphere = area ? std::get_if<SphereEmitter>(&area->surface) : nullptr;
    const bool mesh = area && std::holds_alternative<TriangleEmitter>(area->surface);
    // Inner sides of spheres and of bent meshes may well shine on the light itself.
    const auto* swept = area ? std::get_if<SweptEmitter>(&area->surface) : nullptr;
    const bool hollow = swept && !std::visit([](const auto& shape) { return shape.flat(); }, swept->shape);
    if (!area || hollow || (sphere && sphere->inward) || (area->twosided && (sphere || mesh))) continue;
    Random random(5);
    for (int i = 0; i < 20000; ++i) {
      const auto s = test::sample_Le(c.light, random, EmissionMode::kCosine);
      if (!s) continue;
      ASSERT_FALSE(test::brute_force(c.shapes, s->ray).valid()) << c.name;
    }
  }
}

// So a guide finds a small target by two numbers, whatever the place is.
TEST(Light, DirectionsOfPhotonsFromASphereDoNotDependOnThePlace) {
  for (const LightCase& c : test::light_cases()) {
    const auto* area = std::get_if<DiffuseAreaLight>(&c.light);
    if (!area || !std::holds_alternative<SphereEmitter>(area->surface)) continue;
    const auto emitted = [&](const Point2& u_pos) {
      return area->sample_Le(u_pos, {0.3f, 0.8f}, EmissionMode::kCosine);
    };
    const auto a = emitted({0.2f, 0.6f}), b = emitted({0.7f, 0.1f});
    ASSERT_TRUE(a && b) << c.name;
    EXPECT_EQ(a->ray.d, b->ray.d) << c.name;
    EXPECT_NE(a->ray.o, b->ray.o) << c.name;
  }
}

TEST(Light, PowerDistributionFollowsTheLightsPower) {
  std::vector<Light> lights = {PointLight{Point3(0), Rgb(1)}, PointLight{Point3(0), Rgb(0)},
                               PointLight{Point3(0), Rgb(3)}};
  const DiscreteDistribution d = light_power_distribution(lights);
  EXPECT_FLOAT_EQ(d.pdf(0), 0.25f);
  EXPECT_EQ(d.pdf(1), 0);
  EXPECT_FLOAT_EQ(d.pdf(2), 0.75f);
  for (Light& light : lights) std::get<PointLight>(light).I = Rgb(0);
  EXPECT_FLOAT_EQ(light_power_distribution(lights).pdf(1), 1.0f / 3);
  EXPECT_TRUE(light_power_distribution({}).empty());
}

TEST(Light, SphereUnderNonUniformScaleCannotEmit) {
  Shape shape;
  shape.geometry =
      Sphere{Transform::from_matrix(test::affine(glm::dmat3(1, 0, 0, 0, 2, 0, 0, 0, 1), {0, 0, 0}))};
  EXPECT_FALSE(DiffuseAreaLight::make(shape, Rgb(1), false));
}

}  // namespace
}  // namespace kaustik
