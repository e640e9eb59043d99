// Tests shading normals on photon paths (Veach 1997, section 5.3): photons must carry what camera paths find,
// which weigh by |wi.ns|.

#include <gtest/gtest.h>

#include "tests/photon/support/trace_scenes.h"
#include "tests/support/random.h"
#include "tests/support/shapes.h"
#include "tests/support/statistics.h"

namespace kaustik::photon {
namespace {

using namespace test;
using enum PhotonKind;

// An octahedron of radius 1 with the normals of the sphere: angles of up to 55 degrees between n and ns.
Shape smooth_octahedron(uint32_t material) {
  TriangleMesh mesh;
  mesh.P = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
  mesh.N = {mesh.P.begin(), mesh.P.end()};
  mesh.indices = {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}};
  Shape shape;
  shape.geometry = mesh;
  shape.material = material;
  return shape;
}

// The sum of the photons' flux with its standard error, which for a compound sum is the root of the sum of
// squares.
Estimate flux_of(const std::vector<Photon>& photons) {
  Estimate e;
  double squares = 0;
  for (const Photon& p : photons) {
    e.mean += static_cast<double>(p.flux.x);
    squares += static_cast<double>(p.flux.x) * static_cast<double>(p.flux.x);
  }
  e.standard_error = std::sqrt(squares);
  return e;
}

void expect_agree(const Estimate& a, const Estimate& b) {
  EXPECT_NEAR(a.mean, b.mean, 4 * std::hypot(a.standard_error, b.standard_error));
  EXPECT_LT(std::hypot(a.standard_error, b.standard_error), 0.02 * a.mean) << "too noisy to say anything";
}

// A point light near the octahedron in a black room. Camera paths weigh light from wi at a surface point by
// |wi.ns|, where wi is on the same side of n and ns.
TEST(ShadingNormals, DepositsAndReflectionAgreeWithCameraPaths) {
  const Point3 light(0.8f, 1.0f, 0.7f);
  const float rho = 0.8f;
  Scene scene;
  scene.materials = {Lambertian{Rgb(rho)}, Lambertian{Rgb(0)}};
  scene.shapes = {smooth_octahedron(0)};
  scene.shapes[0].surface_group = 100;
  add_box(scene, 5, 1);
  scene.lights = {PointLight{light, Rgb(1)}};
  finalize_scene(scene);
  const accel::Bvh bvh(scene);

  // Two integrals over the mesh. The received light is E_s = I |wi.ns| / d^2. The reflected light is rho / pi
  // times E_s times the integral of |w.n| over the overlap of both hemispheres, pi (1 + n.ns) / 2, plus,
  // where n and ns disagree and camera paths shade with n, rho / pi times E_n = I |wi.n| / d^2 times the
  // rest, pi (1 - n.ns) / 2.
  Mean received, reflected;
  Random random(3);
  const double area = surface_area(scene.shapes[0]);
  for (int i = 0; i < 200000; ++i) {
    const Hit at{1, 0, static_cast<uint32_t>(8 * random.uniform()),
                 sample_uniform_triangle(random.uniform_2d())};
    const SurfaceInteraction si = make_interaction(scene.shapes, {}, at);
    const Vector3 to_light = light - si.p;
    const Vector3 wi = glm::normalize(to_light);
    const bool one_side = glm::dot(wi, si.n) * glm::dot(wi, si.ns) > 0;
    // An octahedron is convex, so exactly the points that face the light see it.
    const bool visible = glm::dot(wi, si.n) > 0;
    const double E =
        one_side && visible ? static_cast<double>(glm::dot(wi, si.ns) / length_squared(to_light)) : 0;
    const double E_n = visible ? static_cast<double>(glm::dot(wi, si.n) / length_squared(to_light)) : 0;
    const double rho_half = 0.5 * static_cast<double>(rho);
    const auto n_ns = static_cast<double>(glm::dot(si.n, si.ns));
    received.add(area * E);
    reflected.add(area * rho_half * (E * (1 + n_ns) + E_n * (1 - n_ns)));
  }

  const Traced t = trace_all(scene, settings_for(400000, {true, false, false, true}));
  std::vector<Photon> on_mesh;
  for (const Photon& p : t[kDirect])
    if (p.surface_group == 100) on_mesh.push_back(p);
  expect_agree(flux_of(on_mesh), received.estimate());
  for (const Photon& p : t[kIndirect]) ASSERT_NE(p.surface_group, 100u);
  expect_agree(flux_of(t[kIndirect]), reflected.estimate());
}

// Light from a wide light reaches a wall by way of a smooth-shaded specular octahedron. Camera paths go from
// a random point of the wall in a cosine-distributed direction to the octahedron, and on by its delta lobes
// about ns until they meet the light.
void expect_specular_agrees(const Bsdf& bsdf) {
  Scene scene;
  scene.materials = {Lambertian{Rgb(0)}, bsdf};
  scene.shapes = {smooth_octahedron(1), parallelogram({-1, -3, -3}, {0, 6, 0}, {0, 0, 6})};
  std::get<TriangleMesh>(scene.shapes[1].geometry).P = {
      {-1.5f, -3, -4}, {-1.5f, 3, -4}, {-1.5f, 3, 4}, {-1.5f, -3, 4}};
  add_light(scene, parallelogram({-1.4f, 1.5f, -2.5f}, {4, 0, 0}, {0, 0, 5}), Rgb(1));
  finalize_scene(scene);
  const accel::Bvh bvh(scene);
  const uint32_t wall = 1, light = 2;

  Mean camera;
  Random random(4);
  const double area = surface_area(scene.shapes[wall]);
  for (int i = 0; i < 1000000; ++i) {
    SurfaceInteraction si = make_interaction(
        scene.shapes, {},
        {1, wall, static_cast<uint32_t>(2 * random.uniform()), sample_uniform_triangle(random.uniform_2d())});
    const float distance = glm::length(si.p), sine = 1 / distance;
    const float one_minus_cos = sine * sine / (1 + std::sqrt(1 - sine * sine));
    const Vector3 d =
        Frame::from_z(-si.p / distance).to_world(sample_uniform_cone(random.uniform_2d(), one_minus_cos));
    Ray ray = si.spawn(d);
    double radiance = 0, weight = area * static_cast<double>(d.x / uniform_cone_pdf(one_minus_cos));
    bool specular = false;
    for (int bounce = 0; bounce < 20 && bvh.intersect(ray, &si); ++bounce) {
      if (si.shape == light && specular) radiance = weight * (glm::dot(si.n, ray.d) < 0 ? 1 : 0);
      if (si.material == 0) break;
      specular = true;
      const Frame frame = Frame::from_z(si.ns);
      const Vector3 wo = -ray.d, wo_local = frame.to_local(wo);
      if (glm::dot(wo, si.n) * wo_local.z <= 0) break;
      const auto sample = std::visit(
          [&](const auto& b) {
            return b.sample_f(wo_local, random.uniform(), {0, 0}, TransportMode::kRadiance);
          },
          bsdf);
      if (!sample) break;
      const Vector3 wi = frame.to_world(sample->wi);
      if (glm::dot(wi, si.n) * sample->wi.z <= 0) break;
      weight *= static_cast<double>(sample->weight.x);
      ray = si.spawn(wi);
    }
    camera.add(radiance);
  }

  TraceSettings settings = settings_for(1000000, {false, false, true, false});
  settings.max_bounces = 20;
  const Traced t = trace_all(scene, settings);
  std::vector<Photon> on_wall;
  for (const Photon& p : t[kCaustic])
    if (std::abs(p.p.x + 1.5f) < 1e-4f) on_wall.push_back(p);
  const Estimate photons = flux_of(on_wall), paths = camera.estimate();
  EXPECT_NEAR(photons.mean, paths.mean, 4 * std::hypot(photons.standard_error, paths.standard_error));
  EXPECT_LT(std::hypot(photons.standard_error, paths.standard_error), 0.02 * paths.mean)
      << "too noisy to say anything";
}

TEST(ShadingNormals, MirrorAgreesWithCameraPaths) {
  expect_specular_agrees(Mirror{Rgb(0.9f)});
}

// Camera paths change radiance by eta^2 on their way into and out of glass, photons do not change flux;
// shading normals affect both.
TEST(ShadingNormals, GlassAgreesWithCameraPaths) {
  expect_specular_agrees(Dielectric{1.5f});
}

// Unit vector in the plane z = 0, at an angle from +y towards +x.
Vector3 at_degrees(double a) {
  return Vector3(static_cast<float>(std::sin(a * M_PI / 180)), static_cast<float>(std::cos(a * M_PI / 180)),
                 0);
}

double cos_degrees(double a) {
  return std::cos(a * M_PI / 180);
}

// Half a square metre in the plane y = 0, with a shading normal tilted towards +x.
Shape tilted_triangle(double degrees, uint32_t material) {
  TriangleMesh mesh;
  mesh.P = {{0, 0, 0}, {0, 0, 1}, {1, 0, 0}};
  mesh.N = std::vector<Normal3>(3, at_degrees(degrees));
  mesh.indices = {{0, 1, 2}};
  Shape shape;
  shape.geometry = mesh;
  shape.material = material;
  return shape;
}

// A specular tilted triangle under parallel light of irradiance 1 from the angle `from` to its left. One lobe
// leaves at the angle `to`, and two screens around catch it. All of these are angles to the geometric normal,
// which gives the true flux: a camera that looks along the lobe sees, by the delta lobe about ns, radiance of
// the beam, so the area seen under |cos to| counts, and not |cos from|.
void expect_lobe(const Bsdf& bsdf, double tilt, double from, double to, double expected_flux) {
  Scene scene;
  scene.materials = {Lambertian{Rgb(0)}, bsdf};
  scene.shapes = {tilted_triangle(tilt, 1), parallelogram({2, 0, -1}, {0, 2, 0}, {0, 0, 3}),
                  parallelogram({-1, -1, -1}, {3, 0, 0}, {0, 0, 3})};
  scene.lights = {DistantLight{at_degrees(-from), Rgb(1)}};
  finalize_scene(scene);
  const Traced t = trace_all(scene, settings_for(600000, {false, false, true, false}));
  std::vector<Photon> lobe;
  for (const Photon& p : t[kCaustic])
    if (glm::length(p.wi + at_degrees(to)) < 1e-4f) lobe.push_back(p);
  const Estimate flux = flux_of(lobe);
  EXPECT_NEAR(flux.mean, expected_flux, 4 * flux.standard_error);
  EXPECT_LT(flux.standard_error, 0.03 * expected_flux) << "too noisy to say anything";
}

// With equal angles about ns, |wo.ns| = |wi.ns|, so the lobe's flux is the area times |cos to|.
TEST(ShadingNormals, MirrorOnATiltedTriangleMatchesTheClosedForm) {
  expect_lobe(Mirror{}, 10, 45, 65, 0.5 * cos_degrees(65));
  expect_lobe(Mirror{}, -10, 65, 45, 0.5 * cos_degrees(45));
}

// Refraction about ns transmits 1 - F of the light, times |wo.ns| / |wi.ns| of the two angles to ns.
TEST(ShadingNormals, GlassOnATiltedTriangleMatchesTheClosedForm) {
  for (double tilt : {20.0, -20.0}) {
    const double theta_i = 45 + tilt, theta_t = std::asin(std::sin(theta_i * M_PI / 180) / 1.5) * 180 / M_PI;
    const double ci = cos_degrees(theta_i), ct = cos_degrees(theta_t);
    const double rs = (ci - 1.5 * ct) / (ci + 1.5 * ct), rp = (1.5 * ci - ct) / (1.5 * ci + ct);
    const double transmitted = 1 - 0.5 * (rs * rs + rp * rp);
    const double to = 180 + tilt - theta_t;
    expect_lobe(Dielectric{1.5f}, tilt, 45, to, 0.5 * transmitted * (ci / ct) * std::abs(cos_degrees(to)));
  }
}

// Parallel light comes from 45 degrees on the other side of a tilt of 30 degrees: the irradiance is L |wi.ns|
// = L cos 75, where the geometric normal would give L cos 45.
TEST(ShadingNormals, DepositOnATiltedTriangleMatchesTheClosedForm) {
  Scene scene;
  scene.materials = {Lambertian{Rgb(0.5f)}};
  scene.shapes = {tilted_triangle(30, 0)};
  scene.lights = {DistantLight{at_degrees(-45), Rgb(1)}};
  finalize_scene(scene);
  const uint64_t n = 100000;
  const Traced t = trace_all(scene, settings_for(n, {true, false, false, false}));
  const double power_per_photon = static_cast<double>(power(scene.lights[0]).x) / static_cast<double>(n);
  const double cos_ns = cos_degrees(75), cos_n = cos_degrees(45);
  for (const Photon& p : t[kDirect]) {
    // The cosines of unit floats are off by a few roundings, relative to cos 75.
    ASSERT_NEAR(p.flux.x / power_per_photon, cos_ns / cos_n, 1e-5);
    ASSERT_EQ(p.n, Normal3(0, 1, 0));
  }
  const Estimate flux = flux_of(t[kDirect]);
  EXPECT_NEAR(flux.mean, 0.5 * cos_ns, 4 * flux.standard_error);
  // Light from below the shading horizon, yet above the geometric one, leaves no photon.
  scene.lights = {DistantLight{at_degrees(-70), Rgb(1)}};
  finalize_scene(scene);
  EXPECT_TRUE(trace_all(scene, settings_for(1000, {true, true, true, true}))[kDirect].empty());
}

}  // namespace
}  // namespace kaustik::photon
