// Tests media that absorb, against Beer and Lambert's law and against paths.

#include <gtest/gtest.h>

#include "tests/render/support/class_agreement.h"
#include "tests/render/support/closed_forms.h"
#include "tests/render/support/media_scenes.h"

namespace kaustik::render {
namespace {

using namespace test;

const Rgb kSigma(0.125f, 0.5f, 2);

RenderSettings quick(Method method) {
  RenderSettings settings;
  settings.method = method;
  settings.spp = 4;
  return settings;
}

// A box of the medium whose surfaces neither reflect nor bend, 0.7 m deep, in front of a lamp that fills the
// view: what the camera sees is the lamp's radiance times exp(-0.7 sigma), without noise. column: 0.7 m times
// the mean density.
void expect_share_behind_slab(const Medium& medium, float column, Method method) {
  Scene scene;
  const uint32_t black = add_material(scene, Lambertian{Rgb(0)});
  const uint32_t clear = add_material(scene, Dielectric{1});
  const MediumIndex inside = add_medium(scene, medium);
  add_shape(scene, horizontal({0, 1, 0}, 1, 1, true, clear)).media = {inside, kVacuum};
  add_shape(scene, horizontal({0, 0.3f, 0}, 1, 1, false, clear)).media = {inside, kVacuum};
  make_light(scene, add_shape(scene, horizontal({0, 0, 0}, 1, 1, true, black)), Rgb(1, 2, 3));
  look_at(scene, {0, 3, 0}, {0, 0, 0}, {0, 0, 1}, 0.001f, 4, 4);
  finalize_scene(scene);
  const auto result = render_with_threads(scene, quick(method));
  const Rgb expected = Rgb(1, 2, 3) * transmittance(medium, column);
  // Rays start up to 5e-6 m off the surface that they leave, times sigma and the density, which is 1.5 there.
  for (int c = 0; c < 3; ++c)
    EXPECT_NEAR(result.film.at(1, 2).emitted[c], expected[c],
                5e-6 * double(kSigma[c]) * 1.5 * double(expected[c]) + 1e-6)
        << c;
  EXPECT_EQ(result.film.at(1, 2).media_direct, Rgb(0));
  write_if_failed(result.film, "slab_of_medium");
}

class SlabOfMedium : public ::testing::TestWithParam<Method> {};

TEST_P(SlabOfMedium, LeavesBeerAndLambertsShare) {
  expect_share_behind_slab({kSigma}, 0.7f, GetParam());
}

// A density of 0.5 + y, which interpolation does not change: its integral from 0.3 to 1 is 0.805.
TEST_P(SlabOfMedium, LeavesItWhereTheDensityChanges) {
  const auto density =
      grid_of({3, 13, 3}, {-3, 0, -3}, {3, 1.3, 3}, [](const glm::dvec3& p) { return 0.5 + p.y; });
  expect_share_behind_slab({kSigma, Rgb(0), 0, density}, 0.805f, GetParam());
}
INSTANTIATE_TEST_SUITE_P(Methods, SlabOfMedium,
                         ::testing::Values(Method::kRaytrace, Method::kMc, Method::kPhoton, Method::kAuto));

// A point light over a plane, seen at one place, by which its light passes sqrt(1 + kRho2) to the plane and
// kToEye to the camera. The footprint of the view changes both by less than 1e-4 of themselves.
const Point3 kEye(2, 3, 1.5f), kSeen(0.5f, 0, 0.25f);
const double kRho2 = 0.5 * 0.5 + 0.25 * 0.25, kToEye = double(glm::distance(kEye, kSeen));

Scene lamp_over_plane() {
  Scene scene;
  add_shape(scene, horizontal({0, 0, 0}, 4, 4, true, add_material(scene, Lambertian{Rgb(0.5f)})));
  scene.lights.push_back(PointLight{{0, 1, 0}, Rgb(3)});
  look_at(scene, kEye, kSeen, {0, 1, 0}, 0.001f, 4, 4);
  return scene;
}

// Renders it and expects its direct light to be absorbed along `way` metres of the medium kSigma.
void expect_absorbed(const Scene& scene, Method method, double way) {
  const auto result = render_with_threads(scene, quick(method));
  const double clear = 0.5 * PointLightOverPlane{3, 1}.irradiance(kRho2) / double(kPi);
  for (int c = 0; c < 3; ++c) {
    const double depth = double(kSigma[c]) * way, expected = clear * std::exp(-depth);
    EXPECT_NEAR(double(result.film.at(1, 2).direct[c]), expected, expected * 1e-4 * (3 + depth)) << c;
  }
}

// Everything lies in one medium.
class PlaneInMedium : public ::testing::TestWithParam<Method> {};

TEST_P(PlaneInMedium, LightIsAbsorbedOnBothWays) {
  Scene scene = lamp_over_plane();
  fill(scene, kSigma);
  expect_absorbed(scene, GetParam(), std::sqrt(1 + kRho2) + kToEye);
}
INSTANTIATE_TEST_SUITE_P(Methods, PlaneInMedium,
                         ::testing::Values(Method::kRaytrace, Method::kMc, Method::kAuto));

// A slab of the medium between light and plane whose surfaces are not there: they block no light, and take
// what the medium absorbs on both ways.
class SlabBehindInterfaces : public ::testing::TestWithParam<Method> {};

TEST_P(SlabBehindInterfaces, TakesItsShareOfDirectLight) {
  Scene scene = lamp_over_plane();
  const MediumIndex inside = add_medium(scene, kSigma);
  add_interface(scene, horizontal({0, 0.7f, 0}, 5, 5, true, 0), {inside, kVacuum});
  add_interface(scene, horizontal({0, 0.3f, 0}, 5, 5, false, 0), {inside, kVacuum});
  finalize_scene(scene);
  // The slab is 0.4 m high, the lamp 1 m up and the camera 3 m.
  expect_absorbed(scene, GetParam(), 0.4 * (std::sqrt(1 + kRho2) + kToEye / 3));
}
INSTANTIATE_TEST_SUITE_P(Methods, SlabBehindInterfaces,
                         ::testing::Values(Method::kRaytrace, Method::kMc, Method::kAuto));

TEST(MediaAgreement, SmokeAgreesWithPaths) {
  Scene scene = cornell(kSize);
  add_smoke(scene, Rgb(0));
  const auto by_paths = films(scene, settings_of(Method::kMc, 256, 0.1f, 100));
  for (const Method method : {Method::kPhoton, Method::kAuto}) {
    const Comparison c(scene, by_paths, method, 0.1f);
    for (const Layer layer : {Layer::kDirect, Layer::kIndirect}) c.expect_agreement_everywhere(layer);
    c.write_pictures("smoke_" + std::to_string(int(method)));
  }
}

TEST(MediaAgreement, EachClassAgreesWithPaths) {
  const Scene scene = coloured_cornell(kSize);
  const auto by_paths = films(scene, settings_of(Method::kMc, 256, 0.1f, 100));
  for (const Method method : {Method::kPhoton, Method::kAuto}) {
    const Comparison c(scene, by_paths, method, 0.1f);
    for (const Layer layer : {Layer::kDirect, Layer::kIndirect, Layer::kMediaDirect, Layer::kMediaIndirect})
      c.expect_agreement_everywhere(layer);
    for (int block = -1; block < kSize / kBlock * (kSize / kBlock); ++block)
      c.expect_agreement(Layer::kCaustic, block, 1.0 / 3);
    c.write_pictures("coloured_cornell_" + std::to_string(int(method)));
  }
}

// What reflects leaves light in its medium, whichever way round it is: walls whose inside is vacuum, too.
TEST(MediaAgreement, OpaqueSurfacesDoNotChangeTheMedium) {
  const RenderSettings settings = settings_of(Method::kAuto, 4, 0.1f, 1);
  Scene scene = cornell(kSize);
  fill(scene, Rgb(0.3f), Rgb(0.2f));
  const Film same = render_with_threads(scene, settings).film;
  for (Shape& shape : scene.shapes)
    if (!std::holds_alternative<Dielectric>(scene.materials[shape.material].typical()))
      shape.media = {kVacuum, scene.camera_medium};
  finalize_scene(scene);
  const Film walled = render_with_threads(scene, settings).film;
  for (int y = 0; y < kSize; ++y)
    for (int x = 0; x < kSize; ++x) EXPECT_EQ(same.at(x, y).radiance(), walled.at(x, y).radiance());
}

// Light from infinitely far is absorbed by a medium that fills all space, except for what it does not absorb
// at all: by paths and by photons.
TEST(MediaAgreement, SunsAreAbsorbedOnTheirInfiniteWay) {
  for (const Method method : {Method::kMc, Method::kPhoton}) {
    Scene scene;
    add_shape(scene, horizontal({0, 0, 0}, 1, 1, true, add_material(scene, Lambertian{Rgb(0.5f)})));
    scene.lights.push_back(DistantLight{{0, 1, 0}, Rgb(3)});
    look_at(scene, {0.2f, 2, 0.1f}, {0, 0, 0}, {0, 0, 1}, 10, 8, 8);
    fill(scene, Rgb(0, 1e-3f, 1));
    RenderSettings settings = quick(method);
    settings.photons = 20'000;
    const auto result = render_with_threads(scene, settings);
    for (int y = 0; y < 8; ++y)
      for (int x = 0; x < 8; ++x) {
        const Rgb& direct = result.film.at(x, y).direct;
        EXPECT_GT(direct.x, 0);
        EXPECT_EQ(direct.y, 0);
        EXPECT_EQ(direct.z, 0);
      }
  }
}

// A sun that is declared in the fog of a ball shines from outside of it: its light is absorbed from where the
// ball begins, by paths and by photons.
TEST(MediaAgreement, SunsMeetAMediumWhereItBegins) {
  constexpr float kRadius = 0.5f;
  Scene scene;
  add_shape(scene, horizontal({0, 0, 0}, 1, 1, true, add_material(scene, Lambertian{Rgb(0.5f)})));
  scene.lights.push_back(DistantLight{{0, 1, 0}, Rgb(3)});
  look_at(scene, {0.2f, 2, 0.1f}, {0, 0, 0}, {0, 0, 1}, 20, kSize, kSize);
  fill(scene, Rgb(0.1f), Rgb(0.1f));
  add_interface(scene, sphere({0, 0, 0}, 3, 0), {scene.camera_medium, kVacuum});
  finalize_scene(scene);
  const auto by_paths = films(scene, settings_of(Method::kMc, 64, kRadius, 100));
  for (const Method method : {Method::kPhoton, Method::kAuto}) {
    const Comparison c(scene, by_paths, method, kRadius);
    for (const Layer layer : {Layer::kDirect, Layer::kMediaDirect}) c.expect_agreement_everywhere(layer);
    for (const Layer layer : {Layer::kIndirect, Layer::kMediaIndirect}) c.expect_agreement(layer, -1, 0.5);
  }
}

// Light is lost, unlike in the same box without media.
TEST(MediaAgreement, MediaDarkenTheBox) {
  const RenderSettings settings = settings_of(Method::kPhoton, 16, 0.1f, 1);
  const double with = total_mean(render_with_threads(coloured_cornell(kSize), settings).film);
  const double without = total_mean(render_with_threads(cornell(kSize), settings).film);
  // Light passes at least 1 m on its way, and 10 m are little: exp(-0.2 * 1) and exp(-0.1 * 10).
  EXPECT_LT(with, 0.9 * without);
  EXPECT_GT(with, 0.3 * without);
}

}  // namespace
}  // namespace kaustik::render
