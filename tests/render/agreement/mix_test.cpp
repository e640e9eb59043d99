// Tests that a mixture is the mean of its materials.

#include <gtest/gtest.h>

#include "tests/render/support/class_agreement.h"

namespace kaustik::render {
namespace {

using namespace test;

// Material 2 is the mixture of 0 and 1.
void add_mixture(Scene& scene, const Bsdf& first, const Bsdf& second, float amount) {
  const uint32_t a = add_material(scene, first), b = add_material(scene, second);
  Lobes parts = lobes(first);
  parts.diffuse |= lobes(second).diffuse;
  parts.specular |= lobes(second).specular;
  parts.glossy &= lobes(second).glossy;
  scene.materials.push_back(Material(MixedMaterial{a, b, amount, parts}, first));
  scene.material_names.push_back("mixture");
}

Scene plane_under_point_light(float scale = 1) {
  Scene scene;
  add_mixture(scene, Lambertian{Rgb(0.8f)}, Lambertian{Rgb(0)}, 0.25f);
  Shape floor = horizontal({0, 0, 0}, scale, scale, true, 2);
  add_shape(scene, std::move(floor));
  scene.lights.push_back(PointLight{{0, scale, 0}, Rgb(scale * scale)});
  look_at(scene, {0, scale, 0.9f * scale}, {0, 0, 0}, {0, 1, 0}, 40, kSize, kSize);
  finalize_scene(scene);
  return scene;
}

TEST(Mix, DirectLightIsTheMeanOfTheMaterials) {
  Scene mixed = plane_under_point_light(), plain = plane_under_point_light();
  plain.materials[2] = Lambertian{Rgb(0.6f)};
  const RenderSettings settings = settings_of(Method::kRaytrace, 64, 0.1f, 1);
  const double found = total_mean(render_with_threads(mixed, settings).film);
  const double expected = total_mean(render_with_threads(plain, settings).film);
  // A share of 0.75 of n samples has the relative standard deviation sqrt(1 / (3 n)), and the light varies by
  // less than a factor of 2 over the picture. The tolerance is five standard deviations.
  const double n = 64.0 * kSize * kSize;
  EXPECT_NEAR(found, expected, 5 * 2 * std::sqrt(1 / (3 * n)) * expected);
}

// The choice depends on the mantissas of the position only.
TEST(Mix, PowersOfTwoGiveTheSamePicture) {
  const RenderSettings settings = settings_of(Method::kRaytrace, 4, 0.1f, 1);
  const Film one = render_with_threads(plane_under_point_light(), settings).film;
  const Film large = render_with_threads(plane_under_point_light(0x1p9f), settings).film;
  for (int y = 0; y < kSize; ++y)
    for (int x = 0; x < kSize; ++x) ASSERT_EQ(one.at(x, y).direct, large.at(x, y).direct);
}

// With mirror and paint at one place, photons are kept wherever paint can be chosen, and gathered where it is
// chosen.
TEST(Mix, PhotonsAgreeWithPaths) {
  Scene scene;
  add_mixture(scene, Lambertian{Rgb(0.7f)}, Mirror{Rgb(0.8f)}, 0.4f);
  const uint32_t white = add_material(scene, Lambertian{Rgb(0.6f)});
  const uint32_t black = add_material(scene, Lambertian{Rgb(0)});
  add_shape(scene, horizontal({0, 0, 0}, 1, 1, true, 2));
  add_shape(scene, quad({-1, 0, -1}, {1, 0, -1}, {1, 2, -1}, {-1, 2, -1}, white));
  add_shape(scene, sphere({0.3f, 0.4f, 0.1f}, 0.35f, 2));
  make_light(scene, add_shape(scene, horizontal({0.2f, 1.9f, 0}, 0.5f, 0.5f, false, black)), Rgb(5));
  look_at(scene, {0, 1.2f, 1.8f}, {0, 0.5f, -0.2f}, {0, 1, 0}, 60, kSize, kSize);
  finalize_scene(scene);
  const auto by_paths = films(scene, settings_of(Method::kMc, 128, 0.08f, 100));
  for (const Method method : {Method::kPhoton, Method::kHybrid, Method::kAuto}) {
    const Comparison c(scene, by_paths, method, 0.08f);
    for (const Layer layer : {Layer::kEmitted, Layer::kDirect, Layer::kCaustic, Layer::kIndirect})
      c.expect_agreement(layer, -1,
                         layer == Layer::kEmitted ? 10 : 0.3);  // the light is small in the picture
  }
}

}  // namespace
}  // namespace kaustik::render
