// Tests the benchmarks' SPPM rival in a closed furnace, where it must find Le / (1 - rho) everywhere: the
// benchmarks then compare times for the same light.

#include <gtest/gtest.h>

#include "benchmarks/sppm_rival/sppm.h"
#include "tests/render/support/image_statistics.h"

namespace kaustik::benchmarks {
namespace {

using namespace test;

constexpr float kRho = 0.5f;
constexpr double kExpected = 1 / (1 - double(kRho));

// The inside of a sphere, with a glass sphere and a perfect mirror sphere that do not touch it.
Scene furnace() {
  Scene scene;
  const uint32_t white = add_material(scene, Lambertian{Rgb(kRho)});
  make_light(scene, add_shape(scene, sphere({0, 0, 0}, 1, white, true)), Rgb(1));
  add_shape(scene, sphere({0.5f, 0.2f, 0.1f}, 0.2f, add_material(scene, Dielectric{1.5f})));
  add_shape(scene, sphere({0.3f, 0.4f, -0.4f}, 0.2f, add_material(scene, Mirror{Rgb(1)})));
  look_at(scene, {0.1f, -0.2f, 0.3f}, {1, 0.5f, 0}, {0, 1, 0}, 70, 16, 16);
  finalize_scene(scene);
  return scene;
}

double mean(const render::Image& image) {
  double sum = 0;
  for (const Rgb& c : image.pixels) sum += double(c.x) + double(c.y) + double(c.z);
  return sum / (3 * double(image.pixels.size()));
}

// Hachisuka's shrinking radius depends on earlier iterations only, and the cap of a sphere of chord r has the
// area pi r^2, so there is no bias. With eight seeds the tolerance is 5 standard errors of a t distribution
// with 7 degrees of freedom. The limit of 16 bounces is that of furnace_test.
TEST(SppmRival, FindsTheFurnacesRadiance) {
  const Scene scene = furnace();
  const accel::Bvh bvh(scene);
  std::vector<double> means;
  for (uint64_t seed = 0; seed < 8; ++seed)
    means.push_back(
        mean(sppm::Renderer(scene, bvh, {.iterations = 4, .photons = 20'000, .radius = 0.2f, .seed = seed})
                 .render()));
  const Estimate found = estimate_of(means);
  EXPECT_NEAR(found.mean, kExpected, 5 * found.standard_error + std::pow(0.5, 16) + 1e-3);
  EXPECT_LT(found.standard_error, 0.02);
}

// The radius of a pixel that counts photons shrinks by gamma at first, then as N' / (N + M).
TEST(SppmRival, RadiusFollowsThePhotons) {
  sppm::Pixel pixel;
  pixel.radius = 1;
  pixel.beta = Rgb(1);
  for (int i = 0; i < 3; ++i) pixel.add(Rgb(2));
  sppm::update(pixel);
  EXPECT_FLOAT_EQ(pixel.N, 2);
  EXPECT_FLOAT_EQ(pixel.radius * pixel.radius, 2.0f / 3);
  EXPECT_FLOAT_EQ(pixel.tau.x, 4);
  for (int i = 0; i < 6; ++i) pixel.add(Rgb(2));
  sppm::update(pixel);
  EXPECT_FLOAT_EQ(pixel.N, 6);
  EXPECT_FLOAT_EQ(pixel.radius * pixel.radius, 0.5f);
  EXPECT_FLOAT_EQ(pixel.tau.x, 12);
}

}  // namespace
}  // namespace kaustik::benchmarks
