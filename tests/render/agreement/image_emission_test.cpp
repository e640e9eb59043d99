// Tests that photons and paths give the same light from area lights that show images, lights with holes, and
// hidden lights.

#include <cstring>

#include "tests/render/support/class_agreement.h"
#include "tests/render/support/textured_scenes.h"

namespace kaustik::render {
namespace {

using namespace test;

// 4 x 3 pixels: dark except for a bright red, a green and two grey ones.
void write_screen() {
  std::vector<uint8_t> bytes(4 * 3 * 3, 8);
  const auto set = [&](size_t x, size_t y, std::array<uint8_t, 3> c) {
    for (size_t k = 0; k < 3; ++k) bytes[(y * 4 + x) * 3 + k] = c[k];
  };
  set(3, 0, {255, 40, 20});
  set(0, 2, {30, 220, 60});
  set(1, 1, {150, 150, 150});
  set(2, 2, {90, 90, 110});
  write_png("screen.png", 4, 3, bytes);
  write_png("holes.png", 2, 1, {0, 255});
}

std::string in_metres(double s, std::initializer_list<double> numbers) {
  std::string text;
  for (const double x : numbers) text += fmt::format("{} ", x * s);
  return text;
}

constexpr const char* kScreen =
    "AreaLightSource \"diffuse\" \"string filename\" \"screen.png\" \"float scale\" 40\n";

// A room, in metres times s, with a screen on its back wall, a ball, and the shapes in `more`.
std::string room(double s, const std::string& screen, const std::string& on_screen = "",
                 const std::string& more = "") {
  const auto p = [s](std::initializer_list<double> numbers) { return in_metres(s, numbers); };
  return "LookAt " + p({0, 1, 2.4, 0, 0.7, 0}) + " 0 1 0 Camera \"perspective\" \"float fov\" 60\n" +
         fmt::format("Film \"rgb\" \"integer xresolution\" {0} \"integer yresolution\" {0}\nWorldBegin\n",
                     kSize) +
         "Texture \"holes\" \"float\" \"imagemap\" \"string filename\" \"holes.png\" \"string filter\" "
         "\"point\" "
         "\"string encoding\" \"linear\"\n"
         "Material \"diffuse\" \"rgb reflectance\" [0.6 0.6 0.6]\n" +
         rectangle(p({-1, 0, 1.4, 1, 0, 1.4, 1, 0, -1, -1, 0, -1})) +
         rectangle(p({-1, 0, -1, 1, 0, -1, 1, 2, -1, -1, 2, -1})) +
         rectangle(p({-1, 2, -1, 1, 2, -1, 1, 2, 1.4, -1, 2, 1.4})) + "AttributeBegin Translate " +
         p({0.4, 0.3, 0.2}) + fmt::format("Shape \"sphere\" \"float radius\" {} AttributeEnd\n", 0.3 * s) +
         more + "AttributeBegin " + screen + "Material \"diffuse\" \"rgb reflectance\" [0.1 0.1 0.1]\n" +
         rectangle(p({-0.7, 0.5, -0.98, 0.5, 0.5, -0.98, 0.5, 1.4, -0.98, -0.7, 1.4, -0.98}), on_screen) +
         "AttributeEnd\n";
}

std::string with_glass(double s) {
  return "AttributeBegin Material \"dielectric\" Translate " + in_metres(s, {-0.4, 0.35, 0.1}) +
         fmt::format("Shape \"sphere\" \"float radius\" {} AttributeEnd\n", 0.35 * s);
}
// A ball that shows the same image and glows.
std::string with_ball() {
  return std::string("AttributeBegin ") + kScreen +
         "Translate -0.5 1.5 0 Shape \"sphere\" \"float radius\" 0.15 \"float zmax\" 0.1 AttributeEnd\n";
}

void expect_photons_agree_with_paths(const std::string& text, const std::string& name) {
  write_screen();
  const Scene scene = scene_of(text);
  const auto by_paths = films(scene, settings_of(Method::kMc, 256, 0.1f, 100));
  const Comparison c(scene, by_paths, Method::kPhoton, 0.1f);
  for (const Layer layer : kClasses)
    if (block_estimate(by_paths, layer, -1).mean > 0) c.expect_agreement(layer, -1, 0.5);
  c.write_pictures(name);
}

TEST(EmissionImages, PhotonsOfAScreenAgreeWithPaths) {
  expect_photons_agree_with_paths(room(1, kScreen, "", with_glass(1)), "screen");
}
TEST(EmissionImages, PhotonsOfABallAgreeWithPaths) {
  expect_photons_agree_with_paths(room(1, kScreen, "", with_ball()), "glowing_ball");
}
TEST(EmissionImages, PhotonsOfALightWithHolesAgreeWithPaths) {
  const std::string plain = "AreaLightSource \"diffuse\" \"rgb L\" [8 4 2]\n";
  expect_photons_agree_with_paths(room(1, plain, "\"texture alpha\" \"holes\"", with_glass(1)), "holes");
}

TEST(EmissionImages, SumDoesNotDependOnTheEstimators) {
  write_screen();
  expect_the_same_sum_by_all_estimators(scene_of(room(1, kScreen, "", with_glass(1))), 0.1f);
}
TEST(LightsWithAlpha, SumDoesNotDependOnTheEstimators) {
  write_screen();
  expect_the_same_sum_by_all_estimators(
      scene_of(room(1, kScreen, "\"texture alpha\" \"holes\"", with_glass(1))), 0.1f);
}
// There is no glass here: paths behind glass cannot meet a hidden light, as they cannot meet a point light.
TEST(HiddenLights, SumDoesNotDependOnTheEstimators) {
  write_screen();
  expect_the_same_sum_by_all_estimators(scene_of(room(1, kScreen, "\"float alpha\" 0")), 0.1f);
}

// The camera looks at the screen straight on: uv (0, 0) is the lower left corner, in the image's last row. A
// pixel of the picture is a twelfth of the screen, and the centre of every third one is the centre of a pixel
// of the image.
TEST(EmissionImages, ShowTheirImageUpright) {
  write_screen();
  const Scene scene = scene_of(std::string(R"(Scale -1 1 1 LookAt 0 0 1  0 0 0  0 1 0
    Camera "orthographic" "float screenwindow" [-2 2 -1.5 1.5]
    Film "rgb" "integer xresolution" 12 "integer yresolution" 9 WorldBegin )") +
                               kScreen + rectangle("-2 -1.5 0  2 -1.5 0  2 1.5 0  -2 1.5 0"));
  RenderSettings settings = settings_of(Method::kRaytrace, 16, 0.1f, 1);
  const Film film = render_with_threads(scene, settings).film;
  const auto& light = std::get<DiffuseAreaLight>(scene.lights[0]);
  const auto expect_pixel = [&](int x, int y, const Rgb& c) {
    for (int k = 0; k < 3; ++k) {
      const double encoded = double(c[k]) / 255;
      const double linear = encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4);
      EXPECT_NEAR(light.image->value({(x + 0.5f) / 4, 1 - (y + 0.5f) / 3})[k], linear, 1e-5) << x << y;
      // The picture's pixel covers a third of the image's pixel about its centre, where the neighbours' share
      // is a twelfth on each of two axes.
      EXPECT_NEAR(film.at(3 * x + 1, 3 * y + 1).emitted[k], 40 * linear, 40 * (0.17 * linear + 0.17))
          << x << y;
    }
  };
  expect_pixel(3, 0, {255, 40, 20});
  expect_pixel(0, 2, {30, 220, 60});
  EXPECT_GT(film.at(10, 1).emitted.x, 20 * film.at(10, 7).emitted.x);
  EXPECT_GT(film.at(1, 7).emitted.y, 20 * film.at(1, 1).emitted.y);
}

RenderSettings quick(float radius) {
  RenderSettings settings = settings_of(Method::kPhoton, 4, radius, 7);
  settings.photons = 20'000;
  return settings;
}

TEST(EmissionImages, AnyNumberOfThreadsGivesTheSameBits) {
  write_screen();
  const Scene scene = scene_of(room(1, kScreen, "", with_ball()));
  const Film one = render_with_threads(scene, quick(0.1f), 1).film;
  for (const int threads : {2, 5}) {
    const Film film = render_with_threads(scene, quick(0.1f), threads).film;
    EXPECT_EQ(std::memcmp(&film.at(0, 0), &one.at(0, 0), sizeof(PixelResult) * kSize * kSize), 0);
  }
}

TEST(EmissionImages, ScalingByAPowerOfTwoChangesNothing) {
  write_screen();
  for (const Method method : {Method::kPhoton, Method::kMc}) {
    RenderSettings settings = quick(0.125f);
    settings.method = method;
    const Film one = render_with_threads(scene_of(room(1, kScreen, "", with_glass(1))), settings).film;
    for (const float scale : {0x1p-20f, 0x1p10f}) {
      settings.radius = 0.125f * scale;
      const Scene scaled = scene_of(room(double(scale), kScreen, "", with_glass(double(scale))));
      const Film film = render_with_threads(scaled, settings).film;
      for (int y = 0; y < kSize; ++y)
        for (int x = 0; x < kSize; ++x) ASSERT_EQ(film.at(x, y).radiance(), one.at(x, y).radiance());
    }
  }
}

// A hidden light illuminates like a visible one, and the camera looks through it at the wall.
TEST(HiddenLights, IlluminateButAreInvisible) {
  write_screen();
  const auto by_rays = [&](const std::string& on_screen) {
    return films(scene_of(room(1, kScreen, on_screen)), settings_of(Method::kRaytrace, 64, 0.1f, 1));
  };
  const auto seen = by_rays(""), hidden = by_rays("\"float alpha\" 0");
  EXPECT_GT(block_estimate(seen, Layer::kEmitted, -1).mean, 0);
  EXPECT_EQ(block_estimate(hidden, Layer::kEmitted, -1).mean, 0);
  // The blocks show the floor only: the hidden light's own surface is nearly black, and the wall behind it is
  // unlit.
  for (const int block : {6, 7, 8}) {
    const Estimate a = block_estimate(seen, Layer::kDirect, block),
                   b = block_estimate(hidden, Layer::kDirect, block);
    EXPECT_NEAR(a.mean, b.mean, kErrors * std::hypot(a.standard_error, b.standard_error)) << block;
    EXPECT_GT(a.mean, 0);
  }
}

// A light of one colour gives half of its light when an image cuts half of it out, or with a constant alpha
// of 0.5.
TEST(LightsWithAlpha, EmitInProportionToAlpha) {
  write_screen();
  const std::string plain = "AreaLightSource \"diffuse\" \"rgb L\" [8 4 2]\n";
  for (const Method method : {Method::kRaytrace, Method::kMc, Method::kPhoton}) {
    const auto direct = [&](const std::string& on_screen) {
      return block_estimate(films(scene_of(room(1, plain, on_screen)), settings_of(method, 64, 0.1f, 1)),
                            Layer::kDirect, 7);
    };
    const Estimate whole = direct(""), half = direct("\"float alpha\" 0.5");
    EXPECT_NEAR(half.mean, whole.mean / 2,
                kErrors * std::hypot(half.standard_error, whole.standard_error / 2));
    EXPECT_LT(kErrors * half.standard_error, 0.1 * half.mean);
  }
}

}  // namespace
}  // namespace kaustik::render
