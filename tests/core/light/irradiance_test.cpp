// Tests the irradiance of every light at an unoccluded point, as the mean over sample_Li, against its closed
// form.

#include <gtest/gtest.h>

#include "core/light/light.h"
#include "core/sampling/warp.h"
#include "tests/core/support/chi_square.h"
#include "tests/support/random.h"
#include "tests/support/shapes.h"
#include "tests/support/statistics.h"

namespace kaustik {
namespace {

using test::Random;

test::Mean irradiance(const Light& light, const LightReceiver& x, int samples) {
  Random random(9);
  test::Mean mean;
  for (int i = 0; i < samples; ++i) {
    const auto s = sample_Li(light, x, random.uniform_2d());
    mean.add(s ? s->Li.x * std::max(0.0f, glm::dot(s->wi, x.n)) / s->pdf : 0);
  }
  return mean;
}
test::Mean irradiance(const Light& light, const Point3& ref, const Normal3& n, int samples = 100000) {
  return irradiance(light, {ref, n, true}, samples);
}

// The tolerance is 4.5 standard errors, plus float rounding for estimators without variance.
void expect_mean(const test::Mean& mean, double expected) {
  EXPECT_NEAR(mean.mean, expected, 4.5 * mean.standard_error() + 1e-5 * expected);
}

// Lambert 1760: E = L/2 times the sum over edges of the angle of the edge times the component of its plane's
// normal along n. Vertices run counter-clockwise as seen from the point.
double polygon_irradiance(double L, const std::vector<Point3>& vertices, const Point3& ref,
                          const Normal3& n) {
  glm::dvec3 sum(0);
  for (size_t i = 0; i < vertices.size(); ++i) {
    const glm::dvec3 a = glm::normalize(glm::dvec3(vertices[i] - ref));
    const glm::dvec3 b = glm::normalize(glm::dvec3(vertices[(i + 1) % vertices.size()] - ref));
    sum += std::acos(glm::dot(a, b)) * glm::normalize(glm::cross(a, b));
  }
  return 0.5 * L * std::abs(glm::dot(sum, glm::dvec3(n)));
}

TEST(Irradiance, TriangleLight) {
  const Point3 a(-0.5f, -0.3f, 1), b(0.2f, 0.9f, 1.3f), c(1, -0.2f, 0.8f);
  const Normal3 n(0, 0, 1);
  for (const Point3& ref : {Point3(0, 0, 0), Point3(2, 1, -1), Point3(-0.2f, 0.1f, 0.7f)}) {
    const auto light = DiffuseAreaLight::make(test::triangle(a, b, c), Rgb(4), true);
    expect_mean(irradiance(*light, ref, n), polygon_irradiance(4, {a, b, c}, ref, n));
  }
}

TEST(Irradiance, PolygonLightOfManyTriangles) {
  std::vector<Point3> hexagon;
  for (int i = 0; i < 6; ++i) {
    const double phi = i * std::numbers::pi / 3;
    hexagon.emplace_back(std::cos(phi), 0.5 * std::sin(phi), 2);
  }
  Shape shape;
  shape.geometry = TriangleMesh{hexagon, {}, {}, {{0, 2, 1}, {0, 3, 2}, {0, 4, 3}, {0, 5, 4}}};
  const auto light = DiffuseAreaLight::make(shape, Rgb(1), false);
  const Normal3 n = glm::normalize(Vector3(0.2f, -0.1f, 1));
  expect_mean(irradiance(*light, {0.4f, 0.2f, 0}, n), polygon_irradiance(1, hexagon, {0.4f, 0.2f, 0}, n));
}

// E = pi L (r/d)^2 cos while the whole sphere is above the horizon. Tests very near and very far spheres too.
TEST(Irradiance, SphereLight) {
  for (const double distance : {1.01, 1.5, 10.0, 1e4, 1e7}) {
    const auto light = DiffuseAreaLight::make(test::sphere(Point3(0, 0, distance), 1), Rgb(2), false);
    const Normal3 facing(0, 0, 1);
    expect_mean(irradiance(*light, Point3(0), facing), 2 * std::numbers::pi / (distance * distance));
    if (distance < 10) continue;
    const Normal3 tilted = glm::normalize(Vector3(1, 0, 1));
    expect_mean(irradiance(*light, Point3(0), tilted),
                std::sqrt(2.0) * std::numbers::pi / (distance * distance));
  }
}

// Inside a closed light the radiance is L from every direction: E = pi L.
TEST(Irradiance, InsideASphereLight) {
  const auto light = DiffuseAreaLight::make(test::sphere({1, 2, 3}, 5, 0, true), Rgb(2), false);
  expect_mean(irradiance(*light, {2, 1, 5}, {0, 0, 1}), 2 * std::numbers::pi);
  const auto outward = DiffuseAreaLight::make(test::sphere({1, 2, 3}, 5), Rgb(2), false);
  EXPECT_FALSE(outward->sample_Li({2, 1, 5}, {0.5f, 0.5f}));
}

// The irradiance of a coaxial disk is E = pi L r^2 / (r^2 + h^2); that of an annulus is the difference of
// two.
TEST(Irradiance, DiskAndAnnulusLight) {
  const auto light = [](float inner) {
    Shape shape;
    shape.geometry = Disk{Transform::from_matrix(test::affine(glm::dmat3(1.5), {0, 0, 2})), inner};
    shape.flip_normal = true;  // shines down
    return *DiffuseAreaLight::make(shape, Rgb(3), false);
  };
  const auto disk = [](double r) { return 3 * std::numbers::pi * r * r / (r * r + 4); };
  expect_mean(irradiance(light(0), Point3(0), {0, 0, 1}), disk(1.5));
  expect_mean(irradiance(light(0.5f), Point3(0), {0, 0, 1}), disk(1.5) - disk(0.75));
  EXPECT_FALSE(light(0).sample_Li({0, 0, 4}, {0.5f, 0.5f}));  // from behind
}

TEST(Irradiance, PointSpotDistantAndInfiniteLights) {
  const PointLight point{{0, 3, 4}, Rgb(10)};
  expect_mean(irradiance(point, Point3(0), {0, 0, 1}, 2), 10.0 / 25 * 4 / 5);
  SpotLight spot;
  spot.position = {0, 3, 4};
  spot.frame = Frame::from_z({0, 0, -1});
  spot.I = Rgb(10);
  spot.cos_falloff_start = 0.9f;
  spot.cos_total_width = 0.7f;
  // cos = 0.8 lies half way through the falloff: smoothstep(1/2) = 1/2.
  expect_mean(irradiance(spot, Point3(0), {0, 0, 1}, 2), 0.5 * 10.0 / 25 * 4 / 5);
  EXPECT_FALSE(spot.sample_Li({0, 9, 0}, {0.5f, 0.5f}));
  const DistantLight distant{glm::normalize(Vector3(0, 3, 4)), Rgb(10), Point3(0), 1};
  expect_mean(irradiance(distant, Point3(0), {0, 0, 1}, 2), 8);
  const InfiniteLight infinite{Rgb(2), Point3(0), 1};
  expect_mean(irradiance(infinite, Point3(0), {0, 0, 1}), 2 * std::numbers::pi);
  // At a diffuse receiver a single sample gives all of the irradiance.
  expect_mean(irradiance(infinite, {Point3(0), {0, 0.6f, 0.8f}, false}, 2), 2 * std::numbers::pi);
}

}  // namespace
}  // namespace kaustik
