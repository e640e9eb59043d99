// Tests lights that emit images, portals, and very many lights: photons against paths, and both against
// closed forms.

#include <gtest/gtest.h>

#include "tests/render/support/class_agreement.h"
#include "tests/render/support/closed_forms.h"

namespace kaustik::render {
namespace {

using namespace test;

std::shared_ptr<const LightImage> image_of(int width, int height,
                                           const std::function<Rgb(int x, int y)>& colour) {
  LightImage image{width, height, {}};
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) image.pixels.push_back(colour(x, y));
  return std::make_shared<const LightImage>(std::move(image));
}

// A sky with a small sun at z; +y is up.
std::shared_ptr<const DirectionMap> sky_map() {
  const auto colour = [](int x, int y) {
    return x == 9 && y == 7 ? Rgb(90, 80, 60) : Rgb(0.3f, 0.4f + 0.02f * float(y), 0.6f);
  };
  return std::make_shared<const DirectionMap>(image_of(16, 16, colour), DirectionMap::Layout::kEqualArea);
}

// From the map's space to the world's: the map's +z is +y.
const glm::mat3 kUpright(1, 0, 0, 0, 0, -1, 0, 1, 0);

Scene floor_and_ball(const Light& light) {
  Scene scene;
  const uint32_t white = add_material(scene, Lambertian{Rgb(0.6f)});
  add_shape(scene, horizontal({0, 0, 0}, 1.5f, 1.5f, true, white));
  add_shape(scene, sphere({0.2f, 0.35f, 0.1f}, 0.35f, white));
  scene.lights.push_back(light);
  look_at(scene, {0.3f, 1.6f, 2.2f}, {0, 0.1f, 0}, {0, 1, 0}, 40, kSize, kSize);
  finalize_scene(scene);
  return scene;
}

void expect_photons_agree_with_paths(const Scene& scene, int spp, const std::string& name) {
  const auto by_paths = films(scene, settings_of(Method::kMc, spp, 0.1f, 100));
  const Comparison c(scene, by_paths, Method::kPhoton, 0.1f);
  c.expect_agreement_everywhere(Layer::kDirect);
  c.expect_agreement(Layer::kIndirect, -1, 0.5);  // little light in these scenes
  c.write_pictures(name);
}

TEST(ImageLights, PhotonsOfASkyAgreeWithPaths) {
  expect_photons_agree_with_paths(floor_and_ball(ImageInfiniteLight{sky_map(), kUpright, 1}), 128,
                                  "image_sky");
}

TEST(ImageLights, PhotonsOfAProjectorAgreeWithPaths) {
  const auto slide = image_of(3, 2, [](int x, int y) { return Rgb(1 + x, 2 * y, (x + y) % 2); });
  const Frame aim = Frame::from_z(glm::normalize(Vector3(0.1f, -1, -0.3f)));
  const ProjectionLight light{
      {-0.3f, 2, 0.5f}, glm::mat3(aim.x, aim.y, aim.z), std::make_shared<const ProjectedImage>(slide, 50), 2};
  expect_photons_agree_with_paths(floor_and_ball(light), 64, "projector");
}

TEST(ImageLights, PhotonsOfAGoniometricLightAgreeWithPaths) {
  const GoniometricLight light{{-0.3f, 1.5f, 0.5f}, kUpright, sky_map(), Rgb(1)};
  expect_photons_agree_with_paths(floor_and_ball(light), 64, "goniometric");
}

// The window is in the plane x = -1, and the sky on the side of -x.
PortalInfiniteLight window() {
  PortalInfiniteLight light;
  light.corner = {-1, 0.2f, -0.6f};
  light.along_x = {0, 0, 1.2f};
  light.along_y = {0, 0.8f, 0};
  light.to_world = glm::mat3(0, 0, 1, 0, 1, 0, -1, 0, 0);
  return light;
}

// A plate outside hides a part of the sky from the window.
Scene behind_a_window() {
  PortalInfiniteLight light = window();
  light.sky = std::make_shared<const PortalSky>(*sky_map(), glm::transpose(kUpright) * light.to_world);
  Scene scene = floor_and_ball(light);
  add_shape(scene, quad({-1.4f, -0.5f, 0}, {-1.4f, 2, 0}, {-1.4f, 2, 1.5f}, {-1.4f, -0.5f, 1.5f}, 0));
  finalize_scene(scene);
  return scene;
}

TEST(ImageLights, PhotonsThroughAPortalAgreeWithPaths) {
  expect_photons_agree_with_paths(behind_a_window(), 128, "portal");
}

// E = L times the projected solid angle of the window, by Lambert's formula.
TEST(ImageLights, ConstantSkyThroughAPortalMatchesLambertsFormula) {
  const Point3 seen(0.3f, 0, 0.1f);
  for (const Method method : {Method::kRaytrace, Method::kMc}) {
    Scene scene;
    const uint32_t white = add_material(scene, Lambertian{Rgb(0.5f)});
    add_shape(scene, horizontal({0, 0, 0}, 4, 4, true, white));
    PortalInfiniteLight light = window();
    light.sky = std::make_shared<const PortalSky>(Rgb(2));
    scene.lights.push_back(light);
    look_at(scene, {2, 3, 1.5f}, seen, {0, 1, 0}, 0.001f, 8, 8);
    finalize_scene(scene);
    RenderSettings settings = settings_of(method, 256, 0.1f, 1);
    const Film film = render_with_threads(scene, settings).film;
    std::vector<double> pixels;
    for (int y = 0; y < 8; ++y)
      for (int x = 0; x < 8; ++x) pixels.push_back(double(film.at(x, y).direct.x));
    const std::vector<glm::dvec3> window = {{-1, 0.2, -0.6}, {-1, 0.2, 0.6}, {-1, 1.0, 0.6}, {-1, 1.0, -0.6}};
    const double expected = 0.5 / std::numbers::pi * lambert_polygon(window, glm::dvec3(seen), {0, 1, 0}, 2);
    const Estimate found = estimate_of(pixels);
    EXPECT_NEAR(found.mean, expected, 4 * found.standard_error + 3e-4 * expected);
    EXPECT_LT(found.standard_error, 0.01 * expected);
  }
}

// A projector straight above a plane lights a rectangle: E = I cos^3 / h^2 inside and zero outside.
TEST(ImageLights, ProjectorLightsARectangle) {
  const auto white_slide = image_of(2, 1, [](int, int) { return Rgb(5); });
  const double h = 1.5, half = h * std::tan(glm::radians(20.0));
  for (const auto& [x, z, lit] : {std::tuple(0.0, 0.0, true), std::tuple(1.9 * half, 0.9 * half, true),
                                  std::tuple(2.05 * half, 0.0, false), std::tuple(0.0, 1.05 * half, false)}) {
    Scene scene;
    const uint32_t white = add_material(scene, Lambertian{Rgb(0.5f)});
    add_shape(scene, horizontal({0, 0, 0}, 4, 4, true, white));
    scene.lights.push_back(ProjectionLight{{0, float(h), 0},
                                           glm::mat3(1, 0, 0, 0, 0, -1, 0, -1, 0),
                                           std::make_shared<const ProjectedImage>(white_slide, 40),
                                           1});
    look_at(scene, {2, 3, 1.5f}, Point3(glm::dvec3(x, 0, z)), {0, 1, 0}, 0.001f, 8, 8);
    finalize_scene(scene);
    const Film film = render_with_threads(scene, settings_of(Method::kRaytrace, 2, 0.1f, 1)).film;
    const double d2 = h * h + x * x + z * z;
    const double expected = lit ? 0.5 / std::numbers::pi * 5 * h / std::pow(d2, 1.5) : 0;
    EXPECT_NEAR(total_mean(film), expected, 3e-4 * expected);
  }
}

// A hall whose ceiling holds columns x rows small square lights of different colours and powers.
Scene hall(int columns, int rows) {
  Scene scene;
  const uint32_t white = add_material(scene, Lambertian{Rgb(0.6f)});
  const uint32_t black = add_material(scene, Lambertian{Rgb(0)});
  add_shape(scene, horizontal({0, 0, 0}, 1, 5, true, white));
  add_shape(scene, horizontal({0, 1.2f, 0}, 1, 5, false, white));
  add_shape(scene, sphere({0.2f, 0.35f, 2.5f}, 0.35f, white));
  const float half = 0.2f / float(columns);
  for (int j = 0; j < rows; ++j)
    for (int i = 0; i < columns; ++i) {
      const Point3 at(2 * (float(i) + 0.5f) / float(columns) - 1, 1.19f,
                      10 * (float(j) + 0.5f) / float(rows) - 5);
      const float L = 200.0f * float(1 + (i * 7 + j * 3) % 5);
      make_light(scene, add_shape(scene, horizontal(at, half, half, false, black)), {L, 0.8f * L, 0.5f * L});
    }
  look_at(scene, {0, 0.6f, 4.8f}, {0, 0.3f, 0}, {0, 1, 0}, 50, kSize, kSize);
  finalize_scene(scene);
  return scene;
}

TEST(ManyLights, PhotonsOfTenThousandAgreeWithPaths) {
  const Scene scene = hall(40, 250);
  ASSERT_EQ(scene.lights.size(), 10'000u);
  expect_photons_agree_with_paths(scene, 256, "many_lights");
}

// The mean over the pixels of the variance of the first channel over seeds.
double mean_variance(const std::vector<Film>& of) {
  double sum = 0;
  for (int y = 0; y < kSize; ++y)
    for (int x = 0; x < kSize; ++x) {
      std::vector<double> values;
      for (const Film& film : of) values.push_back(double(film.at(x, y).direct.x));
      sum += std::pow(estimate_of(values).standard_error, 2);
    }
  return sum / (kSize * kSize);
}

// Lights are chosen by the tree, for light samples alone, and for light samples beside BSDF samples, which
// must use the same probabilities.
TEST(ManyLights, SharedAndUnsharedShadowRaysAgree) {
  const Scene scene = hall(4, 25);
  const auto alone = films(scene, settings_of(Method::kRaytrace, 256, 0.1f, 1));
  const auto shared = films(scene, settings_of(Method::kMc, 256, 0.1f, 50));
  for (int block = -1; block < kSize / kBlock * (kSize / kBlock); ++block) {
    const Estimate a = block_estimate(alone, Layer::kDirect, block),
                   b = block_estimate(shared, Layer::kDirect, block);
    EXPECT_NEAR(a.mean, b.mean, kErrors * std::hypot(a.standard_error, b.standard_error)) << block;
  }
}

// If lights are chosen by power alone the variance of a pixel is larger.
TEST(ManyLights, TheTreeFindsThoseThatMatter) {
  Scene scene = hall(10, 400);
  const auto by_tree = films(scene, settings_of(Method::kRaytrace, 64, 0.1f, 1));
  scene.light_sampler = LightSampler(scene.lights, scene.lights.size());
  const auto by_power = films(scene, settings_of(Method::kRaytrace, 64, 0.1f, 1));
  EXPECT_LT(2 * mean_variance(by_tree), mean_variance(by_power));
}

// Any number of threads gives the same bits.
TEST(ManyLights, AnyNumberOfThreadsGivesTheSameBits) {
  const Scene scene = hall(4, 25);
  for (const Method method : {Method::kMc, Method::kPhoton}) {
    RenderSettings settings = settings_of(method, 4, 0.1f, 1);
    settings.photons = 20'000;
    const Film one = render_with_threads(scene, settings, 1).film,
               three = render_with_threads(scene, settings, 3).film;
    for (int y = 0; y < kSize; ++y)
      for (int x = 0; x < kSize; ++x) ASSERT_EQ(one.at(x, y).radiance(), three.at(x, y).radiance());
  }
}

}  // namespace
}  // namespace kaustik::render
