// Tests textures, bump maps and alpha in every estimator.

#include <cstring>

#include "tests/render/support/class_agreement.h"
#include "tests/render/support/textured_scenes.h"

namespace kaustik::render {
namespace {

using namespace test;

constexpr const char* kFromAbove =
    "LookAt 0 0 1  0 0 0  0 1 0 Camera \"perspective\" \"float fov\" 90\n"
    "Film \"rgb\" \"integer xresolution\" 16 \"integer yresolution\" 16\nWorldBegin\n";

// A plane under the radiance L from every direction shows Lo = rho L. The image shows 4 x 4 fields, so its
// mean is that of the two reflectances. The noise of one picture is that of 16 x 16 x 16 samples of the sky;
// six pictures measure it.
TEST(Textures, MeanOfACheckerboardMatchesTheClosedForm) {
  const Scene scene = scene_of(std::string(kFromAbove) + R"(
    LightSource "infinite" "rgb L" [1 1 1]
    Texture "t" "spectrum" "checkerboard" "float uscale" 4 "float vscale" 4 "rgb tex1" [.9 .9 .9] "rgb tex2" [.2 .2 .2]
    Material "diffuse" "texture reflectance" "t")" +
                               rectangle("-1 -1 0 1 -1 0 1 1 0 -1 1 0"));
  for (const Method method : {Method::kMc, Method::kRaytrace}) {
    std::vector<double> means;
    for (const Film& film : films(scene, settings_of(method, 16, 0.1f, 1))) means.push_back(total_mean(film));
    const Estimate found = estimate_of(means);
    EXPECT_NEAR(found.mean, 0.55, kErrors * found.standard_error);
    EXPECT_LT(kErrors * found.standard_error, 0.03);
  }
}

// A box with a tiled floor, a textured wall and a glass ball, in metres times s.
std::string tiled_box(double s, const std::string& floor_material, const std::string& wall_material) {
  const auto p = [s](std::initializer_list<double> numbers) {
    std::string text;
    for (const double x : numbers) text += fmt::format("{} ", x * s);
    return text;
  };
  return "LookAt " + p({0, 1, 2.2, 0, 0.7, 0}) + " 0 1 0 Camera \"perspective\" \"float fov\" 60\n" +
         fmt::format("Film \"rgb\" \"integer xresolution\" {0} \"integer yresolution\" {0}\nWorldBegin\n",
                     kSize) +
         R"(Texture "tiles" "spectrum" "imagemap" "string filename" "tiles.png" "float uscale" 2 "float vscale" 3
            "string filter" "trilinear"
            Texture "hills" "float" "imagemap" "string filename" "hills.png" "string encoding" "linear")" +
         fmt::format(" \"float scale\" {}\n", 0.2 * s) + floor_material +
         rectangle(p({-1, 0, 1, 1, 0, 1, 1, 0, -1, -1, 0, -1})) + wall_material +
         rectangle(p({-1, 0, -1, 1, 0, -1, 1, 2, -1, -1, 2, -1})) +
         rectangle(p({-1, 0, 1, -1, 0, -1, -1, 2, -1, -1, 2, 1})) + "AttributeBegin Translate " +
         p({0.35, 0.4, 0.1}) + " Material \"dielectric\" Shape \"sphere\" " +
         fmt::format("\"float radius\" {} AttributeEnd\n", 0.35 * s) +
         "AreaLightSource \"diffuse\" \"rgb L\" [8 8 8] Material \"diffuse\" \"rgb reflectance\" [0 0 0]\n" +
         rectangle(p({-0.4, 1.9, -0.4, 0.4, 1.9, -0.4, 0.4, 1.9, 0.4, -0.4, 1.9, 0.4}));
}

void write_images() {
  write_png("tiles.png", 2, 3, {220, 60, 60, 60, 200, 80, 70, 70, 210, 230, 220, 210});
  write_png("hills.png", 4, 1, {0, 80, 160, 80, 80, 200, 255, 120, 60, 140, 220, 100, 20, 90, 130, 40});
}

constexpr const char* kTiled = "Material \"diffuse\" \"texture reflectance\" \"tiles\"\n";
constexpr const char* kPlain = "Material \"diffuse\" \"rgb reflectance\" [0.6 0.6 0.6]\n";
constexpr const char* kBumped =
    "Material \"diffuse\" \"rgb reflectance\" [0.6 0.6 0.6] \"texture displacement\" \"hills\"\n";

void expect_photons_agree_with_paths(const char* first, const char* second, const char* pictures) {
  write_images();
  const Scene scene = scene_of(tiled_box(1, first, second));
  const auto by_paths = films(scene, settings_of(Method::kMc, 256, 0.1f, 100));
  const Comparison c(scene, by_paths, Method::kPhoton, 0.1f);
  for (const Layer layer : kClasses) c.expect_agreement(layer, -1, 0.5);
  c.write_pictures(pictures);
}

TEST(TextureAgreement, PhotonsCarryTheColourOfImages) {
  expect_photons_agree_with_paths(kTiled, kPlain, "tiled_box");
}

// The bumps turn normals by up to 30 degrees; photons are weighted for them as for interpolated normals.
TEST(TextureAgreement, PhotonsAgreeWithPathsOnBumps) {
  expect_photons_agree_with_paths(kBumped, kTiled, "bumped_box");
}

bool same_pixels(const Film& a, const Film& b) {
  return std::memcmp(&a.at(0, 0), &b.at(0, 0), sizeof(PixelResult) * kSize * kSize) == 0;
}

RenderSettings quick(float radius) {
  RenderSettings settings = settings_of(Method::kPhoton, 4, radius, 7);
  settings.photons = 20'000;
  return settings;
}

TEST(Textures, AnyNumberOfThreadsGivesTheSameBits) {
  write_images();
  const Scene scene = scene_of(tiled_box(1, kTiled, kBumped));
  const Film one = render_with_threads(scene, quick(0.1f), 1).film;
  for (const int threads : {2, 5})
    EXPECT_TRUE(same_pixels(one, render_with_threads(scene, quick(0.1f), threads).film));
}

// Depth scales with the scene; the light keeps its bits.
TEST(Textures, ScalingByAPowerOfTwoChangesNothing) {
  write_images();
  const Film one = render_with_threads(scene_of(tiled_box(1, kTiled, kBumped)), quick(0.125f)).film;
  for (const float scale : {0x1p-20f, 0x1p10f}) {
    const Scene scaled = scene_of(tiled_box(double(scale), kTiled, kBumped));
    const Film film = render_with_threads(scaled, quick(0.125f * scale)).film;
    for (int y = 0; y < kSize; ++y)
      for (int x = 0; x < kSize; ++x) ASSERT_EQ(film.at(x, y).radiance(), one.at(x, y).radiance());
  }
}

// A screen half way between the light and the floor. The camera is between them and looks down.
Scene screened(const std::string& screen) {
  return scene_of(std::string(kFromAbove) +
                  "LightSource \"point\" \"point3 from\" [0 0 4] \"rgb I\" [9 9 9]\n" +
                  "Texture \"halves\" \"float\" \"imagemap\" \"string filename\" \"halves.png\" "
                  "\"string filter\" \"point\" \"string encoding\" \"linear\"\n" +
                  rectangle("-2 -2 0 2 -2 0 2 2 0 -2 2 0") + screen);
}

// The left half of the screen is cut out: the floor below it is lit exactly as without the screen, and the
// rest is dark.
TEST(Alpha, CutOutHalfCastsNoShadow) {
  write_png("halves.png", 2, 1, {0, 255});
  const std::string screen = "-2 -2 2 2 -2 2 2 2 2 -2 2 2";
  RenderSettings settings = settings_of(Method::kRaytrace, 1, 0.1f, 3);
  settings.adaptive = 0;  // both renders take the same samples
  const Film lit = render_with_threads(screened(""), settings).film;
  const Film cut =
      render_with_threads(screened(rectangle(screen, "\"texture alpha\" \"halves\"")), settings).film;
  int dark = 0;
  for (int y = 0; y < 16; ++y)
    for (int x = 0; x < 16; ++x) {
      if (is_black(cut.at(x, y).radiance())) {
        ++dark;
      } else {
        EXPECT_EQ(cut.at(x, y).radiance(), lit.at(x, y).radiance());
      }
    }
  EXPECT_EQ(dark, 16 * 16 / 2);
}

// A constant alpha lets a random share of rays and photons through, the same on average: here 1/4 of 3/4. By
// the binomial errors of 200,000 photons and 16 x 16 x 64 shadow rays, five standard errors of both together
// are below 1 %.
TEST(Alpha, TransmitsTheSameShareOfRaysAndPhotons) {
  write_png("halves.png", 2, 1, {0, 255});
  const std::string sheets = rectangle("-2 -2 2 2 -2 2 2 2 2 -2 2 2", "\"float alpha\" 0.25") +
                             rectangle("-2 -2 3 2 -2 3 2 2 3 -2 2 3", "\"float alpha\" 0.75");
  const auto direct = [&](const std::string& screen, Method method) {
    RenderSettings settings = settings_of(method, 64, 0.2f, 3);
    settings.max_bounces = 1;
    return layer_mean(render_with_threads(screened(screen), settings).film, Layer::kDirect);
  };
  for (const Method method : {Method::kRaytrace, Method::kPhoton}) {
    const double open = direct("", method);
    EXPECT_NEAR(direct(sheets, method) / open, 0.75 * 0.25, 0.03) << int(method);
  }
}

}  // namespace
}  // namespace kaustik::render
