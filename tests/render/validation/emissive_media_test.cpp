// Tests media that emit light: against closed forms, in thermal equilibrium, and against paths.

#include <gtest/gtest.h>

#include "tests/render/support/class_agreement.h"
#include "tests/render/support/media_scenes.h"

namespace kaustik::render {
namespace {

using namespace test;

const Rgb kSigma(0.125f, 0.5f, 2), kLe(3, 2, 1);

RenderSettings quick(Method method, int spp) {
  RenderSettings settings;
  settings.method = method;
  settings.spp = spp;
  settings.adaptive = 0;
  settings.photons = 50'000;
  return settings;
}

class EmissiveSlab : public ::testing::TestWithParam<Method> {};
class EmissiveBall : public ::testing::TestWithParam<Method> {};
class ThermalEquilibrium : public ::testing::TestWithParam<Method> {};

const auto kMethods = ::testing::Values(Method::kRaytrace, Method::kMc, Method::kPhoton, Method::kAuto);

// A slab of 0.7 m before a black wall shows Le (1 - exp(-0.7 sigma)), without noise, in air and in glass
// whose surfaces neither reflect nor bend. column: 0.7 m times the mean density.
void expect_emission_of_slab(const Medium& medium, float column, Method method, bool in_glass) {
  Scene scene;
  const MediumIndex inside = add_medium(scene, medium);
  const uint32_t black = add_material(scene, Lambertian{Rgb(0)});
  const Shape top = horizontal({0, 1, 0}, 1, 1, true, 0), bottom = horizontal({0, 0.3f, 0}, 1, 1, false, 0);
  for (Shape shape : {top, bottom}) {
    if (!in_glass) {
      add_interface(scene, shape, {inside, kVacuum});
      continue;
    }
    shape.material = add_material(scene, Dielectric{1});
    add_shape(scene, shape).media = {inside, kVacuum};
  }
  add_shape(scene, horizontal({0, 0, 0}, 1, 1, true, black));
  look_at(scene, {0, 3, 0}, {0, 0, 0}, {0, 0, 1}, 0.001f, 4, 4);
  finalize_scene(scene);
  EXPECT_TRUE(scene.needs.emissive_media);
  EXPECT_EQ(scene.emissive_bodies.empty(), in_glass);
  const auto result = render_with_threads(scene, quick(method, 4));
  for (int c = 0; c < 3; ++c) {
    const double expected = double(kLe[c]) * -std::expm1(-double(kSigma[c]) * double(column));
    // Rays start up to 5e-6 m off the surface that they leave; the density is at most 1.5 there.
    EXPECT_NEAR(double(result.film.at(1, 2).emitted[c]), expected,
                double(kLe[c] * kSigma[c]) * 7.5e-6 + 1e-6 * expected)
        << c;
    EXPECT_EQ(result.film.at(1, 2).direct[c], 0);
  }
  write_if_failed(result.film, "emissive_slab");
}

TEST_P(EmissiveSlab, IsSeenAsDeepAsItIs) {
  for (const bool in_glass : {false, true})
    expect_emission_of_slab({kSigma, Rgb(0), 0, nullptr, kLe}, 0.7f, GetParam(), in_glass);
}

// A density of 0.5 + y, whose integral from 0.3 to 1 is 0.805.
TEST_P(EmissiveSlab, IsSeenWhereTheDensityChanges) {
  const auto density =
      grid_of({3, 13, 3}, {-3, 0, -3}, {3, 1.3, 3}, [](const glm::dvec3& p) { return 0.5 + p.y; });
  expect_emission_of_slab({kSigma, Rgb(0), 0, density, kLe}, 0.805f, GetParam(), false);
}
INSTANTIATE_TEST_SUITE_P(Methods, EmissiveSlab, kMethods);

// A ball of radius r whose centre is d above a plane. At an angle theta its chord is 2 sqrt(r^2 - d^2 sin^2),
// so that   E = 2 pi int Le (1 - exp(-sigma chord)) cos sin dtheta.
double irradiance_below_ball(double sigma, double Le, double r, double d) {
  constexpr int kSteps = 20'000;
  const double most = std::asin(r / d);
  double sum = 0;
  for (int i = 0; i < kSteps; ++i) {
    const double theta = most * (i + 0.5) / kSteps, across = d * std::sin(theta);
    const double chord = 2 * std::sqrt(r * r - across * across);
    sum += -std::expm1(-sigma * chord) * std::sin(2 * theta) / 2;
  }
  return 2 * std::numbers::pi * Le * sum * most / kSteps;
}

// Light samples find the ball where it is small, others where it is large.
TEST_P(EmissiveBall, LightsThePlaneBelow) {
  for (const float radius : {0.05f, 0.9f}) {
    Scene scene;
    add_shape(scene, horizontal({0, 0, 0}, 4, 4, true, add_material(scene, Lambertian{Rgb(0.5f)})));
    add_interface(scene, sphere({0, 1, 0}, radius, 0),
                  {add_medium(scene, {kSigma, Rgb(0), 0, nullptr, kLe}), kVacuum});
    look_at(scene, {3, 0.5f, 0}, {0, 0, 0}, {0, 1, 0}, 0.01f, 8, 8);
    finalize_scene(scene);
    const std::vector<Film> found = films(scene, quick(GetParam(), 64));
    for (int c = 0; c < 3; ++c) {
      const double E = irradiance_below_ball(double(kSigma[c]), double(kLe[c]), double(radius), 1);
      std::vector<double> means;
      for (const Film& film : found) {
        double sum = 0;
        for (int y = 0; y < 8; ++y)
          for (int x = 0; x < 8; ++x) sum += double(film.at(x, y).direct[c]);
        means.push_back(sum / 64);
      }
      const Estimate direct = estimate_of(means);
      const double expected = 0.5 * E / std::numbers::pi;
      EXPECT_NEAR(direct.mean, expected, kErrors * direct.standard_error + 1e-5 * expected)
          << radius << " " << c;
      EXPECT_LT(direct.standard_error, 0.01 * expected) << radius << " " << c;
    }
    write_if_failed(found[0], "emissive_ball");
  }
}
INSTANTIATE_TEST_SUITE_P(Methods, EmissiveBall, kMethods);

// Walls of reflectance rho that emit 1 - rho, around a medium that emits 1 where it absorbs, scatters, too,
// and holds a ball of glass and a mirror: in thermal equilibrium the radiance is 1 everywhere and into all
// directions (Kirchhoff), and n^2 in the glass. So each way of light must be counted once.
Scene equilibrium() {
  Scene scene;
  const float rho = 0.5f;
  add_glowing_walls(scene, add_material(scene, Lambertian{Rgb(rho)}), Rgb(1 - rho));
  scene.camera_medium = add_medium(scene, {{0.2f, 0.5f, 1}, {0.5f, 0.25f, 0}, 0.3f, nullptr, Rgb(1)});
  scene.light_media.assign(scene.lights.size(), scene.camera_medium);
  add_shape(scene, sphere({0.3f, -0.2f, -0.4f}, 0.35f, add_material(scene, Dielectric{1.5f}))).media = {
      kVacuum, scene.camera_medium};
  add_shape(scene, sphere({-0.5f, -0.3f, -0.2f}, 0.25f, add_material(scene, Mirror{Rgb(1)})));
  look_at(scene, {0.2f, 0.4f, 0.8f}, {0, -0.3f, -0.6f}, {0, 1, 0}, 60, 8, 8);
  finalize_scene(scene);
  return scene;
}

TEST_P(ThermalEquilibrium, RadianceIsOne) {
  RenderSettings settings = quick(GetParam(), GetParam() == Method::kPhoton ? 64 : 256);
  settings.photons = 200'000;
  settings.max_bounces = 200;
  settings.radius = 0.1f;
  const std::vector<Film> found = films(equilibrium(), settings);
  std::vector<double> means;
  for (const Film& film : found) means.push_back(total_mean(film));
  const Estimate all = estimate_of(means);
  // Near walls a part of the kernel of photons in media lies behind them.
  const double bias = GetParam() == Method::kMc ? 1e-3 : 0.03;
  EXPECT_NEAR(all.mean, 1, kErrors * all.standard_error + bias);
  EXPECT_LT(all.standard_error, 0.01);
  write_if_failed(found[0], "thermal_equilibrium");
}
INSTANTIATE_TEST_SUITE_P(Methods, ThermalEquilibrium,
                         ::testing::Values(Method::kMc, Method::kHybrid, Method::kPhoton, Method::kAuto));

// The box with its lamp and a ball of glowing smoke on a grid.
TEST(EmissiveMedia, EachClassAgreesWithPaths) {
  Scene scene = cornell(kSize);
  add_smoke(scene, Rgb(40));
  const auto by_paths = films(scene, settings_of(Method::kMc, 256, 0.1f, 100));
  for (const Method method : {Method::kPhoton, Method::kAuto}) {
    const Comparison c(scene, by_paths, method, 0.1f);
    for (const Layer layer : {Layer::kEmitted, Layer::kDirect, Layer::kIndirect})
      c.expect_agreement_everywhere(layer);
    c.write_pictures("glowing_smoke_" + std::to_string(int(method)));
  }
}

// A box that a ball of glowing gas lights alone.
Scene lit_by_gas(const Rgb& Le) {
  Scene scene = cornell(kSize);
  for (Shape& shape : scene.shapes) shape.light = kNoIndex;
  scene.lights.clear();
  add_interface(scene, sphere({0, 1.2f, 0.1f}, 0.3f, 0),
                {add_medium(scene, {Rgb(1), Rgb(1), 0, nullptr, Le}), kVacuum});
  finalize_scene(scene);
  return scene;
}

// Without lights nothing is left to photons: all methods that follow paths to their end do the same.
TEST(EmissiveMedia, LightTheSceneAlone) {
  const Scene scene = lit_by_gas(Rgb(5));
  const auto by_paths = render_with_threads(scene, settings_of(Method::kMc, 4, 0.1f, 1));
  const auto by_auto = render_with_threads(scene, settings_of(Method::kAuto, 4, 0.1f, 1));
  EXPECT_GT(total_mean(by_paths.film), 0);
  EXPECT_EQ(by_auto.statistics.photons.emitted, 0u);
  for (int y = 0; y < kSize; ++y)
    for (int x = 0; x < kSize; ++x)
      EXPECT_EQ(by_auto.film.at(x, y).radiance(), by_paths.film.at(x, y).radiance());
}

// The range of sums follows what media emit.
TEST(EmissiveMedia, ScalingTheLightByPowersOfTwoScalesThePicture) {
  const RenderSettings settings = settings_of(Method::kAuto, 4, 0.1f, 1);
  const Film plain = render_with_threads(lit_by_gas(Rgb(5, 3, 1)), settings).film;
  for (const int exponent : {-60, 60}) {
    const float scale = std::ldexp(1.0f, exponent);
    const auto scaled = render_with_threads(lit_by_gas(scale * Rgb(5, 3, 1)), settings);
    EXPECT_EQ(scaled.statistics.clamped_sums, 0u);
    for (int y = 0; y < kSize; ++y)
      for (int x = 0; x < kSize; ++x)
        EXPECT_EQ(scaled.film.at(x, y).radiance(), scale * plain.at(x, y).radiance()) << exponent;
  }
}

// A ball of gas seen by way of a glossy floor and a mirror, and a light, so that the tails of the floor's
// lobe are left to the caustic map: what the gas emits is not in it.
TEST(EmissiveMedia, AreSeenBehindTheTailsOfGlossyLobes) {
  Scene scene;
  add_shape(scene, horizontal({0, 0, 0}, 4, 4, true,
                              add_material(scene, Conductor{Rgb(0.2f), Rgb(3), {0.2f, 0.2f}})));
  add_shape(scene,
            quad({-4, 0, -1}, {4, 0, -1}, {4, 4, -1}, {-4, 4, -1}, add_material(scene, Mirror{Rgb(0.9f)})));
  scene.lights.push_back(PointLight{{0, 3, 3}, Rgb(1e-6f)});
  add_interface(scene, sphere({0, 1, 2}, 0.6f, 0),
                {add_medium(scene, {Rgb(2), Rgb(0), 0, nullptr, Rgb(4)}), kVacuum});
  look_at(scene, {0, 2.5f, 3}, {0, 0, 0}, {0, 1, 0}, 20, 8, 8);
  finalize_scene(scene);
  EXPECT_FALSE(scene.needs.diffuse);
  EXPECT_TRUE(scene.needs.glossy);
  const Estimate by_paths = total(films(scene, quick(Method::kMc, 1024)));
  const Estimate by_auto = total(films(scene, quick(Method::kAuto, 1024)));
  const double noise = std::hypot(by_paths.standard_error, by_auto.standard_error);
  EXPECT_NEAR(by_auto.mean, by_paths.mean, kErrors * noise);
  EXPECT_LT(noise, 0.02 * by_paths.mean);
}

}  // namespace
}  // namespace kaustik::render
