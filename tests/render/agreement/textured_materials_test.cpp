// Tests materials whose lobes are diffuse in some points and specular in others (textured roughness, textured
// mixtures), and lobes that follow the surface's uv.

#include <cstring>

#include "tests/render/support/class_agreement.h"
#include "tests/render/support/textured_scenes.h"

namespace kaustik::render {
namespace {

using namespace test;

// A room with a light. A plate in its middle, lit from both sides, and a ball have the material "tested".
std::string room(const std::string& tested) {
  return "LookAt 0 1.5 0.95  0 0.6 -0.2  0 1 0 Camera \"perspective\" \"float fov\" 75\n" +
         fmt::format("Film \"rgb\" \"integer xresolution\" {0} \"integer yresolution\" {0}\nWorldBegin\n",
                     kSize) +
         tested + "Material \"diffuse\" \"rgb reflectance\" [0.6 0.6 0.6]\n" +
         rectangle("-1 0 1 1 0 1 1 0 -1 -1 0 -1") + rectangle("-1 2 -1 1 2 -1 1 2 1 -1 2 1") +
         rectangle("-1 0 -1 1 0 -1 1 2 -1 -1 2 -1") + rectangle("1 0 1 -1 0 1 -1 2 1 1 2 1") +
         rectangle("-1 0 1 -1 0 -1 -1 2 -1 -1 2 1") + rectangle("1 0 -1 1 0 1 1 2 1 1 2 -1") +
         "NamedMaterial \"tested\"\n" + rectangle("-0.9 0.9 0.4 0.3 0.9 0.4 0.3 0.9 -0.8 -0.9 0.9 -0.8") +
         "AttributeBegin Translate 0.55 0.4 0.1 Shape \"sphere\" \"float radius\" 0.35 AttributeEnd\n"
         "AreaLightSource \"diffuse\" \"rgb L\" [5 5 5] Material \"diffuse\" \"rgb reflectance\" [0 0 0]\n" +
         rectangle("-0.3 1.9 -0.5 0.7 1.9 -0.5 0.7 1.9 0.5 -0.3 1.9 0.5");
}

std::string named(const std::string& material) {
  return "MakeNamedMaterial \"tested\" \"string type\" " + material + "\n";
}

// The roughness rises from zero in one corner through narrow, specular lobes to wide, diffuse ones.
constexpr const char* kRamp =
    "Texture \"ramp\" \"float\" \"bilerp\" \"float v00\" 0 \"float v10\" 0.25 \"float v01\" 0.35 \"float "
    "v11\" 0.7\n";

struct Case {
  const char* name;
  const char* material;
};
void PrintTo(const Case& c, std::ostream* out) {
  *out << c.name;
}
const Case kRough[] = {{"conductor", "\"conductor\" \"rgb reflectance\" [0.9 0.7 0.5] "},
                       {"dielectric", "\"dielectric\" \"float eta\" 1.5 "},
                       {"coateddiffuse", "\"coateddiffuse\" \"rgb reflectance\" [0.7 0.7 0.7] "}};
constexpr const char* kAlpha = " \"bool remaproughness\" false ";

class TexturedRoughness : public ::testing::TestWithParam<Case> {};

TEST_P(TexturedRoughness, SumDoesNotDependOnTheEstimators) {
  const std::string ramp = std::string(GetParam().material) + "\"texture roughness\" \"ramp\"" + kAlpha;
  expect_the_same_sum_by_all_estimators(scene_of(room(kRamp + named(ramp))), 0.08f);
}

TEST_P(TexturedRoughness, SumDoesNotDependOnTheEstimatorsForAnisotropicRoughness) {
  const std::string ramp =
      std::string(GetParam().material) + "\"texture uroughness\" \"ramp\" \"float vroughness\" 0.2" + kAlpha;
  expect_the_same_sum_by_all_estimators(scene_of(room(kRamp + named(ramp))), 0.08f);
}

// A constant texture equals the parameter: by paths to the bit, for smooth surfaces, specular and diffuse
// lobes, just below and just above the threshold. Photons are stored where a texture might be rough, so
// blocks of photons begin elsewhere and sums of some hundred photons of 24 bits are rounded differently.
TEST_P(TexturedRoughness, ConstantTextureEqualsTheNumber) {
  for (const char* roughness : {"0", "0.0005", "0.1", "0.2999", "0.3001", "0.8"}) {
    const auto scene_with = [&](const std::string& definition, const std::string& value) {
      return scene_of(room(definition + named(GetParam().material + value + kAlpha)));
    };
    const Scene number = scene_with("", std::string("\"float roughness\" ") + roughness);
    const Scene texture =
        scene_with(std::string("Texture \"r\" \"float\" \"constant\" \"float value\" ") + roughness + "\n",
                   "\"texture roughness\" \"r\"");
    for (const Method method : {Method::kMc, Method::kPhoton}) {
      RenderSettings settings = settings_of(method, 4, 0.1f, 7);
      settings.photons = 20'000;
      settings.guide = Guide::kOff;  // a guide learns from stored photons, so it may start other ones
      const Film a = render_with_threads(number, settings).film,
                 b = render_with_threads(texture, settings).film;
      if (method == Method::kMc) {
        EXPECT_EQ(std::memcmp(&a.at(0, 0), &b.at(0, 0), sizeof(PixelResult) * kSize * kSize), 0) << roughness;
      } else {
        EXPECT_NEAR(total_mean(a), total_mean(b), 1e-5 * total_mean(a)) << roughness;
      }
    }
  }
}
INSTANTIATE_TEST_SUITE_P(All, TexturedRoughness, ::testing::ValuesIn(kRough),
                         [](const auto& tested) { return tested.param.name; });

// With a roughness that varies a little about the threshold the picture is that of the threshold itself,
// although some points are specular and others diffuse.
TEST(TexturedRoughnessThreshold, SumIsContinuous) {
  const std::string metal = kRough[0].material;
  const auto sums = [&](const std::string& low, const std::string& high, Method method, float radius) {
    const std::string board =
        "Texture \"r\" \"float\" \"checkerboard\" \"float uscale\" 4 \"float vscale\" 4 "
        "\"float tex1\" " +
        low + " \"float tex2\" " + high + "\n";
    const Scene scene = scene_of(room(board + named(metal + "\"texture roughness\" \"r\"" + kAlpha)));
    return total(films(scene, settings_of(method, method == Method::kMc ? 128 : 32, radius, 7)));
  };
  for (const Method method : {Method::kMc, Method::kPhoton, Method::kAuto}) {
    const Estimate mixed = sums("0.2985", "0.3015", method, 0.08f),
                   half = sums("0.2985", "0.3015", method, 0.04f);
    const Estimate above = sums("0.3001", "0.3001", Method::kMc, 0.08f);
    // Half of the points differ by half a hundredth in alpha either way; what remains is of second order.
    double bias = 4e-3 * above.mean + kPackedLight * above.mean;
    if (method != Method::kMc)
      bias += 2 * std::abs(mixed.mean - half.mean) +
              kErrors * 2 * std::hypot(mixed.standard_error, half.standard_error);
    const double noise = std::hypot(mixed.standard_error, above.standard_error);
    EXPECT_NEAR(mixed.mean, above.mean, kErrors * noise + bias) << int(method);
    EXPECT_LT(kErrors * noise + bias, 0.15 * above.mean) << int(method);
  }
}

const std::string kTwo =
    "MakeNamedMaterial \"paint\" \"string type\" \"diffuse\" \"rgb reflectance\" [0.7 0.5 0.3]\n"
    "MakeNamedMaterial \"metal\" \"string type\" \"conductor\" \"rgb reflectance\" [0.9 0.9 0.9]\n";
std::string mixture(const std::string& amount) {
  return named("\"mix\" \"string materials\" [\"paint\" \"metal\"] " + amount);
}

TEST(TexturedMix, SumDoesNotDependOnTheEstimators) {
  expect_the_same_sum_by_all_estimators(scene_of(room(kRamp + kTwo + mixture("\"texture amount\" \"ramp\""))),
                                        0.08f);
}

TEST(TexturedMix, ConstantTextureEqualsTheNumber) {
  const std::string quarter = "Texture \"q\" \"float\" \"constant\" \"float value\" 0.25\n";
  const Scene number = scene_of(room(kTwo + mixture("\"float amount\" 0.25")));
  const Scene texture = scene_of(room(quarter + kTwo + mixture("\"texture amount\" \"q\"")));
  for (const Method method : {Method::kMc, Method::kPhoton}) {
    RenderSettings settings = settings_of(method, 4, 0.1f, 7);
    settings.photons = 20'000;
    const Film a = render_with_threads(number, settings).film,
               b = render_with_threads(texture, settings).film;
    EXPECT_EQ(std::memcmp(&a.at(0, 0), &b.at(0, 0), sizeof(PixelResult) * kSize * kSize), 0);
  }
}

// Seen from above by rays, the picture is that of the first material where the amount is 0 and that of the
// second where it is 1; amounts beyond are clamped.
TEST(TexturedMix, FollowsItsTexture) {
  write_png("halves.png", 2, 1, {0, 255});
  const auto picture = [](const std::string& material) {
    const Scene scene = scene_of(
        "Scale -1 1 1 LookAt 0 0 1  0 0 0  0 1 0 Camera \"orthographic\" Film \"rgb\" \"integer "
        "xresolution\" 16 "
        "\"integer yresolution\" 16 WorldBegin LightSource \"point\" \"point3 from\" [0 0 1]\n"
        "Texture \"halves\" \"float\" \"imagemap\" \"string filename\" \"halves.png\" \"string filter\" "
        "\"point\" "
        "\"string encoding\" \"linear\" \"float scale\" 3\n"
        "MakeNamedMaterial \"red\" \"string type\" \"diffuse\" \"rgb reflectance\" [0.7 0.1 0.1]\n"
        "MakeNamedMaterial \"blue\" \"string type\" \"diffuse\" \"rgb reflectance\" [0.1 0.1 0.7]\n"
        "MakeNamedMaterial \"both\" \"string type\" \"mix\" \"string materials\" [\"red\" \"blue\"] "
        "\"texture amount\" \"halves\"\n"
        "NamedMaterial \"" +
        material + "\" " + rectangle("-1 -1 0 1 -1 0 1 1 0 -1 1 0"));
    return render_with_threads(scene, settings_of(Method::kRaytrace, 4, 0.1f, 3)).film;
  };
  const Film red = picture("red"), blue = picture("blue"), both = picture("both");
  for (int y = 0; y < 16; ++y)
    for (int x = 0; x < 16; ++x)
      EXPECT_EQ(both.at(x, y).radiance(), (x < 8 ? red : blue).at(x, y).radiance()) << x << " " << y;
}

// A disk of brushed metal under a light and a camera that are both on its axis: half vectors lean along the
// radius, which is v. So the picture is the same all around. Where the facets lean far along v the highlight
// reaches the rim; where they lean along u, around the axis, it stays in the middle. The expected values are
// those of the BSDF.
TEST(Anisotropy, HighlightsFollowUvOnADisk) {
  constexpr int kPixels = 32;
  constexpr double kHeight = 1.5;
  const std::string facets[] = {"\"float uroughness\" 0.05 \"float vroughness\" 0.4",
                                "\"float uroughness\" 0.4 \"float vroughness\" 0.05"};
  double at_rim[2];
  for (const int along_u : {0, 1}) {
    const Scene scene = scene_of(
        "LookAt 0 0 1  0 0 0  0 1 0 Camera \"orthographic\" Film \"rgb\" \"integer xresolution\" 32 "
        "\"integer yresolution\" 32 WorldBegin LightSource \"point\" \"point3 from\" [0 0 1.5]\n"
        "Material \"conductor\" \"rgb reflectance\" [0.9 0.7 0.5] " +
        facets[along_u] + kAlpha + " Shape \"disk\"");
    const auto& metal = std::get<Conductor>(scene.materials[0].typical());
    const Film film = render_with_threads(scene, settings_of(Method::kRaytrace, 64, 0.1f, 3)).film;
    for (int y = 0; y < kPixels; ++y) {
      for (int x = 0; x < kPixels; ++x) {
        const double px = (x + 0.5) / 16 - 1, py = (y + 0.5) / 16 - 1, r2 = px * px + py * py;
        if (r2 < 0.1 || r2 > 0.8) continue;  // only between the peak and the rim
        const double d2 = kHeight * kHeight + r2, cosine = kHeight / std::sqrt(d2);
        const Vector3 wi(0, float(std::sqrt(r2 / d2)), float(cosine));
        const Rgb f = metal.f_glossy({0, 0, 1}, wi);
        const double expected = double(f.x) * cosine / d2;
        // Over a pixel of 1/16 the lobe changes by up to a third; the mean over a pixel differs from the
        // value in its middle to second order only.
        EXPECT_NEAR(film.at(x, y).radiance().x, expected, 0.1 * expected + 1e-6) << x << " " << y;
      }
    }
    at_rim[along_u] = double(film.at(kPixels / 2, 3).radiance().x);
  }
  EXPECT_GT(at_rim[0], 100 * at_rim[1]);
}

// Turning uv by a right angle turns the highlight's streak.
TEST(Anisotropy, HighlightsTurnWithUv) {
  const auto picture = [](const std::string& uv) {
    const Scene scene = scene_of(
        "LookAt 0 0 1  0 0 0  0 1 0 Camera \"orthographic\" Film \"rgb\" \"integer xresolution\" 16 "
        "\"integer yresolution\" 16 WorldBegin LightSource \"point\" \"point3 from\" [0 0 1.5]\n"
        "Material \"conductor\" \"float uroughness\" 0.4 \"float vroughness\" 0.05" +
        std::string(kAlpha) +
        "Shape \"trianglemesh\" \"integer indices\" [0 1 2 0 2 3] \"point3 P\" [-1 -1 0 1 -1 0 1 1 0 -1 1 0] "
        "\"point2 uv\" [" +
        uv + "]");
    return render_with_threads(scene, settings_of(Method::kRaytrace, 256, 0.1f, 3)).film;
  };
  const Film along_x = picture("0 0 1 0 1 1 0 1"), along_y = picture("0 0 0 1 1 1 1 0");
  EXPECT_GT(along_x.at(14, 8).radiance().x, 20 * along_x.at(8, 14).radiance().x);
  EXPECT_GT(along_y.at(8, 14).radiance().x, 20 * along_y.at(14, 8).radiance().x);
}

}  // namespace
}  // namespace kaustik::render
