// Tests direct light with predicted visibility, and direct light with negative photons: unbiased whatever the
// prediction, and exact where nothing blocks the light.

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "render/compare/compare.h"
#include "render/estimators/lighting.h"
#include "render/statistics_json.h"
#include "tests/render/support/class_agreement.h"
#include "tests/render/support/closed_forms.h"
#include "tests/render/support/scene_files.h"
#include "tests/support/packed_flux.h"

namespace kaustik::render {
namespace {

using namespace test;

// The box with a plate that casts a shadow, glass and mirror, the square light, and a weaker point light
// elsewhere.
Scene two_lights(int size) {
  Scene scene = cornell_with_table(size);
  scene.lights.push_back(PointLight{{0.7f, 1.5f, 0.6f}, Rgb(0.3f, 0.4f, 0.5f)});
  finalize_scene(scene);
  return scene;
}

RenderSettings direct_settings(DirectEstimator direct, int spp, uint64_t seed = 1) {
  RenderSettings settings = test::settings_of(Method::kRaytrace, spp, 0.1f, seed);
  settings.direct = direct;
  settings.adaptive = 0;  // both renders take the same samples
  return settings;
}

// The mean difference of films that share their camera rays and light samples, over seeds.
Estimate paired_difference(const std::vector<Film>& a, const std::vector<Film>& b, Layer layer, int block) {
  std::vector<double> differences;
  for (size_t i = 0; i < a.size(); ++i)
    differences.push_back(block_mean(a[i], layer, block) - block_mean(b[i], layer, block));
  return estimate_of(differences);
}

// With 11 degrees of freedom Student's t exceeds 5 standard errors less than once in 2000.
constexpr int kManySeeds = 12;
constexpr double kManyErrors = 5;

TEST(Predicted, IsUnbiasedInEveryBlock) {
  const Scene scene = two_lights(kSize);
  const auto rays = films(scene, direct_settings(DirectEstimator::kShadowRays, 64), kManySeeds);
  const auto predicted = films(scene, direct_settings(DirectEstimator::kPredicted, 64), kManySeeds);
  for (int block = -1; block < kSize / kBlock * (kSize / kBlock); ++block) {
    const Estimate d = paired_difference(predicted, rays, Layer::kDirect, block);
    const double mean = block_estimate(rays, Layer::kDirect, block).mean;
    EXPECT_LE(std::abs(d.mean), kManyErrors * d.standard_error + 1e-6 * mean) << "block " << block;
    EXPECT_LT(d.standard_error, 0.01 * mean) << "block " << block;  // the test can fail
  }
  write_if_failed(predicted[0], "predicted");
  write_if_failed(rays[0], "predicted_rays");
}

// Indirect paths sample the direct light at x too, and their own shadow rays are predicted as well.
TEST(Predicted, IsUnbiasedTogetherWithPaths) {
  const Scene scene = two_lights(kSize);
  RenderSettings settings = test::settings_of(Method::kMc, 32, 0.1f, 1);
  const auto rays = films(scene, settings, kManySeeds);
  settings.direct = DirectEstimator::kPredicted;
  const auto predicted = films(scene, settings, kManySeeds);
  for (const Layer layer : kClasses) {
    const Estimate d = paired_difference(predicted, rays, layer, -1);
    EXPECT_LE(std::abs(d.mean), kManyErrors * d.standard_error + 1e-6 * layer_mean(rays[0], layer))
        << kLayerNames[size_t(layer)];
    EXPECT_LT(d.standard_error, 0.01 * layer_mean(rays[0], layer));
  }
}

// On the scenes of both source documents at least two thirds of the shadow rays are saved, although those
// that BSDF samples take beside the lamp remain. The two pictures share all other random numbers, and their
// difference is negligible.
TEST(Predicted, SkipsMostShadowRays) {
  for (const char* file : {"tncg15-room/tncg15-room.pbrt", "cornell-spheres/square-lamp-2.pbrt"}) {
    Scene scene = scene_from(file);
    scene.camera.width = scene.camera.height = 200;
    const auto rays = render_with_threads(scene, direct_settings(DirectEstimator::kShadowRays, 32));
    const auto predicted = render_with_threads(scene, direct_settings(DirectEstimator::kPredicted, 32));
    EXPECT_LT(predicted.statistics.rays.shadow, rays.statistics.rays.shadow / 3) << file;
    EXPECT_EQ(predicted.statistics.rays.camera, rays.statistics.rays.camera);
    EXPECT_EQ(predicted.statistics.dropped_samples, 0u);
    EXPECT_EQ(predicted.statistics.photon_bytes, 0u);
    // The noise of 16 samples is 0.0046 and 0.0014 (docs/accuracy.md).
    EXPECT_LT(compare(image_of(rays.film), image_of(predicted.film), {}).relmse, 1e-4) << file;
  }
}

// A point on the floor from which half of the light is hidden.
class WrongPrediction : public ::testing::Test {
 protected:
  static Scene half_hidden() {
    Scene scene;
    const uint32_t white = add_material(scene, Lambertian{Rgb(0.5f)});
    add_shape(scene, horizontal({0, 0, 0}, 4, 4, true, white));
    add_shape(scene, horizontal({0.5f, 0.5f, 0}, 0.5f, 0.5f, true, white));
    make_light(scene, add_shape(scene, horizontal({0, 1, 0}, 0.3f, 0.3f, false, white)), Rgb(2));
    look_at(scene, {-1, 0.3f, 0}, {0, 0, 0}, {0, 1, 0}, 1, 8, 8);
    finalize_scene(scene);
    return scene;
  }

  // Mean and standard error of the light at the origin if every photon on the floor had made the same record.
  Estimate light(std::optional<bool> all_said) {
    const PhotonMaps maps;
    std::unique_ptr<const photon::VisibilityTree> visibility;
    const photon::MortonCube cube = photon::MortonCube::around(scene_.bounds);
    if (all_said) {
      const uint64_t observation =
          photon::VisibilityTree::observation(cube, 0, Point3(0), {0, 1, 0}, *all_said);
      visibility = std::make_unique<photon::VisibilityTree>(cube, std::vector<uint64_t>(2000, observation));
    }
    const RenderContext ctx{{scene_, bvh_, settings_, plan_}, maps, visibility.get()};
    std::vector<double> values;
    for (uint64_t i = 0; i < 20000; ++i) {
      Sampler sampler(11, i);
      values.push_back(double(sample_direct(ctx, at_origin(), LightWeight::kAlone, sampler, counters_).x));
    }
    return estimate_of(values);
  }

  ShadingPoint at_origin() const {
    SurfaceInteraction si;
    EXPECT_TRUE(bvh_.intersect({{-1, 0.3f, 0}, {1, -0.3f, 0}}, &si));
    return {scene_, si, glm::normalize(Vector3(-1, 0.3f, 0))};
  }

  Scene scene_ = half_hidden();
  accel::Bvh bvh_{scene_};
  RenderSettings settings_;
  EstimatorPlan plan_;
  TileCounters counters_;
};

// Points of a low-discrepancy sequence scatter less than independent ones, so the standard errors are upper
// bounds.
TEST_F(WrongPrediction, IsUnbiased) {
  const Estimate rays = light({});
  const uint64_t traced = counters_.rays.shadow;
  EXPECT_EQ(traced, 20000u);
  for (const bool said : {true, false}) {
    counters_ = {};
    const Estimate misled = light(said);
    EXPECT_NEAR(misled.mean, rays.mean, 5 * std::hypot(misled.standard_error, rays.standard_error));
    EXPECT_LT(misled.standard_error, 0.1 * rays.mean);
    EXPECT_GT(misled.standard_error, rays.standard_error);
    EXPECT_LT(counters_.rays.shadow, 20000u / 14);  // p = 1/16
    EXPECT_GT(counters_.rays.shadow, 20000u / 18);
  }
}

// The plane under a point light of closed_form_test.cpp, with and without a plate above the visible point.
constexpr float kReflectance = 0.5f;
constexpr double kFootprint = 3 * 7e-5;

Scene plane_under_point_light(bool plate) {
  Scene scene;
  const uint32_t white = add_material(scene, Lambertian{Rgb(kReflectance)});
  add_shape(scene, horizontal({0, 0, 0}, 4, 4, true, white));
  if (plate) add_shape(scene, horizontal({0.2f, 0.5f, 0.1f}, 0.3f, 0.3f, true, white));
  look_at(scene, {2, 0.4f, 1.5f}, {0.5f, 0, 0.25f}, {0, 1, 0}, 0.001f, 8, 8);
  scene.lights.push_back(PointLight{{0, 1, 0}, Rgb(3)});
  finalize_scene(scene);
  return scene;
}

// Where there is no shadow photon there is no noise: every pixel matches the closed form.
TEST(Signed, LitRegionsHaveNoNoise) {
  const double expected = kReflectance * PointLightOverPlane{3, 1}.irradiance(0.3125) / double(kPi);
  for (const auto direct : {DirectEstimator::kSigned, DirectEstimator::kPredicted}) {
    const auto result = render_with_threads(plane_under_point_light(false), direct_settings(direct, 2));
    for (int y = 0; y < 8; ++y)
      for (int x = 0; x < 8; ++x)
        EXPECT_NEAR(double(result.film.at(x, y).direct.x), expected, expected * kFootprint);
  }
}

// Negative light in files: EXR keeps it, in the picture and in its layer, and PNG shows black.
void expect_files_show(const Film& film) {
  WriteOptions options;
  options.layers = layers_from_names({"direct"});
  const std::string exr = output_file("negative.exr"), png = output_file("negative.png");
  write_film(exr, film, options);
  write_film(png, film, options);
  const Image kept = read_image(exr), shown = read_image(png);
  for (int y = 0; y < film.height(); ++y)
    for (int x = 0; x < film.width(); ++x) {
      EXPECT_EQ(kept.at(x, y), film.at(x, y).direct);
      if (film.at(x, y).direct.x < 0) {
        EXPECT_EQ(shown.at(x, y), Rgb(0));
      }
    }
}

// In the umbra the shadow photons must cancel all light. The bounds are those of an estimate by direct
// photons, see PointLightPhotons.WithinKernelBiasAndNoise. The rest may be negative and is kept.
TEST(Signed, ShadowsAreDarkWithinKernelBiasAndNoise) {
  constexpr double kRadius = 0.05, kPhotons = 1e6;
  const PointLightOverPlane form{3, 1};
  double lowest = 0;
  for (const uint64_t seed : {1, 2, 3, 4}) {
    RenderSettings settings = direct_settings(DirectEstimator::kSigned, 1, seed);
    settings.photons = uint64_t(kPhotons);
    settings.radius = float(kRadius);
    const auto result = render_with_threads(plane_under_point_light(true), settings);
    const double rho = std::sqrt(0.3125);
    double curvature = 0;
    for (double d = -kRadius; d <= kRadius; d += kRadius / 16)
      curvature = std::max(curvature, std::abs(form.laplacian((rho + d) * (rho + d))));
    const double E = form.irradiance(rho * rho), flux = 4 * double(kPi) * form.I / kPhotons;
    const double in_reach = E * double(kPi) * kRadius * kRadius / flux;
    const double bound =
        kRadius * kRadius / 8 * curvature + 4 * E / std::sqrt(in_reach) + E * (kPackedFluxError + kFootprint);
    const double found = total_mean(result.film);
    EXPECT_NEAR(found, 0, kReflectance * bound / double(kPi));
    if (found < 0) expect_files_show(result.film);
    EXPECT_LT(bound, 0.3 * E);  // the test can fail
    EXPECT_EQ(result.statistics.dropped_samples, 0u);
    EXPECT_EQ(result.statistics.clamped_sums, 0u);
    EXPECT_EQ(result.statistics.photons.stored[size_t(photon::PhotonKind::kDirect)], 0u);
    lowest = std::min(lowest, found);
  }
  EXPECT_LT(lowest, 0);  // all four would be positive in one of sixteen cases; not with these seeds
}

// There are more lights than are summed: one is chosen, and the mean is the closed form of all.
TEST(Signed, ChoosingOneOfManyLightsIsUnbiased) {
  Scene scene = plane_under_point_light(false);
  scene.lights.clear();
  double expected = 0;
  for (int i = 0; i < int(kMostLightsSummed) + 4; ++i) {
    const Point3 p(0.2f * float(i) - 2, 1 + 0.05f * float(i), 0.1f * float(i % 5));
    scene.lights.push_back(PointLight{p, Rgb(1 + 0.3f * float(i % 7))});
    const double dx = double(p.x) - 0.5, dz = double(p.z) - 0.25;
    expected += PointLightOverPlane{1 + 0.3 * (i % 7), double(p.y)}.irradiance(dx * dx + dz * dz);
  }
  expected *= kReflectance / double(kPi);
  finalize_scene(scene);
  const auto result = render_with_threads(scene, direct_settings(DirectEstimator::kSigned, 256));
  std::vector<double> pixels;
  for (int y = 0; y < 8; ++y)
    for (int x = 0; x < 8; ++x) pixels.push_back(double(result.film.at(x, y).direct.x));
  const Estimate found = estimate_of(pixels);
  EXPECT_NEAR(found.mean, expected, 4 * found.standard_error + expected * kFootprint);
  EXPECT_LT(found.standard_error, 0.01 * expected);
}

// Several lights, one of them a point; glass, mirror and a plate that block light; borders of surfaces.
// Compares with shadow rays in every block, within the noise and the kernel's bias.
TEST(Signed, AgreesWithShadowRaysInEveryBlock) {
  const Scene scene = two_lights(kSize);
  const auto rays = films(scene, direct_settings(DirectEstimator::kShadowRays, 256, 100));
  for (const Kernel kernel : {Kernel::kConstant, Kernel::kEpanechnikov}) {
    RenderSettings settings = direct_settings(DirectEstimator::kSigned, 16, 200);
    settings.kernel = kernel;
    const auto wide = films(scene, settings);
    settings.radius = *settings.radius / 2;
    settings.seed = 300;
    const auto narrow = films(scene, settings);
    for (int block = -1; block < kSize / kBlock * (kSize / kBlock); ++block) {
      const Estimate reference = block_estimate(rays, Layer::kDirect, block);
      const Estimate found = block_estimate(wide, Layer::kDirect, block),
                     half = block_estimate(narrow, Layer::kDirect, block);
      const double noise =
          std::hypot(reference.standard_error, found.standard_error, 2 * half.standard_error);
      const double bias = 2 * std::abs(found.mean - half.mean) + kPackedLight * reference.mean;
      EXPECT_NEAR(found.mean, reference.mean, kErrors * noise + bias) << "block " << block;
      if (block < 0) {
        EXPECT_LT(kErrors * noise + bias, 0.1 * reference.mean);
      }
    }
    write_if_failed(wide[0], "signed");
  }
}

// Any number of threads, and passes split over two calls, give the same bits and the same counts.
TEST(DirectEstimators, AnyNumberOfThreadsAndAnySplitGivesTheSameBits) {
  const Scene scene = two_lights(20);
  for (const auto direct : {DirectEstimator::kPredicted, DirectEstimator::kSigned}) {
    RenderSettings settings = direct_settings(direct, 6);
    settings.method = Method::kMc;
    settings.photons = 30'000;
    settings.passes = 3;
    settings.radius = {};
    const auto sums = [&](int threads, RenderTask task) {
      const tbb::global_control allow(tbb::global_control::max_allowed_parallelism, size_t(threads));
      const accel::Bvh bvh(scene, threads);
      PassSums out;
      tbb::task_arena(threads).execute([&] { out = render(scene, bvh, settings, {}, std::move(task)).sums; });
      return out;
    };
    const PassSums whole = sums(1, {});
    PassSums parts = sums(3, {.passes = PassSet(1, 3)});
    parts.add(sums(2, {.passes = PassSet(0, 1)}));
    EXPECT_EQ(counters_json(parts.statistics), counters_json(whole.statistics));
    EXPECT_EQ(parts.radii, whole.radii);
    for (int y = 0; y < 20; ++y)
      for (int x = 0; x < 20; ++x)
        ASSERT_EQ(parts.totals.pixels().at(x, y), whole.totals.pixels().at(x, y)) << x << " " << y;
  }
}

}  // namespace
}  // namespace kaustik::render
