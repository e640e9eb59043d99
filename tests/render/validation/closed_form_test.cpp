// Tests scenes whose radiance is known in closed form.

#include <gtest/gtest.h>

#include "tests/render/support/closed_forms.h"
#include "tests/render/support/image_statistics.h"
#include "tests/support/packed_flux.h"

namespace kaustik::render {
namespace {

using namespace test;

// A camera with a tiny field of view shows one point. The footprint of a fov of 0.001 degrees from 4 m away
// is 7e-5 m, over which the irradiance of lights 1 m away changes by less than 3 * 7e-5 (|grad ln E| <= 3 /
// distance).
constexpr float kPointFov = 0.001f;
constexpr double kFootprint = 3 * 7e-5;

constexpr float kReflectance = 0.5f;

Scene plane(const Point3& seen) {
  Scene scene;
  const uint32_t white = add_material(scene, Lambertian{Rgb(kReflectance)});
  add_shape(scene, horizontal({0, 0, 0}, 4, 4, true, white));
  look_at(scene, {2, 3, 1.5f}, seen, {0, 1, 0}, kPointFov, 8, 8);
  return scene;
}

RenderSettings settings_of(Method method, int spp) {
  RenderSettings settings;
  settings.method = method;
  settings.spp = spp;
  return settings;
}

class PointLightByRays : public ::testing::TestWithParam<Method> {};

TEST_P(PointLightByRays, MatchesTheClosedForm) {
  for (const Point3 seen : {Point3(0, 0, 0), Point3(0.5f, 0, 0.25f), Point3(-1.5f, 0, 1)}) {
    Scene scene = plane(seen);
    scene.lights.push_back(PointLight{{0, 1, 0}, Rgb(3)});
    finalize_scene(scene);
    const auto result = render_with_threads(scene, settings_of(GetParam(), 2));
    const double expected =
        kReflectance * PointLightOverPlane{3, 1}.irradiance(seen.x * seen.x + seen.z * seen.z) / double(kPi);
    EXPECT_NEAR(total_mean(result.film), expected, expected * kFootprint) << seen.x << " " << seen.z;
  }
}
INSTANTIATE_TEST_SUITE_P(Methods, PointLightByRays,
                         ::testing::Values(Method::kRaytrace, Method::kMc, Method::kAuto));

// The estimate averages E over a disc of radius r. Its bias is r^2/8 times the Laplacian, at most with the
// Laplacian's largest value on the disc (second-order Taylor with remainder). M photons in reach scatter at
// most like a Poisson number.
TEST(PointLightPhotons, WithinKernelBiasAndNoise) {
  constexpr double kRadius = 0.1, kPhotons = 1e6;
  const PointLightOverPlane form{3, 1};
  for (const Point3 seen : {Point3(0, 0, 0), Point3(0.5f, 0, 0.25f), Point3(-1.0f, 0, 0.5f)}) {
    Scene scene = plane(seen);
    scene.lights.push_back(PointLight{{0, 1, 0}, Rgb(3)});
    finalize_scene(scene);
    RenderSettings settings = settings_of(Method::kPhoton, 1);
    settings.photons = uint64_t(kPhotons);
    settings.radius = float(kRadius);
    const auto result = render_with_threads(scene, settings);

    const double rho = std::hypot(double(seen.x), double(seen.z));
    double curvature = 0;
    for (double d = -kRadius; d <= kRadius; d += kRadius / 16)
      curvature = std::max(curvature, std::abs(form.laplacian((rho + d) * (rho + d))));
    const double E = form.irradiance(rho * rho), flux = 4 * double(kPi) * form.I / kPhotons;
    const double in_reach = E * double(kPi) * kRadius * kRadius / flux;
    const double bound =
        kRadius * kRadius / 8 * curvature + 4 * E / std::sqrt(in_reach) + E * (kPackedFluxError + kFootprint);
    EXPECT_NEAR(total_mean(result.film), kReflectance * E / double(kPi), kReflectance * bound / double(kPi));
    EXPECT_GT(result.film.at(0, 0).photons, in_reach / 2);
    EXPECT_EQ(result.statistics.radius, float(kRadius));
    write_if_failed(result.film, "point_light_photons");
  }
}

struct TriangleLight {
  Point3 a{-0.4f, 1, -0.3f}, b{0.6f, 1.2f, -0.2f}, c{0.1f, 0.9f, 0.7f};
  double irradiance(const glm::dvec3& x) const {
    return lambert_polygon({glm::dvec3(a), glm::dvec3(b), glm::dvec3(c)}, x, {0, 1, 0}, 5);
  }
  // An upper bound of the Laplacian of the irradiance on the plane at x, by central differences of step h in
  // double. Their error is at most h^2/12 times the sum of both axes' fourth derivatives, which is below 100
  // E under this light (65 E at most within 0.1 m of the points that are tested): 8e-4 E for h = 0.01.
  double largest_laplacian(const glm::dvec3& x) const {
    constexpr double kStep = 1e-2;
    const double center = irradiance(x);
    double sum = 0;
    for (const glm::dvec3 d : {glm::dvec3(kStep, 0, 0), glm::dvec3(-kStep, 0, 0), glm::dvec3(0, 0, kStep),
                               glm::dvec3(0, 0, -kStep)})
      sum += irradiance(x + d) - center;
    return std::abs(sum) / (kStep * kStep) + kStep * kStep / 12 * 100 * center;
  }
  Scene scene(const Point3& seen) const {
    Scene s = plane(seen);
    const uint32_t black = add_material(s, Lambertian{Rgb(0)});
    make_light(s, add_shape(s, triangle(a, b, c, black)), Rgb(5));
    finalize_scene(s);
    return s;
  }
};

class PolygonLightByRays : public ::testing::TestWithParam<Method> {};

TEST_P(PolygonLightByRays, MatchesLambertsFormula) {
  for (const Point3 seen : {Point3(0.1f, 0, 0.05f), Point3(1, 0, 0.5f)}) {
    const TriangleLight light;
    const auto result = render_with_threads(light.scene(seen), settings_of(GetParam(), 512));
    std::vector<double> pixels;
    for (int y = 0; y < 8; ++y)
      for (int x = 0; x < 8; ++x) pixels.push_back(double(result.film.at(x, y).direct.x));
    const Estimate direct = estimate_of(pixels);
    const double expected = kReflectance * light.irradiance(glm::dvec3(seen)) / double(kPi);
    EXPECT_NEAR(direct.mean, expected, 4 * direct.standard_error + expected * kFootprint);
    EXPECT_LT(direct.standard_error, 0.01 * expected);
    write_if_failed(result.film, "polygon_light");
  }
}
INSTANTIATE_TEST_SUITE_P(Methods, PolygonLightByRays, ::testing::Values(Method::kRaytrace, Method::kMc));

// The bias and noise are bounded as for the point light, with the Laplacian of Lambert's formula.
TEST(PolygonLightPhotons, WithinKernelBiasAndNoise) {
  constexpr double kRadius = 0.1, kPhotons = 1e6;
  const TriangleLight light;
  const Point3 seen(0.1f, 0, 0.05f);
  RenderSettings settings = settings_of(Method::kPhoton, 1);
  settings.photons = uint64_t(kPhotons);
  settings.radius = float(kRadius);
  const Scene scene = light.scene(seen);
  const auto result = render_with_threads(scene, settings);

  double curvature = 0;
  for (int i = 0; i < 16; ++i)
    for (const double part : {0.0, 0.5, 1.0}) {
      const double angle = i * std::numbers::pi / 8, d = part * kRadius;
      const glm::dvec3 on_disc(d * std::cos(angle), 0, d * std::sin(angle));
      curvature = std::max(curvature, light.largest_laplacian(glm::dvec3(seen) + on_disc));
    }
  const double E = light.irradiance(glm::dvec3(seen)), flux = double(power(scene.lights[0]).x) / kPhotons;
  const double in_reach = E * double(kPi) * kRadius * kRadius / flux;
  const double bound =
      kRadius * kRadius / 8 * curvature + 4 * E / std::sqrt(in_reach) + E * (kPackedFluxError + kFootprint);
  EXPECT_LT(bound, 0.2 * E);  // the bound is meaningful
  EXPECT_NEAR(total_mean(result.film), kReflectance * E / double(kPi), kReflectance * bound / double(kPi));
  write_if_failed(result.film, "polygon_light_photons");
}

// A light seen by the camera shows its radiance on its outside, and nothing on its back.
TEST(Emitted, LightIsVisibleOnItsOutsideOnly) {
  for (const bool outside : {true, false}) {
    Scene scene;
    const uint32_t black = add_material(scene, Lambertian{Rgb(0)});
    make_light(scene, add_shape(scene, horizontal({0, 0, 0}, 1, 1, outside, black)), {1, 2, 3});
    look_at(scene, {0, 2, 0}, {0, 0, 0}, {0, 0, 1}, 1, 4, 4);
    finalize_scene(scene);
    for (const Method method : {Method::kRaytrace, Method::kMc, Method::kHybrid, Method::kPhoton}) {
      RenderSettings settings = settings_of(method, 2);
      settings.photons = 1000;
      const auto result = render_with_threads(scene, settings);
      EXPECT_EQ(result.film.at(1, 1).emitted, outside ? Rgb(1, 2, 3) : Rgb(0));
      // The pixel lies next to the axis of a 1 degree view: its depth is 2 / cos, within 2 (1/cos(0.5
      // degrees) - 1).
      EXPECT_NEAR(result.film.at(1, 1).depth, 2, 2 * 4e-5);
    }
  }
}

// A sample that meets glass continues by both rays. In every sample it reflects Fresnel's share of a light, 4
// % at right angles for eta = 1.5, and transmits the rest. The cosine of a 0.1 degree view and float rounding
// leave 1e-5.
TEST(Emitted, GlassReflectsAndTransmitsInEverySample) {
  Scene scene;
  const uint32_t black = add_material(scene, Lambertian{Rgb(0)}),
                 glass = add_material(scene, Dielectric{1.5f});
  make_light(scene, add_shape(scene, horizontal({0, 3, 0}, 1, 1, false, black)), {100, 0, 0});
  make_light(scene, add_shape(scene, horizontal({0, -1, 0}, 1, 1, true, black)), {0, 225, 0});
  add_shape(scene, horizontal({0, 0, 0}, 1, 1, true, glass));
  look_at(scene, {0, 2, 0}, {0, 0, 0}, {0, 0, 1}, 0.1f, 4, 4);
  finalize_scene(scene);
  for (const Method method : {Method::kRaytrace, Method::kMc}) {
    const auto result = render_with_threads(scene, settings_of(method, 1));
    for (int y = 0; y < 4; ++y)
      for (int x = 0; x < 4; ++x) {
        const Rgb seen = result.film.at(x, y).emitted;
        EXPECT_NEAR(seen.x, 4, 4e-5);
        EXPECT_NEAR(seen.y, 96, 96e-5);  // 225 in glass is 225 / eta^2 outside
      }
  }
}

// A convex Lambertian surface under a constant sky shows L = rho E / pi = rho L_sky; past it the camera sees
// the sky itself.
TEST(InfiniteLight, ConvexReceiverReflectsTheSky) {
  for (const Method method : {Method::kRaytrace, Method::kMc, Method::kPhoton}) {
    Scene scene;
    const uint32_t white = add_material(scene, Lambertian{Rgb(kReflectance)});
    add_shape(scene, sphere({0, 0, 0}, 1, white));
    InfiniteLight sky;
    sky.L = Rgb(2);
    scene.lights.push_back(sky);
    look_at(scene, {0, 0, 4}, {0, 0, 0}, {0, 1, 0}, 4, 8, 8);
    finalize_scene(scene);
    RenderSettings settings = settings_of(method, 64);
    settings.photons = 400'000;
    settings.radius = 0.2f;
    std::vector<double> means;
    for (settings.seed = 0; settings.seed < 6; ++settings.seed)
      means.push_back(total_mean(render_with_threads(scene, settings).film));
    const Estimate found = estimate_of(means);
    EXPECT_NEAR(found.mean, 1.0, 5 * found.standard_error + kPackedFluxError) << int(method);
    EXPECT_LT(found.standard_error, 0.02);
  }
}

}  // namespace
}  // namespace kaustik::render
