// Tests what finalize_scene derives.

#include "core/scene/scene.h"
#include "core/spectrum/refractive_index.h"
#include "tests/support/shapes.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace kaustik {
namespace {

Scene two_spheres() {
  Scene scene;
  scene.shapes = {test::sphere({0, 0, 0}, 1), test::sphere({4, 0, 0}, 2)};
  scene.shapes[1].material = 1;
  scene.materials = {Lambertian{}, Mirror{}};
  scene.lights = {PointLight{}, InfiniteLight{}, DistantLight{}};
  return scene;
}

TEST(Scene, BoundsAndBoundingSphereHoldEveryShape) {
  Scene scene = two_spheres();
  finalize_scene(scene);
  EXPECT_LE(scene.bounds.min.x, -1);
  EXPECT_GE(scene.bounds.max.x, 6);
  EXPECT_EQ(scene.infinite_lights, std::vector<uint32_t>{1});
  const auto& light = std::get<InfiniteLight>(scene.lights[1]);
  EXPECT_EQ(light.scene_radius, std::get<DistantLight>(scene.lights[2]).scene_radius);
  for (const Point3& corner : {scene.bounds.min, scene.bounds.max}) {
    EXPECT_LE(glm::distance(corner, light.scene_center), light.scene_radius);
  }
  // The bounding box is 7 x 4 x 4.
  EXPECT_NEAR(light.scene_radius, 4.5, 1e-4);
  // Powers depend on the scene's bounding sphere: 4 pi, 4 pi^2 r^2, pi r^2.
  const double p0 = 4, p1 = 4 * std::numbers::pi * 4.5 * 4.5, p2 = 4.5 * 4.5;
  EXPECT_NEAR(scene.light_power.pdf(1), p1 / (p0 + p1 + p2), 1e-4);
}

TEST(Scene, NeedsFollowFromSurfacesAndLights) {
  Scene scene = two_spheres();
  finalize_scene(scene);
  EXPECT_TRUE(scene.needs.specular && scene.needs.diffuse && scene.needs.any_light &&
              scene.needs.infinite_light);
  EXPECT_FALSE(scene.needs.only_delta_lights);
  EXPECT_THAT(scene.needs.left_out(),
              ::testing::ElementsAre("no medium: space is empty", "no dispersion: all light is RGB"));

  scene.media = {Medium{}, Medium{Rgb(1)}};
  scene.shapes[0].media.inside = 1;
  finalize_scene(scene);
  EXPECT_TRUE(scene.needs.media);
  EXPECT_FALSE(scene.needs.scattering);
  EXPECT_THAT(scene.needs.left_out(), ::testing::ElementsAre("no medium that scatters light",
                                                             "no medium that emits light: only lights do",
                                                             "no dispersion: all light is RGB"));
  EXPECT_TRUE(scene.strongest_lights.empty());

  scene.media[1].Le = Rgb(0, 1, 0);
  finalize_scene(scene);
  EXPECT_TRUE(scene.needs.emissive_media);
  scene.shapes[0].media.inside = 2;
  scene.media.push_back(Medium{Rgb(1)});
  finalize_scene(scene);
  EXPECT_FALSE(scene.needs.emissive_media) << "nothing is filled by the one that emits";
  scene.shapes[0].media.inside = 1;

  scene.media[1].sigma_s = Rgb(0, 0, 1);
  finalize_scene(scene);
  EXPECT_TRUE(scene.needs.scattering);
  EXPECT_FALSE(scene.needs.dispersion);
  EXPECT_THAT(scene.needs.left_out(), ::testing::ElementsAre("no dispersion: all light is RGB"));

  const Material mirror = scene.materials[scene.shapes.back().material];
  scene.materials[scene.shapes.back().material] = Dielectric{};
  scene.materials[scene.shapes.back().material].disperse(
      std::make_shared<const Spectrum>(abbe_index(1.5, 60)));
  finalize_scene(scene);
  EXPECT_TRUE(scene.needs.dispersion);
  EXPECT_TRUE(scene.needs.left_out().empty());
  scene.materials[scene.shapes.back().material] = mirror;
  finalize_scene(scene);
  EXPECT_THAT(scene.strongest_lights, ::testing::Each(::testing::Lt(scene.lights.size())));

  scene.shapes.pop_back();  // no shape uses the mirror material now
  scene.lights = {PointLight{}};
  finalize_scene(scene);
  EXPECT_FALSE(scene.needs.specular);
  EXPECT_TRUE(scene.needs.only_delta_lights);
  EXPECT_THAT(scene.needs.left_out(), ::testing::Contains(::testing::HasSubstr("no caustic pass")));

  scene.lights.clear();
  finalize_scene(scene);
  EXPECT_FALSE(scene.needs.any_light);
  EXPECT_FALSE(scene.needs.only_delta_lights);
}

TEST(Scene, BlackSurfacesAreNotDiffuse) {
  Scene scene = two_spheres();
  scene.materials[0] = Lambertian{Rgb(0)};
  finalize_scene(scene);
  EXPECT_FALSE(scene.needs.diffuse);
  EXPECT_TRUE(scene.needs.specular);
  scene.materials[0] = Lambertian{Rgb(0, 0, 0.01f)};
  finalize_scene(scene);
  EXPECT_TRUE(scene.needs.diffuse);
}

TEST(Scene, EmptySceneIsFinite) {
  Scene scene;
  scene.lights = {InfiniteLight{}};
  finalize_scene(scene);
  EXPECT_TRUE(scene.bounds.empty());
  EXPECT_FALSE(
      std::get<InfiniteLight>(scene.lights[0]).sample_Le({0.5f, 0.5f}, {0.5f, 0.5f}, EmissionMode::kCosine));
  EXPECT_EQ(scene.light_power.pdf(0), 1);
}

}  // namespace
}  // namespace kaustik
