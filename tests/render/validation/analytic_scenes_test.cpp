// Tests the analytic scenes of the scenes/ folder: every pixel against the closed form that the file states.

#include <gtest/gtest.h>

#include "tests/render/support/closed_forms.h"
#include "tests/render/support/image_statistics.h"
#include "tests/render/support/scene_files.h"
#include "tests/support/packed_flux.h"

namespace kaustik::test {
namespace {

constexpr double kRho = 0.5;

// The point of the plane y = 0 that a raster position shows.
glm::dvec3 on_plane(const Camera& camera, double x, double y) {
  const Ray ray = camera.generate_ray({float(x), float(y)});
  const glm::dvec3 o(ray.o), d(ray.d);
  return o - d * (o.y / d.y);
}

// The least and the largest value of a form over the points of the plane in a pixel, from a grid that
// includes the pixel's corners.
template <class Form>
std::pair<double, double> over_pixel(const Camera& camera, int x, int y, Form&& form) {
  constexpr int kGrid = 4;
  double low = 1e30, high = -1e30;
  for (int j = 0; j <= kGrid; ++j)
    for (int i = 0; i <= kGrid; ++i) {
      const double v = form(on_plane(camera, x + i / double(kGrid), y + j / double(kGrid)));
      low = std::min(low, v);
      high = std::max(high, v);
    }
  return {low, high};
}

Film render_file(const Scene& scene, Method method, int spp, uint64_t seed = 1) {
  RenderSettings settings;
  settings.method = method;
  settings.spp = spp;
  settings.seed = seed;
  settings.max_bounces = 64;
  settings.photons = 100'000;
  settings.radius = 0.1f;
  return render_with_threads(scene, settings).film;
}

// A point light has no noise: each sample of a pixel lies between the least and the largest radiance on the
// pixel, up to the grid's resolution (a sixteenth of the range, generous for a smooth form) and float
// rounding.
TEST(AnalyticScenes, PointOverPlaneHoldsInEveryPixel) {
  const Scene scene = scene_from("point-over-plane/point-over-plane.pbrt");
  const PointLightOverPlane light{1, 1};
  for (const Method method : {Method::kRaytrace, Method::kMc}) {
    const Film film = render_file(scene, method, 4);
    for (int y = 0; y < film.height(); ++y)
      for (int x = 0; x < film.width(); ++x) {
        const auto [low, high] = over_pixel(scene.camera, x, y, [&](const glm::dvec3& p) {
          return kRho / double(kPi) * light.irradiance(p.x * p.x + p.z * p.z);
        });
        const double slack = (high - low) / 16 + 1e-5 * high;
        const double found = double(film.at(x, y).radiance().x);
        ASSERT_TRUE(found >= low - slack && found <= high + slack)
            << "pixel " << x << " " << y << ": " << found << " not in " << low << " to " << high;
      }
    write_if_failed(film, "point_over_plane");
  }
}

// The samples of neighbouring pixels are independent, so blocks of 8 x 8 pixels measure the standard error of
// their own mean (the variation of the closed form within a block only makes it larger). Over 256 blocks 5
// standard errors with 63 degrees of freedom are exceeded once in 1000.
TEST(AnalyticScenes, PolygonOverPlaneHoldsInEveryBlock) {
  const Scene scene = scene_from("polygon-over-plane/polygon-over-plane.pbrt");
  const std::vector<glm::dvec3> light = {{-0.3, 1, -0.2}, {0.4, 1, -0.1}, {-0.1, 1, 0.3}};
  constexpr int kBlock = 8;
  const Film film = render_file(scene, Method::kRaytrace, 64);
  int blocks = 0;
  for (int by = 0; by < film.height(); by += kBlock)
    for (int bx = 0; bx < film.width(); bx += kBlock) {
      std::vector<double> differences;
      double mean = 0;
      for (int y = by; y < by + kBlock; ++y)
        for (int x = bx; x < bx + kBlock; ++x) {
          // Pixels that show the light's back, fully or partly, are left out.
          if (film.at(x, y).albedo.x != float(kRho)) continue;
          const glm::dvec3 p = on_plane(scene.camera, x + 0.5, y + 0.5);
          const double expected = kRho / double(kPi) * lambert_polygon(light, p, {0, 1, 0}, 10);
          differences.push_back(double(film.at(x, y).radiance().x) - expected);
          mean += expected;
        }
      if (differences.size() < size_t(kBlock * kBlock)) continue;
      ++blocks;
      const Estimate d = estimate_of(differences);
      // A pixel's mean differs from its centre's value by the curvature: 1e-3 of the value at pixels of 0.02
      // m.
      EXPECT_NEAR(d.mean, 0, 5 * d.standard_error + 1e-3 * mean / (kBlock * kBlock))
          << "block at " << bx << " " << by;
    }
  EXPECT_GT(blocks, 200);
  write_if_failed(film, "polygon_over_plane");
}

// The radiance is Le / (1 - rho) = 2. The photon estimate has no kernel bias on a sphere (a cap of chord r
// has the area pi r^2), so only the rounding of packed fluxes remains. Eight seeds: 5 standard errors.
TEST(AnalyticScenes, FurnaceIsTwoEverywhere) {
  const Scene scene = scene_from("furnace/furnace.pbrt");
  for (const Method method : {Method::kMc, Method::kHybrid, Method::kPhoton, Method::kAuto}) {
    std::vector<double> means;
    for (uint64_t seed = 1; seed <= 8; ++seed)
      means.push_back(total_mean(render_file(scene, method, 1, seed)));
    const Estimate found = estimate_of(means);
    EXPECT_NEAR(found.mean, 2, 5 * found.standard_error + 2 * kPackedFluxError) << int(method);
    EXPECT_LT(found.standard_error, 0.02) << int(method);
  }
}

}  // namespace
}  // namespace kaustik::test
