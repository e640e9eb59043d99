// Tests scenes and settings at the limits of the numbers.

#include <gtest/gtest.h>

#include <cstring>
#include <filesystem>

#include "tests/render/support/image_statistics.h"
#include "tests/render/support/scene_files.h"
#include "tests/support/packed_flux.h"

namespace kaustik::render {
namespace {

using namespace test;

const Method kAllMethods[] = {Method::kRaytrace, Method::kMc, Method::kHybrid, Method::kPhoton};

RenderSettings settings_of(Method method, int spp = 4, uint64_t photons = 20'000) {
  RenderSettings settings;
  settings.method = method;
  settings.spp = spp;
  settings.photons = photons;
  return settings;
}

double sum_of(const PixelResult& p) {
  const Rgb v = p.emitted + p.direct + p.caustic + p.indirect;
  return double(v.x) + double(v.y) + double(v.z);
}

void expect_sound(const RenderResult& result) {
  EXPECT_EQ(result.statistics.dropped_samples, 0u);
  EXPECT_EQ(result.statistics.clamped_sums, 0u);
  EXPECT_EQ(result.statistics.photons.dropped_invalid, 0u);
  EXPECT_EQ(result.statistics.photons.energy.unaccounted(), 0);
  for (int y = 0; y < result.film.height(); ++y)
    for (int x = 0; x < result.film.width(); ++x) {
      const double v = sum_of(result.film.at(x, y));
      ASSERT_TRUE(std::isfinite(v) && v >= 0) << x << " " << y;
    }
}

// At every scale from 2^-20 to 2^20 the radiance of every pixel has the same bits.
TEST(Extremes, EveryPowerOfTwoGivesTheSamePicture) {
  for (const Method method : {Method::kHybrid, Method::kPhoton}) {
    const auto one = render_with_threads(cornell(12), settings_of(method, 2, 5000));
    for (int k = -20; k <= 20; ++k) {
      auto scaled = render_with_threads(cornell(12, std::ldexp(1.0f, k)), settings_of(method, 2, 5000));
      for (int y = 0; y < 12; ++y)
        for (int x = 0; x < 12; ++x) {
          scaled.film.at(x, y).depth /= std::ldexp(1.0f, k);
          scaled.film.at(x, y).denoising_depth /= std::ldexp(1.0f, k);
          ASSERT_EQ(std::memcmp(&scaled.film.at(x, y), &one.film.at(x, y), sizeof(PixelResult)), 0)
              << "2^" << k << " at " << x << " " << y;
        }
    }
  }
}

// A closed box whose walls emit 1 and reflect half; the camera is in its middle.
Scene furnace_box(float rho = 0.5f) {
  Scene scene;
  const uint32_t wall = add_material(scene, Lambertian{Rgb(rho)});
  for (Shape face : {horizontal({0, -1, 0}, 1, 1, true, wall), horizontal({0, 1, 0}, 1, 1, false, wall),
                     quad({-1, -1, -1}, {1, -1, -1}, {1, 1, -1}, {-1, 1, -1}, wall),
                     quad({-1, -1, 1}, {-1, 1, 1}, {1, 1, 1}, {1, -1, 1}, wall),
                     quad({-1, -1, -1}, {-1, 1, -1}, {-1, 1, 1}, {-1, -1, 1}, wall),
                     quad({1, -1, -1}, {1, -1, 1}, {1, 1, 1}, {1, 1, -1}, wall)})
    make_light(scene, add_shape(scene, std::move(face)), Rgb(1));
  look_at(scene, {0, 0, 0}, {1, 0.5f, 0.25f}, {0, 1, 0}, 90, 32, 32);
  finalize_scene(scene);
  return scene;
}

// A plate of 1 m under a square light of half side a at height h; the camera sees the plate's middle.
Scene plate_under_light(float a, float h, float L) {
  Scene scene;
  const uint32_t wall = add_material(scene, Lambertian{Rgb(0.5f)});
  add_shape(scene, horizontal({0, 0, 0}, 0.5f, 0.5f, true, wall));
  make_light(scene, add_shape(scene, horizontal({0, h, 0}, a, a, false, wall)), Rgb(L));
  look_at(scene, {0.2f, 0.3f, 0}, {0, 0, 0}, {0, 1, 0}, 0.1f, 4, 4);
  finalize_scene(scene);
  return scene;
}

// The irradiance in the middle under a parallel square has a closed form, and the radiance is half of it over
// pi. The light is sampled by area, so samples vary by cos^4 over it: for a = h between 1 and 1/9 the
// standard deviation is below one mean. The visible points lie within 1e-3 of the middle: an error below
// 1e-5.
TEST(Extremes, LightsOfAMillionthAndAMillionSceneSizes) {
  for (const auto& [a, h] : {std::pair{1e-6f, 1.0f}, {1e6f, 1e6f}}) {
    const float L = a < 1 ? 1e12f : 1.0f;
    const auto result = render_with_threads(plate_under_light(a, h, L), settings_of(Method::kRaytrace, 4096));
    expect_sound(result);
    const double x = double(a) / std::hypot(double(a), double(h));
    const double expected = 0.5 / M_PI * double(L) * 4 * x * std::atan(x);
    const double noise = a < 1 ? 0 : 5 / std::sqrt(16 * 4096.0);
    EXPECT_NEAR(layer_mean(result.film, Layer::kDirect), expected, expected * (noise + 1e-5)) << a;
  }
}

// With photons all results must be finite for the tiny light. Hardly any photon of the huge light meets the
// plate.
TEST(Extremes, PhotonsOfLightsOfAMillionthAndAMillionSceneSizes) {
  for (const auto& [a, h] : {std::pair{1e-6f, 1.0f}, {1e6f, 1e6f}})
    for (const Method method : kAllMethods)
      expect_sound(render_with_threads(plate_under_light(a, h, 1), settings_of(method)));
}

// r0 goes from 1e-7 to 1e3 scene sizes. At 1e3 every query reads all photons of its surface.
TEST(Extremes, RadiiOverTenDecades) {
  const Scene scene = cornell(12);
  for (const float radius : {2e-7f, 2e-5f, 2e-3f, 20.0f, 2e3f}) {
    for (const Method method : {Method::kHybrid, Method::kPhoton}) {
      RenderSettings settings = settings_of(method, 1);
      settings.radius = radius;
      const auto result = render_with_threads(scene, settings);
      expect_sound(result);
      EXPECT_EQ(result.statistics.radius, radius);
    }
  }
}

TEST(Extremes, OneAndTwoPhotons) {
  for (const uint64_t photons : {1, 2})
    for (const Method method : kAllMethods) {
      const auto result = render_with_threads(cornell(12), settings_of(method, 1, photons));
      expect_sound(result);
      const bool any = method == Method::kHybrid || method == Method::kPhoton;
      EXPECT_EQ(result.statistics.photons.emitted, any ? photons : 0);
    }
}

// White walls: each scattering adds Le again, 1 + 200 in all, without a loss over 200 bounces. Roulette never
// ends a path of weight one, so only the light sampled at each vertex varies, and the variance of its sum is
// less than that of 200 independent ones; it is measured over seeds.
TEST(Extremes, WhiteFurnaceOf200Bounces) {
  const Scene scene = furnace_box(1);
  RenderSettings settings = settings_of(Method::kMc, 1);
  settings.max_bounces = 200;
  std::vector<double> means;
  for (settings.seed = 0; settings.seed < 6; ++settings.seed) {
    const auto result = render_with_threads(scene, settings);
    expect_sound(result);
    means.push_back(total_mean(result.film));
  }
  const Estimate found = estimate_of(means);
  EXPECT_NEAR(found.mean, 201, 6 * found.standard_error);
  EXPECT_LT(found.standard_error, 1);
}

// A glass sphere changes nothing in a furnace, whatever its index. Paths end after 64 scattering events.
TEST(Extremes, GlassOfAnyIndexInAFurnace) {
  for (const float eta : {1.0f, 1 + 1e-6f, 4.0f}) {
    Scene scene = furnace_box();
    add_shape(scene, sphere({0.6f, 0.3f, 0.15f}, 0.25f, add_material(scene, Dielectric{eta})));
    finalize_scene(scene);
    for (const Method method : {Method::kMc, Method::kPhoton}) {
      RenderSettings settings = settings_of(method, 16, 50'000);
      settings.max_bounces = 64;
      settings.radius = 0.1f;
      std::vector<double> means;
      for (settings.seed = 0; settings.seed < 4; ++settings.seed) {
        const auto result = render_with_threads(scene, settings);
        expect_sound(result);
        means.push_back(total_mean(result.film));
      }
      const Estimate found = estimate_of(means);
      // Four seeds have 3 degrees of freedom.
      EXPECT_NEAR(found.mean, 2, 10 * found.standard_error + 2 * kPackedFluxError) << eta;
      EXPECT_LT(found.standard_error, 0.02);
    }
  }
}

// Needles, triangles without area, and duplicate and coplanar faces beside valid ones. Faces that coincide
// share a surface group, as the builder joins duplicates and a scene file can join the rest: a photon lands
// on either. Paths to the floor differ from those in the scene without these faces: noise of the direct
// light, 1 %.
TEST(Extremes, DegenerateAndDuplicateFacesAreHarmless) {
  Scene scene = cornell(24);
  const uint32_t white = 0, floor_group = scene.shapes[0].surface_group;
  std::vector<RenderResult> references;
  for (const Method method : kAllMethods)
    references.push_back(render_with_threads(scene, settings_of(method, 16, 100'000)));
  add_shape(scene, horizontal({0, 0, 0}, 1, 1, true, white)).surface_group = floor_group;
  add_shape(scene, horizontal({0.25f, 0, 0.25f}, 0.5f, 0.5f, true, white)).surface_group = floor_group;
  add_shape(scene, triangle({-1, 0.5f, -1}, {1, 0.5f, -1}, {1, 0.5f + 1e-7f, -1}, white));
  TriangleMesh flat;
  flat.P = {{0, 1, 0}, {0.5f, 1, 0}, {0.25f, 1, 0}};
  flat.indices = {{0, 1, 2}, {0, 0, 0}, {1, 1, 2}};
  Shape nothing;
  nothing.geometry = flat;
  nothing.material = white;
  add_shape(scene, nothing);
  finalize_scene(scene);
  for (size_t i = 0; i < references.size(); ++i) {
    const auto result = render_with_threads(scene, settings_of(kAllMethods[i], 16, 100'000));
    expect_sound(result);
    const double expected = layer_mean(references[i].film, Layer::kDirect);
    EXPECT_NEAR(layer_mean(result.film, Layer::kDirect), expected, 0.01 * expected) << i;
    write_if_failed(result.film, "duplicates");
  }
}

TEST(Extremes, RoughnessAndAlbedoAtTheirLimits) {
  for (const float sigma : {0.0f, 90.0f}) {
    for (const float rho : {0.0f, 1.0f}) {
      Scene scene = cornell(12);
      for (uint32_t m = 0; m < 3; ++m) scene.materials[m] = OrenNayar::from_sigma_degrees(Rgb(rho), sigma);
      finalize_scene(scene);
      for (const Method method : kAllMethods) {
        RenderSettings settings = settings_of(method);
        settings.max_bounces = 64;
        const auto result = render_with_threads(scene, settings);
        expect_sound(result);
        if (rho == 0) {
          EXPECT_EQ(layer_mean(result.film, Layer::kDirect), 0);
        }
      }
    }
  }
}

// The ledger of every scene that comes with the program balances exactly: emitted = absorbed + escaped +
// terminated + roulette. The emitted flux is the lights' power up to the rounding of each photon by half a
// unit and of float sums. Some scenes have lights of many colours, of which photons start in proportion to
// luminance, so the sum over channels has noise. Its spread from photon to photon is below its mean there, so
// four standard errors are at most the mean times 4 / sqrt(photons). Guided photons are not in the ledger.
// Distant light in a medium starts where the medium begins, and not all over the scene's bounds, as power()
// says.
bool starts_in_medium(const Scene& scene) {
  for (size_t i = 0; i < scene.lights.size(); ++i)
    if (std::holds_alternative<DistantLight>(scene.lights[i]) && i < scene.light_media.size() &&
        scene.light_media[i] != kVacuum)
      return true;
  return false;
}

TEST(Extremes, EnergyLedgerOfEverySceneBalances) {
  int scenes = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(KAUSTIK_SCENES_DIR)) {
    if (entry.path().extension() != ".pbrt" || entry.path().stem() == "geometry") continue;
    SCOPED_TRACE(entry.path().filename());
    ++scenes;
    const auto folder = entry.path().parent_path().filename();
    const bool coloured = folder == "gallery" || folder == "untuned";
    Scene scene = scene_from(std::filesystem::relative(entry.path(), KAUSTIK_SCENES_DIR).string());
    scene.camera.width = scene.camera.height = 8;
    scene.camera.set_default_screen_window();
    Rgb power_sum(0);
    for (const Light& light : scene.lights) power_sum += power(light);
    const double power = double(power_sum.x) + double(power_sum.y) + double(power_sum.z);
    for (const Method method : {Method::kHybrid, Method::kPhoton}) {
      RenderSettings settings = settings_of(method, 1);
      if (method == Method::kHybrid) settings.guide = Guide::kOff;  // it shoots only caustic photons
      const auto result = render_with_threads(scene, settings);
      expect_sound(result);
      const photon::EnergyLedger& e = result.statistics.photons.energy;
      if (starts_in_medium(scene)) continue;
      const double noise = coloured ? 4 / std::sqrt(20'000.0) : 0;
      EXPECT_NEAR(e.watts(e.emitted), power, 0.5 * 20'000 * e.watts(1) + (0x1p-20 + noise) * power);
    }
  }
  EXPECT_GE(scenes, 7);
}

}  // namespace
}  // namespace kaustik::render
