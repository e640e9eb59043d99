// Tests what a textured area light emits and how evenly its photons share the flux.

#include "core/light/image/emission_image.h"

#include <gtest/gtest.h>

#include "core/light/area/area.h"
#include "tests/core/support/chi_square.h"
#include "tests/core/support/test_tracer.h"
#include "tests/support/random.h"
#include "tests/support/statistics.h"

namespace kaustik {
namespace {

using test::Random;

std::shared_ptr<const LightImage> image_of(int width, int height, std::vector<Rgb> pixels) {
  return std::make_shared<const LightImage>(LightImage{width, height, std::move(pixels)});
}

Shape square() {
  Shape shape;
  shape.geometry = TriangleMesh{{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}},
                                {},
                                {{0, 0}, {1, 0}, {1, 1}, {0, 1}},
                                {{0, 1, 2}, {0, 2, 3}}};
  return shape;
}

TEST(EmissionImage, LowerLeftIsZero) {
  const auto light =
      *DiffuseAreaLight::make(square(), Rgb(1), false, image_of(2, 2, {Rgb(1), Rgb(2), Rgb(3), Rgb(4)}));
  EXPECT_EQ(light.image->value({0, 0}), Rgb(3));
  EXPECT_EQ(light.image->value({1, 0}), Rgb(4));
  EXPECT_EQ(light.image->value({0, 1}), Rgb(1));
  EXPECT_EQ(light.image->value({0.5f, 0.5f}), Rgb(2.5f));
  // Lookups are clamped, not repeated; NaN reads a corner.
  EXPECT_EQ(light.image->value({7, -3}), Rgb(4));
  EXPECT_EQ(light.image->value({std::nanf(""), 1}), Rgb(1));
  EXPECT_EQ(light.image->mean_of_pixels(), Rgb(2.5f));
  // The integral uses eight points a pixel, and crosses the kinks of the clamped edges.
  EXPECT_NEAR(light.power().x, kPi * 2.5f, 1e-3f * kPi * 2.5f);
}

// The uv of a sampled point are those that a ray finds there.
TEST(EmissionImage, SampledPointsHaveTheUvThatRaysFind) {
  std::vector<Shape> shapes = {square()};
  const auto image = image_of(3, 2, {Rgb(1), Rgb(9), Rgb(2), Rgb(5), Rgb(0), Rgb(3)});
  const auto light = *DiffuseAreaLight::make(shapes[0], Rgb(1), true, image);
  Random random(3);
  const Point3 eye(0.4f, 0.7f, 1);
  for (int i = 0; i < 2000; ++i) {
    const auto s = light.sample_Li(eye, random.uniform_2d());
    ASSERT_TRUE(s);
    const Ray ray{eye, s->wi};
    const Hit hit = test::brute_force(shapes, ray);
    if (!hit.valid()) continue;  // missed at the rim
    const SurfaceInteraction si = make_interaction(shapes, ray, hit);
    // The image's slope is below 9 per pixel, a pixel is a third of the shape, and points are known to 1e-6.
    EXPECT_NEAR(light.Le(si, -s->wi).x, s->Li.x, 1e-4f);
  }
}

// Photons of a light of one colour should have nearly equal flux: a uniform picture gives each the same.
// Where brightness rises from zero along both sides of a cell its corner has three times the root mean
// square, and more where a cell begins in the dark, but few photons start there. If points were chosen
// evenly, the brightest would carry 100 times the mean here, and the standard deviation would be 5 means.
TEST(EmissionImage, PhotonsCarryNearlyTheSameFlux) {
  std::vector<Rgb> pixels(16 * 16, Rgb(0.02f));
  pixels[5 * 16 + 9] = pixels[12 * 16 + 2] = Rgb(10);
  for (const bool even : {true, false}) {
    const auto image = even ? image_of(1, 1, {Rgb(2)}) : image_of(16, 16, pixels);
    const auto light = *DiffuseAreaLight::make(square(), Rgb(1), false, image);
    Random random(5);
    test::Mean mean;
    float most = 0;
    for (int i = 0; i < 20000; ++i) {
      const auto s = light.sample_Le(random.uniform_2d(), random.uniform_2d(), EmissionMode::kCosine);
      if (!s) continue;
      mean.add(double(s->flux.x));
      most = std::max(most, s->flux.x);
    }
    EXPECT_NEAR(mean.mean, double(light.power().x), 4.5 * mean.standard_error() + 1e-5);
    EXPECT_LT(double(most), (even ? 1.00001 : 7) * mean.mean);
    EXPECT_LT(mean.standard_error() * std::sqrt(20000.0), (even ? 1e-5 : 0.6) * mean.mean);
  }
}

// Many small triangles, each with one colour.
TEST(EmissionImage, DarkTrianglesAreSeldomChosen) {
  Shape strip;
  TriangleMesh mesh;
  for (uint32_t i = 0; i < 1000; ++i) {
    const float x = float(i), u = x / 1000;
    mesh.P.insert(mesh.P.end(), {{x, 0, 0}, {x + 1, 0, 0}, {x, 1, 0}});
    mesh.uv.insert(mesh.uv.end(), {{u, 0}, {u + 0.001f, 0}, {u, 1}});
    mesh.indices.push_back({3 * i, 3 * i + 1, 3 * i + 2});
  }
  strip.geometry = std::move(mesh);
  std::vector<Rgb> pixels(50, Rgb(0));
  pixels[30] = Rgb(1);
  const auto light = *DiffuseAreaLight::make(strip, Rgb(1), false, image_of(50, 1, pixels));
  Random random(7);
  int dark = 0;
  for (int i = 0; i < 10000; ++i) {
    const auto s = light.sample_Le(random.uniform_2d(), random.uniform_2d(), EmissionMode::kCosine);
    dark += s && is_black(s->flux);
  }
  // A share of 1 in 33 is spread evenly, and nearly all of that lands on dark triangles. The tolerance is
  // five standard deviations.
  EXPECT_NEAR(dark, 10000 / 33.0, 5 * std::sqrt(10000 / 33.0));
}

TEST(EmissionImage, BlackImageEmitsNothing) {
  const auto light = *DiffuseAreaLight::make(square(), Rgb(1), false, image_of(1, 1, {Rgb(0)}));
  EXPECT_EQ(light.power(), Rgb(0));
  const auto s = light.sample_Le({0.3f, 0.4f}, {0.5f, 0.6f}, EmissionMode::kCosine);
  EXPECT_TRUE(!s || is_black(s->flux));
}

}  // namespace
}  // namespace kaustik
