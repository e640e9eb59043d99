// Tests closed furnaces: inside a surface of emission Le and reflectance rho the radiance is Le / (1 - rho)
// everywhere.

#include <gtest/gtest.h>

#include "tests/render/support/image_statistics.h"
#include "tests/support/packed_flux.h"

namespace kaustik::render {
namespace {

using namespace test;

constexpr float kRho = 0.5f;
constexpr double kExpected = 1 / (1 - double(kRho));
// Paths end after 16 scattering events, so the sum lacks rho^17 / (1 - rho).
const double kTruncated = std::pow(double(kRho), 17) / (1 - double(kRho));

void finish(Scene& scene) {
  look_at(scene, {0.1f, -0.2f, 0.3f}, {1, 0.5f, 0}, {0, 1, 0}, 70, 16, 16);
  finalize_scene(scene);
}

Scene sphere_furnace() {
  Scene scene;
  const uint32_t white = add_material(scene, Lambertian{Rgb(kRho)});
  make_light(scene, add_shape(scene, sphere({0, 0, 0}, 1, white, true)), Rgb(1));
  finish(scene);
  return scene;
}

// The furnace with a glass and a mirror sphere of reflectance one inside, which change nothing in
// equilibrium.
Scene furnace_with_glass() {
  Scene scene = sphere_furnace();
  const uint32_t glass = add_material(scene, Dielectric{1.5f});
  const uint32_t mirror = add_material(scene, Mirror{Rgb(1)});
  add_shape(scene, sphere({0.5f, 0.2f, 0.1f}, 0.2f, glass));
  add_shape(scene, sphere({0.3f, 0.4f, -0.4f}, 0.2f, mirror));
  finish(scene);
  return scene;
}

Estimate furnace_mean(const Scene& scene, Method method) {
  RenderSettings settings;
  settings.method = method;
  settings.spp = 16;
  settings.photons = 100'000;
  settings.radius = 0.2f;
  std::vector<double> means;
  for (settings.seed = 0; settings.seed < 8; ++settings.seed) {
    const auto result = render_with_threads(scene, settings);
    means.push_back(total_mean(result.film));
    EXPECT_EQ(result.statistics.dropped_samples, 0u);
  }
  return estimate_of(means);
}

class Furnace : public ::testing::TestWithParam<Method> {};

// A sphere's cap of chord r has exactly the area pi r^2, so the photon estimate has no kernel bias here; only
// the rounding of packed fluxes remains. With eight seeds the tolerance is 5 standard errors of a t
// distribution with 7 degrees of freedom.
TEST_P(Furnace, SphereHasRadianceLeOverOneMinusRho) {
  const Estimate found = furnace_mean(sphere_furnace(), GetParam());
  EXPECT_NEAR(found.mean, kExpected, 5 * found.standard_error + kTruncated + kExpected * kPackedFluxError);
  EXPECT_LT(found.standard_error, 0.01);
}

// Glass and mirror do not touch the wall, so they cut no photon discs.
TEST_P(Furnace, GlassAndMirrorChangeNothing) {
  const Estimate found = furnace_mean(furnace_with_glass(), GetParam());
  // Specular events count towards the limit, too. Only rays whose Fresnel reflectance exceeds 0.9 stay in a
  // glass sphere for long: beyond 85 degrees, cos^2(85) = 0.8 % of those that meet the spheres, which fill
  // less than 10 % of the view from any wall point. What the limit of 16 cuts off there is below 1e-3.
  EXPECT_NEAR(found.mean, kExpected,
              5 * found.standard_error + kTruncated + kExpected * kPackedFluxError + 1e-3);
  EXPECT_LT(found.standard_error, 0.02);
}
// A hollow ball of transmitting material under a sky of radiance 1: its photons lie on the inside, and the
// nearest photons with the outside's normal are on the far wall. Inside and outside L = rho + rho L.
TEST(TransmittingFurnace, RadiusIsChosenOnTheSideOfThePhotons) {
  constexpr double kShare = 0.4;
  Scene scene;
  const Rgb share{static_cast<float>(kShare)};
  add_shape(scene, sphere({0, 0, 0}, 1, add_material(scene, DiffuseTransmission{share, share})));
  scene.lights.push_back(InfiniteLight{Rgb(1)});
  look_at(scene, {0, 0, 5}, {0, 0, 0}, {0, 1, 0}, 10, 8, 8);
  finalize_scene(scene);
  RenderSettings settings;
  settings.method = Method::kPhoton;
  settings.photons = 100'000;
  std::vector<double> means;
  for (settings.seed = 0; settings.seed < 8; ++settings.seed)
    means.push_back(total_mean(render_with_threads(scene, settings).film));
  const Estimate found = estimate_of(means);
  const double expected = kShare / (1 - kShare);
  EXPECT_NEAR(found.mean, expected, 5 * found.standard_error + expected * kPackedFluxError);
  EXPECT_LT(found.standard_error, 0.02 * expected);
}

INSTANTIATE_TEST_SUITE_P(Methods, Furnace, ::testing::Values(Method::kMc, Method::kHybrid, Method::kPhoton));

}  // namespace
}  // namespace kaustik::render
