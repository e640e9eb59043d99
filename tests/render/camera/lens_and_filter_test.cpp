// Tests pictures through lenses and pixel filters against closed forms.

#include <gtest/gtest.h>

#include <glm/gtc/matrix_transform.hpp>

#include "tests/render/support/test_scenes.h"

namespace kaustik::test {
namespace {

constexpr int kSide = 64;

RenderSettings plain(int spp) {
  RenderSettings settings;
  settings.method = Method::kRaytrace;
  settings.spp = spp;
  return settings;
}

// A small bright disk at (0, 0, z) before a black sky, seen along +z.
Scene bright_disk(float z, float radius, const Projection& projection) {
  Scene scene;
  const uint32_t black = add_material(scene, Lambertian{{0, 0, 0}});
  Shape disk;
  disk.material = black;
  const glm::dmat4 m = glm::scale(glm::translate(glm::dmat4(1), glm::dvec3(0, 0, double(z))),
                                  glm::dvec3(double(radius), double(radius), -double(radius)));
  disk.geometry = Disk{Transform::from_matrix(m), 0};
  make_light(scene, add_shape(scene, std::move(disk)), {1, 1, 1});
  scene.camera.width = scene.camera.height = kSide;
  scene.camera.set_default_screen_window();
  scene.camera.projection = projection;
  finalize_scene(scene);
  return scene;
}

struct Blur {
  double light = 0;      // sum over the pixels
  double mean_r2 = 0;    // pixels^2, from the image's middle
  double farthest2 = 0;  // of the middles of lit pixels
};

Blur blur_of(const Film& film) {
  Blur blur;
  for (int y = 0; y < kSide; ++y)
    for (int x = 0; x < kSide; ++x) {
      const double L = double(film.at(x, y).radiance().x), dx = x + 0.5 - kSide / 2, dy = y + 0.5 - kSide / 2;
      blur.light += L;
      blur.mean_r2 += L * (dx * dx + dy * dy);
      if (L > 0) blur.farthest2 = std::max(blur.farthest2, dx * dx + dy * dy);
    }
  blur.mean_r2 /= blur.light;
  return blur;
}

// A point at z is seen as a disk of radius lens * |z - f| / z on the plane of focus, where a pixel measures 2
// f tan(fov / 2) / width. The disk is evenly bright, so its mean squared radius is half of its squared
// radius.
TEST(DepthOfField, PointShowsTheCircleOfConfusion) {
  constexpr float kLens = 0.2f, kFocal = 4, kDot = 0.02f;
  for (const float z : {2.0f, 8.0f}) {
    SCOPED_TRACE(z);
    const Film film =
        render_with_threads(bright_disk(z, kDot, PerspectiveProjection{40, {kLens, kFocal}}), plain(256))
            .film;
    const double pixel = 2 * double(kFocal) * std::tan(glm::radians(20.0)) / kSide;
    const double circle = double(kLens) * std::abs(double(z - kFocal)) / double(z) / pixel;
    const double dot = double(kDot) * double(kFocal) / double(z) / pixel;
    const Blur blur = blur_of(film);
    // Pixels add the variance of their own square, 1/12 per axis. About circle^2 pi * 256 dot^2 / circle^2
    // samples meet the dot, and r^2 / 2 has a spread of circle^2 / sqrt(12): a noise below 2 % of the value,
    // of which the tolerance is 5.
    const double met = std::numbers::pi * dot * dot * 256;
    EXPECT_NEAR(blur.mean_r2, 0.5 * (circle * circle + dot * dot) + 2 / 12.0,
                5 * circle * circle / std::sqrt(12 * met));
    EXPECT_LE(std::sqrt(blur.farthest2), circle + dot + std::sqrt(0.5));
    EXPECT_NEAR(blur.light, std::numbers::pi * dot * dot, 5 * blur.light / std::sqrt(met));
  }
}

TEST(DepthOfField, ObjectsInFocusAreSharp) {
  const Film film =
      render_with_threads(bright_disk(4, 0.2f, PerspectiveProjection{40, {0.5f, 4}}), plain(16)).film;
  const double pixel = 2 * 4 * std::tan(glm::radians(20.0)) / kSide;
  EXPECT_LE(std::sqrt(blur_of(film).farthest2), 0.2 / pixel + std::sqrt(0.5));
}

Scene with_filter(Scene scene, const FilterAxis& axis) {
  scene.camera.filter = PixelFilter(axis, axis);
  return scene;
}

std::vector<FilterAxis> filters() {
  return {{FilterKind::kTriangle, 2},
          {FilterKind::kGaussian, 1.5f},
          {FilterKind::kMitchell, 2},
          {FilterKind::kSinc, 4}};
}

// A uniform picture stays uniform through every filter, whatever the signs of its samples.
TEST(PixelFilters, UniformSkyStaysUniform) {
  for (const FilterAxis& axis : filters()) {
    Scene scene;
    const uint32_t black = add_material(scene, Lambertian{{0, 0, 0}});
    add_shape(scene, sphere({0, 0, -5}, 1, black));  // behind the camera
    InfiniteLight sky;
    sky.L = {0.25f, 1, 3};
    scene.lights.push_back(sky);
    scene.camera.width = scene.camera.height = 8;
    finalize_scene(scene);
    // With this many samples the weights of no pixel cancel.
    const Film film = render_with_threads(with_filter(scene, axis), plain(64)).film;
    for (int y = 0; y < 8; ++y)
      for (int x = 0; x < 8; ++x) ASSERT_EQ(film.at(x, y).radiance(), sky.L);
  }
}

// At a straight edge a pixel is the filter's integral up to the edge.
TEST(PixelFilters, EdgeShowsTheFiltersIntegral) {
  constexpr int kRows = 16, kSpp = 1024;
  for (const FilterAxis& axis : filters()) {
    Scene scene;
    const uint32_t black = add_material(scene, Lambertian{{0, 0, 0}});
    // The area below the image's middle line is bright.
    make_light(scene, add_shape(scene, quad({-9, -9, 5}, {-9, 0, 5}, {9, 0, 5}, {9, -9, 5}, black)),
               {1, 1, 1}, true);
    scene.camera.width = scene.camera.height = kRows;
    scene.camera.projection = OrthographicProjection{};
    finalize_scene(scene);
    const Film film = render_with_threads(with_filter(scene, axis), plain(kSpp)).film;
    for (int y = 2; y < kRows - 2; ++y) {
      double below = 0, whole = 0;
      for (int i = 0; i < 4096; ++i) {
        const double t = (2 * (i + 0.5) / 4096 - 1) * double(axis.radius), f = axis(t);
        whole += f;
        if (y + 0.5 + t > kRows / 2) below += f;
      }
      for (int x = 1; x < kRows - 1; ++x) {
        // The samples are stratified, so the error is below 1 / sqrt(kSpp) of a sample's spread, which sinc's
        // signs raise to 2.
        ASSERT_NEAR(film.at(x, y).radiance().x, below / whole, 2 / std::sqrt(double(kSpp))) << y;
      }
    }
  }
}

// Pixels do not depend on each other: a crop equals that part of the picture, in any number of passes.
TEST(PixelFilters, CropEqualsThatPartOfThePicture) {
  const Scene scene = with_filter(cornell(12), {FilterKind::kMitchell, 2});
  RenderSettings settings = plain(8);
  settings.passes = 2;
  const Film whole = render_with_threads(scene, settings).film;
  settings.crop = {3, 9, 5, 8};
  const Film part = render_with_threads(scene, settings, 1).film;
  for (int y = 5; y < 8; ++y)
    for (int x = 3; x < 9; ++x)
      ASSERT_EQ(part.at(x - 3, y - 5).radiance(), whole.at(x, y).radiance()) << x << " " << y;
}

}  // namespace
}  // namespace kaustik::test
