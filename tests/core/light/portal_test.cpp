// Tests a sky that shines through a rectangle against Lambert's closed form, and that everything outside
// stays dark.

#include <gtest/gtest.h>

#include "core/light/sky/portal.h"
#include "tests/core/support/chi_square.h"
#include "tests/support/random.h"
#include "tests/support/statistics.h"

namespace kaustik {
namespace {

using test::Random;

// A window of 1.2 m x 0.8 m in the plane x = 2, seen from the origin's side; the sky lies towards +x.
PortalInfiniteLight window(std::shared_ptr<const PortalSky> sky) {
  PortalInfiniteLight light;
  light.corner = {2, -0.6f, 0.5f};
  light.along_x = {0, 1.2f, 0};
  light.along_y = {0, 0, 0.8f};
  light.to_world = glm::mat3(0, 1, 0, 0, 0, 1, 1, 0, 0);
  light.sky = std::move(sky);
  return light;
}

std::shared_ptr<const DirectionMap> spotted_map() {
  LightImage image{32, 16, {}};
  Random random(4);
  for (int i = 0; i < 32 * 16; ++i)
    image.pixels.push_back(i % 11 == 0 ? Rgb(30, 20, 10)
                                       : Rgb(random.uniform(), random.uniform(), random.uniform()));
  return std::make_shared<const DirectionMap>(std::make_shared<const LightImage>(std::move(image)),
                                              DirectionMap::Layout::kLatLong);
}

glm::mat3 turned() {
  const Frame f = Frame::from_z(glm::normalize(Vector3(0.2f, 0.5f, 0.4f)));
  return {f.x, f.y, f.z};
}

// Lambert's formula (1760), as in irradiance_test.cpp.
double rectangle_irradiance(const PortalInfiniteLight& light, const Point3& ref, const Normal3& n) {
  const std::array<Point3, 4> corner = {light.corner, light.corner + light.along_x,
                                        light.corner + light.along_x + light.along_y,
                                        light.corner + light.along_y};
  glm::dvec3 sum(0);
  for (size_t i = 0; i < 4; ++i) {
    const glm::dvec3 a = glm::normalize(glm::dvec3(corner[i] - ref));
    const glm::dvec3 b = glm::normalize(glm::dvec3(corner[(i + 1) % 4] - ref));
    sum += std::acos(glm::dot(a, b)) * glm::normalize(glm::cross(a, b));
  }
  return 0.5 * std::abs(glm::dot(sum, glm::dvec3(n)));
}

TEST(Portal, IrradianceOfAConstantSkyMatchesLambert) {
  const PortalInfiniteLight light = window(std::make_shared<const PortalSky>(Rgb(3)));
  for (const Point3 ref : {Point3(0, 0, 0), Point3(1.7f, -0.2f, 0.1f), Point3(-30, 4, -2)}) {
    // These normals have no horizon that cuts the window.
    for (const Normal3 n : {Normal3(0, 0, 1), glm::normalize(Normal3(1, 0.1f, 0.3f))}) {
      Random random(5);
      test::Mean E;
      for (int i = 0; i < 100000; ++i) {
        const auto s = light.sample_Li(ref, random.uniform_2d());
        E.add(s ? double(s->Li.x * std::max(0.0f, glm::dot(s->wi, n)) / s->pdf) : 0);
      }
      const double expected = 3 * rectangle_irradiance(light, ref, n);
      // From 30 m away the window is 1/100 of the square wide, and its edges are rounded to 2^-24.
      EXPECT_NEAR(E.mean, expected, 4.5 * E.standard_error() + 5e-5 * expected);
    }
  }
}

TEST(Portal, SamplesReportRadianceAndDensityOfTheirRays) {
  const PortalInfiniteLight light = window(std::make_shared<const PortalSky>(*spotted_map(), turned()));
  Random random(6);
  for (const Point3 ref : {Point3(0, 0, 0), Point3(1.5f, -0.5f, 0.7f)}) {
    int edges = 0;
    for (int i = 0; i < 20000; ++i) {
      const auto s = light.sample_Li(ref, random.uniform_2d());
      ASSERT_TRUE(s);
      const float pdf = light.pdf_Li(ref, s->wi);
      edges += light.Le({ref, s->wi}) != s->Li || std::abs(pdf - s->pdf) > 1e-4f * s->pdf;
    }
    EXPECT_LT(edges, 20);  // samples that rounding moved across the edge of a cell or of the window
  }
}

// The mean over uniform directions gives the density's integral, which is one, and the flux that photons
// carry through the portal.
TEST(Portal, DensityIntegratesToOneAndPowerEqualsTheFlux) {
  const PortalInfiniteLight light = window(std::make_shared<const PortalSky>(*spotted_map(), turned()));
  Random random(7);
  test::Mean density, flux, photons;
  const Point3 ref(0.5f, 0.3f, 0.1f);
  for (int i = 0; i < 400000; ++i) {
    const Vector3 w = random.direction();
    density.add(4 * std::numbers::pi * double(light.pdf_Li(ref, w)));
    const Point3 on_portal =
        light.corner + random.uniform() * light.along_x + random.uniform() * light.along_y;
    const Ray through{on_portal - 0.01f * w, w};
    flux.add(4 * std::numbers::pi * 1.2 * 0.8 * double(luminance(light.Le(through))) *
             std::max(0.0, double(w.x)));
    const auto photon = light.sample_Le(random.uniform_2d(), random.uniform_2d(), EmissionMode::kCosine);
    photons.add(photon ? double(luminance(photon->flux)) : 0);
    if (photon) {
      ASSERT_LT(photon->ray.d.x, 0);
      ASSERT_TRUE(photon->from_sky);
      ASSERT_EQ(photon->ray.o.x, 2);
    }
  }
  EXPECT_NEAR(density.mean, 1, 4.5 * density.standard_error());
  // Rays that start 1 cm away miss the portal's edge about as often as others come from beside it.
  EXPECT_NEAR(photons.mean, flux.mean, 4.5 * flux.standard_error() + 0.03 * flux.mean);
  // Cells are weighted by the value at their middle; there are 64 a side.
  EXPECT_NEAR(luminance(light.power()), photons.mean, 2e-3 * photons.mean + 4.5 * photons.standard_error());
}

TEST(Portal, OutsideIsDark) {
  const PortalInfiniteLight light = window(std::make_shared<const PortalSky>(Rgb(3)));
  const Point3 outside(2.1f, 0, 0.9f);
  EXPECT_FALSE(light.sample_Li(outside, {0.5f, 0.5f}));
  EXPECT_EQ(light.Le({outside, {1, 0, 0}}), Rgb(0));
  EXPECT_EQ(light.pdf_Li(outside, {1, 0, 0}), 0);
  const Point3 inside(0, 0, 0.9f);
  EXPECT_EQ(light.Le({inside, {1, 0, 0}}), Rgb(3));
  EXPECT_EQ(light.Le({inside, glm::normalize(Vector3(1, 0.4f, 0))}), Rgb(0));  // misses the window
  EXPECT_EQ(light.Le({inside, {-1, 0, 0}}), Rgb(0));
}

}  // namespace
}  // namespace kaustik
