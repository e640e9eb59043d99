// Tests that photons and paths compute the same light from materials with diffuse lobes, specular lobes, or
// both.

#include <gtest/gtest.h>

#include "tests/core/support/bsdf_examples.h"
#include "tests/render/support/class_agreement.h"

namespace kaustik::render {
namespace {

using namespace test;

using kaustik::test::kCopperEta, kaustik::test::kCopperK;
constexpr std::array<Layer, 4> kLayers = {Layer::kEmitted, Layer::kDirect, Layer::kCaustic, Layer::kIndirect};

// A closed box with a light below its ceiling. A plate in its middle, lit from both sides, and a ball have
// the tested material.
Scene box_with(const Bsdf& bsdf) {
  Scene scene;
  const uint32_t white = add_material(scene, Lambertian{Rgb(0.6f)});
  const uint32_t black = add_material(scene, Lambertian{Rgb(0)});
  const uint32_t tested = add_material(scene, bsdf);
  add_shape(scene, horizontal({0, 0, 0}, 1, 1, true, white));
  add_shape(scene, horizontal({0, 2, 0}, 1, 1, false, white));
  add_shape(scene, quad({-1, 0, -1}, {1, 0, -1}, {1, 2, -1}, {-1, 2, -1}, white));
  add_shape(scene, quad({-1, 0, 1}, {-1, 2, 1}, {1, 2, 1}, {1, 0, 1}, white));
  add_shape(scene, quad({-1, 0, -1}, {-1, 2, -1}, {-1, 2, 1}, {-1, 0, 1}, white));
  add_shape(scene, quad({1, 0, -1}, {1, 0, 1}, {1, 2, 1}, {1, 2, -1}, white));
  add_shape(scene, horizontal({-0.3f, 0.9f, -0.2f}, 0.6f, 0.6f, true, tested));
  add_shape(scene, sphere({0.55f, 0.4f, 0.1f}, 0.35f, tested));
  make_light(scene, add_shape(scene, horizontal({0.2f, 1.9f, 0}, 0.5f, 0.5f, false, black)), Rgb(5));
  look_at(scene, {0, 1.5f, 0.95f}, {0, 0.6f, -0.2f}, {0, 1, 0}, 75, kSize, kSize);
  finalize_scene(scene);
  return scene;
}

struct Case {
  std::string name;
  Bsdf bsdf;
};
void PrintTo(const Case& c, std::ostream* out) {
  *out << c.name;
}

const Case kCases[] = {
    {"rough_conductor", Conductor{kCopperEta, kCopperK, {0.6f, 0.6f}}},
    {"glossy_conductor", Conductor{kCopperEta, kCopperK, {0.15f, 0.15f}}},
    {"rough_brushed_conductor", Conductor{kCopperEta, kCopperK, {0.7f, 0.2f}}},
    {"glossy_brushed_conductor", Conductor{kCopperEta, kCopperK, {0.05f, 0.5f}}},
    {"rough_dielectric", Dielectric{1.5f, {0.5f, 0.5f}}},
    {"glossy_dielectric", Dielectric{1.5f, {0.2f, 0.2f}}},
    {"thin_dielectric", ThinDielectric{1.5f}},
    {"tinted_dielectric", Dielectric{1.5f, {}, {Rgb(0.9f, 0.6f, 0.3f), Rgb(0.5f, 0.7f, 0.9f)}}},
    {"diffuse_transmission", DiffuseTransmission{Rgb(0.3f), Rgb(0.5f)}},
    {"coated_diffuse", CoatedDiffuse::from_reflectance(Rgb(0.7f), 1.5f)},
    {"glossy_coat", CoatedDiffuse::from_reflectance(Rgb(0.7f), 1.5f, {0.15f, 0.15f})},
    {"rough_coat", CoatedDiffuse::from_reflectance(Rgb(0.7f), 1.5f, {0.6f, 0.6f})},
};

// kCases, and the first example of each type of BSDF that has none among them.
std::vector<Case> all_cases() {
  std::vector<Case> cases(std::begin(kCases), std::end(kCases));
  for (const Bsdf& bsdf : kaustik::test::bsdf_examples()) {
    const auto is_same_type = [&](const Case& c) { return c.bsdf.index() == bsdf.index(); };
    if (std::ranges::none_of(cases, is_same_type)) cases.push_back({std::string(name_of(bsdf)), bsdf});
  }
  return cases;
}

class Materials : public ::testing::TestWithParam<Case> {};

// Some classes are small here. The sum must be precise, but they need not be.
constexpr double kAnyNoise = 1e9;

// Compares class by class, and the sum.
TEST_P(Materials, PhotonsAgreeWithPaths) {
  const Scene scene = box_with(GetParam().bsdf);
  const auto by_paths = films(scene, settings_of(Method::kMc, 128, 0.08f, 100));
  for (const Method method : {Method::kPhoton, Method::kAuto}) {
    const Comparison c(scene, by_paths, method, 0.08f);
    for (const Layer layer : kLayers) {
      if (block_estimate(c.mc, layer, -1).mean > 0) {
        c.expect_agreement(layer, -1, kAnyNoise);
      } else {
        EXPECT_EQ(block_estimate(c.photons, layer, -1).mean, 0);
      }
    }
    const Estimate mc = total(c.mc), found = total(c.photons), smaller = total(c.half);
    const double noise = std::hypot(mc.standard_error, found.standard_error, 2 * smaller.standard_error);
    const double bias = 2 * std::abs(found.mean - smaller.mean) + kPackedLight * mc.mean;
    EXPECT_NEAR(found.mean, mc.mean, kErrors * noise + bias) << int(method);
    EXPECT_LT(kErrors * noise + bias, 0.1 * mc.mean);
    c.write_pictures(GetParam().name + std::to_string(int(method)));
  }
}

TEST_P(Materials, SumDoesNotDependOnTheEstimators) {
  expect_the_same_sum_by_all_estimators(box_with(GetParam().bsdf), 0.08f);
}
INSTANTIATE_TEST_SUITE_P(All, Materials, ::testing::ValuesIn(all_cases()),
                         [](const auto& tested) { return tested.param.name; });

// At the threshold of roughness lobes turn from specular to diffuse, and the picture must not change. The two
// materials differ by 1e-3 in alpha. The density of a lobe of width alpha changes by 2e-3 at any direction,
// and the pictures by a few times that.
TEST(RoughnessThreshold, SumIsContinuous) {
  for (const Method method : {Method::kMc, Method::kPhoton, Method::kHybrid, Method::kAuto}) {
    Estimate sums[2][2];
    for (const int above : {0, 1}) {
      const float alpha = Ggx::kNarrowAlpha * (above ? 1.0005f : 0.9995f);
      const Scene scene = box_with(Conductor{kCopperEta, kCopperK, {alpha, alpha}});
      ASSERT_EQ(lobes(scene.materials[2].typical()).diffuse, bool(above));
      for (const int half : {0, 1}) {
        const float radius = half ? 0.04f : 0.08f;
        sums[above][half] =
            total(films(scene, settings_of(method, method == Method::kMc ? 128 : 32, radius, 7)));
      }
    }
    const double noise = std::hypot(sums[0][0].standard_error, sums[1][0].standard_error);
    double bias = 4e-3 * sums[0][0].mean;
    if (method != Method::kMc)
      for (const auto& [full, half] : sums) bias += 2 * std::abs(full.mean - half.mean);
    EXPECT_NEAR(sums[1][0].mean, sums[0][0].mean, kErrors * noise + bias) << int(method);
    EXPECT_LT(kErrors * noise + bias, 0.08 * sums[0][0].mean) << int(method);
  }
}

// A ray never meets a point light, yet its highlight shows in nearly smooth metal. By shadow rays both sides
// of the threshold are the same integral, without noise except for the sampling of the pixel.
TEST(RoughnessThreshold, PointLightsShowInGlossyMetal) {
  double sums[2];
  for (const int above : {0, 1}) {
    const float alpha = Ggx::kNarrowAlpha * (above ? 1.0005f : 0.9995f);
    Scene scene;
    const uint32_t metal = add_material(scene, Conductor{kCopperEta, kCopperK, {alpha, alpha}});
    add_shape(scene, horizontal({0, 0, 0}, 1, 1, true, metal));
    scene.lights.push_back(PointLight{{0, 1, -0.5f}, Rgb(1)});
    look_at(scene, {0, 1, 0.9f}, {0, 0, 0}, {0, 1, 0}, 40, 16, 16);
    finalize_scene(scene);
    const Film film = render_with_threads(scene, settings_of(Method::kRaytrace, 16, 0.1f, 1)).film;
    sums[above] = total_mean(film);
    EXPECT_GT(layer_mean(film, above ? Layer::kDirect : Layer::kEmitted), 0);
  }
  EXPECT_NEAR(sums[0], sums[1], 4e-3 * sums[1]);
}

}  // namespace
}  // namespace kaustik::render
