// Tests media that scatter against closed forms: single scattering, the furnace, and the half space.

#include <gtest/gtest.h>

#include "core/medium/phase_function.h"
#include "render/maps/photon_shoots.h"
#include "tests/render/support/class_agreement.h"
#include "tests/render/support/media_scenes.h"

namespace kaustik::render {
namespace {

using namespace test;

constexpr int kTests = 8;  // pixels along each side of small pictures, all of the same expected value

using Layers = std::vector<Rgb PixelResult::*>;
const Layers kAllLayers = {&PixelResult::emitted, &PixelResult::direct, &PixelResult::caustic,
                           &PixelResult::indirect};

// Mean over the pixels of the sum of some layers, and its standard error from renders of different seeds,
// since the pixels of one share photons.
Estimate mean_of(const std::vector<Film>& renders, const Layers& layers, int c) {
  std::vector<double> means;
  for (const Film& film : renders) {
    double sum = 0;
    for (int y = 0; y < film.height(); ++y)
      for (int x = 0; x < film.width(); ++x)
        for (const auto layer : layers) sum += double((film.at(x, y).*layer)[c]);
    means.push_back(sum / (film.width() * film.height()));
  }
  return estimate_of(means);
}

RenderSettings settings_for(Method method, int spp, uint64_t photons = 100'000) {
  RenderSettings settings;
  settings.method = method;
  settings.spp = spp;
  settings.adaptive = 0;
  settings.photons = photons;
  return settings;
}

// Single scattering of a point light beside the view, in a medium without end but for a black wall at z = -4:
//   L = I int_0^8 density(z) sigma_s exp(-sigma_t (D(t) + D(r))) p(angle) / r^2 dt
// with a density of 1 + slope z, whose column densities D are its mean on a way times the way's length.
void expect_single_scattering(Medium medium, double slope, Method method) {
  const auto density = [&](const glm::dvec3& p) { return 1 + slope * p.z; };
  if (slope != 0) medium.density = grid_of({3, 3, 12}, {-20, -20, -6}, {20, 20, 6}, density);
  const glm::dvec3 lamp(0.7, 0.2, 1), eye(0, 0, 4);
  Scene scene;
  add_shape(scene, quad({-9, -9, -4}, {9, -9, -4}, {9, 9, -4}, {-9, 9, -4},
                        add_material(scene, Lambertian{Rgb(0)})));
  scene.lights.push_back(PointLight{Point3(lamp), Rgb(2)});
  look_at(scene, {0, 0, 4}, {0, 0, -4}, {0, 1, 0}, 0.01f, kTests, kTests);
  scene.media = {Medium{}, medium};
  scene.camera_medium = 1;
  scene.light_media = {1};
  finalize_scene(scene);
  const std::vector<Film> found = films(scene, settings_for(method, 16));
  for (int c = 0; c < 3; ++c) {
    const double sigma = double(medium.sigma_t()[c]);
    double expected = 0;
    constexpr int kSteps = 20'000;
    for (int i = 0; i < kSteps; ++i) {
      const double t = 8.0 * (i + 0.5) / kSteps;
      const glm::dvec3 p(0, 0, 4 - t), from = p - lamp;
      const double r = glm::length(from), cosine = from.z / r;  // the light goes on along +z
      const double column = t * density((p + eye) / 2.0) + r * density((p + lamp) / 2.0);
      expected += density(p) * double(medium.sigma_s[c]) * std::exp(-sigma * column) / (r * r) *
                  double(phase(float(cosine), medium.g)) * 2 * 8.0 / kSteps;
    }
    const Estimate direct = mean_of(found, {&PixelResult::direct}, c);
    EXPECT_NEAR(direct.mean, expected, kErrors * direct.standard_error + 1e-4 * expected) << c;
    EXPECT_LT(direct.standard_error, 0.01 * expected) << c;
  }
  // The wall is black.
  EXPECT_EQ(found[0].at(1, 2).media_direct, found[0].at(1, 2).direct);
  write_if_failed(found[0], "single_scattering");
}

class SingleScattering : public ::testing::TestWithParam<Method> {};

TEST_P(SingleScattering, OfAPointLightIsAnIntegral) {
  for (const double slope : {0.0, 0.2})
    expect_single_scattering({{0.1f, 0.2f, 0}, {0.2f, 0.4f, 0.1f}, 0.5f}, slope, GetParam());
}
INSTANTIATE_TEST_SUITE_P(Methods, SingleScattering,
                         ::testing::Values(Method::kRaytrace, Method::kMc, Method::kPhoton, Method::kAuto));

// Black walls of radiance 1 around a medium that absorbs nothing: the radiance is 1 everywhere and into all
// directions. Near the walls a part of the kernel lies behind them: a tenth of a metre of some 2 m.
class FurnaceOfAMedium : public ::testing::TestWithParam<Method> {};

TEST_P(FurnaceOfAMedium, RadianceIsOne) {
  Scene scene;
  add_glowing_walls(scene, add_material(scene, Lambertian{Rgb(0)}), Rgb(1));
  scene.media = {Medium{}, Medium{Rgb(0), {0.5f, 1, 2}, -0.3f}};
  scene.camera_medium = 1;
  scene.light_media.assign(scene.lights.size(), 1);
  look_at(scene, {0.2f, -0.1f, 0.3f}, {-0.3f, 0.2f, -1}, {0, 1, 0}, 40, kTests, kTests);
  finalize_scene(scene);
  RenderSettings settings = settings_for(GetParam(), 64, 200'000);
  settings.max_bounces = 200;
  settings.radius = 0.1f;
  const std::vector<Film> found = films(scene, settings);
  for (int c = 0; c < 3; ++c) {
    const Estimate all = mean_of(found, kAllLayers, c);
    const double bias = GetParam() == Method::kMc ? 1e-4 : 0.03;
    EXPECT_NEAR(all.mean, 1, kErrors * all.standard_error + bias) << c;
    EXPECT_LT(all.standard_error, 0.02) << c;
  }
  write_if_failed(found[0], "furnace_of_a_medium");
}
INSTANTIATE_TEST_SUITE_P(Methods, FurnaceOfAMedium,
                         ::testing::Values(Method::kMc, Method::kPhoton, Method::kAuto));

// Few photons of this box pass its glass ball or its mirror ball: each of their segments in fog gets the same
// number of photons, which makes about half as many as are emitted.
TEST(CausticsInMedia, LeaveMorePhotonsWhereTheyAreRare) {
  const Scene scene = coloured_cornell(4);
  RenderSettings settings = settings_for(Method::kPhoton, 1);
  settings.guide = Guide::kOff;
  const auto in_media = [](const auto& counts) { return counts[size_t(photon::PhotonKind::kMediumCaustic)]; };
  const uint64_t stored = in_media(render_with_threads(scene, settings).statistics.photons.stored);
  const auto one_each = trace_settings(settings, make_plan(settings, scene.needs),
                                       pass_share(0, 1, settings.photons, settings.spp));
  const uint64_t segments = in_media(photon::shoot(scene, accel::Bvh(scene), one_each).counters.stored);
  ASSERT_GT(segments, 0u);
  const uint64_t on_segment = stored / segments;
  EXPECT_GE(on_segment, 2u);
  EXPECT_EQ(stored, on_segment * segments);
  // The number on a segment is rounded down, and comes from 2^14 photons. At least 5 % of them become
  // caustics, whose count has this relative error.
  EXPECT_NEAR(double(stored), 0.5 * double(settings.photons),
              double(segments) + kErrors * double(stored) / std::sqrt(0.05 * 0x1p14));
}

// Chandrasekhar's H for isotropic scattering (1960, Radiative Transfer, section 16), by iteration of
//   1 / H(mu) = sqrt(1 - albedo) + albedo / 2 int_0^1 x H(x) / (mu + x) dx.
double chandrasekhar_h(double albedo, double mu) {
  constexpr int kPoints = 400;
  std::vector<double> h(kPoints, 1);
  const auto x_of = [](int i) { return (i + 0.5) / kPoints; };
  const auto next = [&](double at) {
    double sum = 0;
    for (int i = 0; i < kPoints; ++i) sum += x_of(i) * h[size_t(i)] / (at + x_of(i));
    return 1 / (std::sqrt(1 - albedo) + albedo / 2 * sum / kPoints);
  };
  for (int round = 0; round < 60; ++round) {
    std::vector<double> better(h.size());
    for (int i = 0; i < kPoints; ++i) better[size_t(i)] = next(x_of(i));
    h = better;
  }
  return next(mu);
}

// A half space under a sky of radiance 1, whose boundary neither reflects nor bends: what it sends back is
// 1 - sqrt(1 - albedo) H(mu), however the density changes with the depth.
class HalfSpace : public ::testing::TestWithParam<Method> {};

TEST_P(HalfSpace, ReflectsByChandrasekharsH) {
  const Rgb albedo(0.3f, 0.6f, 0.9f);
  Scene scene;
  const uint32_t clear = add_material(scene, Dielectric{1});
  const auto density = grid_of({3, 120, 3}, {-20, -12, -20}, {20, 1, 20},
                               [](const glm::dvec3& p) { return 1 + 0.7 * std::sin(2 * p.y); });
  scene.media = {Medium{}, Medium{1.0f - albedo, albedo, 0, density}};
  add_shape(scene, horizontal({0, 0, 0}, 12, 12, true, clear)).media = {1, kVacuum};
  add_shape(scene, horizontal({0, -12, 0}, 12, 12, false, add_material(scene, Lambertian{Rgb(0)})));
  scene.lights.push_back(InfiniteLight{Rgb(1)});
  const float mu = 0.6f;
  // Parallel rays onto the middle of the plane.
  look_at(scene, {0, 8 * mu, 8 * std::sqrt(1 - mu * mu)}, {0, 0, 0}, {0, 1, 0}, 90, kTests, kTests);
  scene.camera.projection = OrthographicProjection{};
  scene.camera.screen_window = {-3, 3, -3, 3};
  finalize_scene(scene);
  RenderSettings settings = settings_for(GetParam(), GetParam() == Method::kMc ? 256 : 4, 500'000);
  settings.max_bounces = 300;
  settings.radius = 0.1f;
  const std::vector<Film> found = films(scene, settings);
  for (int c = 0; c < 3; ++c) {
    const double expected =
        1 - std::sqrt(1 - double(albedo[c])) * chandrasekhar_h(double(albedo[c]), double(mu));
    const Estimate all = mean_of(found, kAllLayers, c);
    const double bias = GetParam() == Method::kMc ? 1e-3 : 0.1;
    EXPECT_NEAR(all.mean, expected, kErrors * all.standard_error + bias * expected) << c;
    EXPECT_LT(all.standard_error, 0.03 * expected) << c;
  }
  write_if_failed(found[0], "half_space");
}
INSTANTIATE_TEST_SUITE_P(Methods, HalfSpace, ::testing::Values(Method::kMc, Method::kPhoton));

}  // namespace
}  // namespace kaustik::render
