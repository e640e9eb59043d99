// Tests dispersion against geometrical optics: prisms, rainbows, and the white that spectra add up to.

#include <gtest/gtest.h>

#include "core/spectrum/refractive_index.h"
#include "photon/shoot/shoot.h"
#include "render/camera/shading_point.h"
#include "tests/render/support/class_agreement.h"

namespace kaustik::render {
namespace {

using namespace test;

constexpr double kDegree = std::numbers::pi / 180;

uint32_t add_glass(Scene& scene, const Spectrum& eta) {
  const uint32_t glass = add_material(scene, Dielectric{});
  scene.materials[glass].disperse(std::make_shared<const Spectrum>(eta));
  return glass;
}

// Follows a ray of one wavelength to the surfaces of `events`: T where it is refracted, R where it is
// reflected. Returns the last direction.
Vector3 follow(const accel::Bvh& bvh, Ray ray, float wavelength, std::string_view events) {
  for (const char event : events) {
    SurfaceInteraction si;
    EXPECT_TRUE(bvh.intersect(ray, &si));
    const ShadingPoint x(bvh.scene(), si, -ray.d, {}, wavelength);
    const auto s = scatter_delta(x, event == 'R' ? 0 : kOneMinusEpsilon);
    EXPECT_TRUE(s && s->transmission == (event == 'T'));
    if (!s) return ray.d;
    ray = x.si.spawn(s->wi);
  }
  return ray.d;
}

double angle_between(const Vector3& a, const Vector3& b) {
  return std::acos(glm::dot(glm::normalize(glm::dvec3(a)), glm::normalize(glm::dvec3(b))));
}

// A prism of 60 degrees about the y axis whose symmetric rays run along x. Its base is wide.
Scene prism(const Spectrum& eta) {
  Scene scene;
  const uint32_t glass = add_glass(scene, eta);
  const float half = std::tan(30 * float(kDegree));
  const Point3 apex(0, 1, 0), left(-half, 0, 0), right(half, 0, 0);
  const Vector3 along(0, 0, 5);
  add_shape(scene, quad(left - along, left + along, apex + along, apex - along, glass));
  add_shape(scene, quad(right + along, right - along, apex - along, apex + along, glass));
  finalize_scene(scene);
  return scene;
}

// The deviation of a ray that enters the left face at an angle of incidence.
double deviation(const accel::Bvh& bvh, double incidence, float wavelength) {
  const double slope = incidence - 30 * kDegree;  // against the horizontal
  const Vector3 d(float(std::cos(slope)), float(std::sin(slope)), 0);
  const Point3 target(-0.5f * std::tan(30 * float(kDegree)), 0.5f, 0);
  return angle_between(d, follow(bvh, {target - 2.0f * d, d}, wavelength, "TT"));
}

// At the least deviation D of a prism of angle A,  n = sin((A + D) / 2) / sin(A / 2)  (Fraunhofer). The
// indices are those of BK7 at the lines C, d, F and g, as Schott prints them. Directions have rounding errors
// of some 1e-7, the printed indices one of 5e-6: together less than a thousandth of a degree.
TEST(Prism, HasTheLeastDeviationOfItsIndex) {
  const Scene scene = prism(sellmeier_index(*glass_coefficients("glass-BK7")));
  const accel::Bvh bvh(scene);
  const struct {
    float nm;
    double n;
  } lines[] = {{656.28f, 1.51432}, {587.56f, 1.51680}, {486.13f, 1.52238}, {435.83f, 1.52668}};
  for (const auto& line : lines) {
    double least = 10;
    for (double incidence = 47; incidence < 52; incidence += 0.02)
      least = std::min(least, deviation(bvh, incidence * kDegree, line.nm));
    const double expected = 2 * std::asin(line.n / 2) - 60 * kDegree;
    EXPECT_NEAR(least / kDegree, expected / kDegree, 0.003) << line.nm;
  }
}

// The angle between the sun's opposite and the light that a drop sends back, for the ray that hits it `b`
// radii beside its middle.
double angle_of_drop(const accel::Bvh& bvh, float b, float wavelength, std::string_view events) {
  const Vector3 d(0, 0, -1);
  return angle_between(follow(bvh, {{b, 0, 3}, d}, wavelength, events), -d);
}

// Descartes: red at 42.4 degrees and violet at 40.6 in the primary bow, 50.4 and 53.6 in the secondary. The
// indices of water at 20 degrees Celsius are those of the CRC handbook.
TEST(Rainbow, StandsAtTheAnglesOfDescartes) {
  Scene scene;
  const uint32_t water = add_glass(
      scene, sampled_index(std::array{404.66, 1.34274, 486.13, 1.33712, 589.3, 1.33299, 656.28, 1.33115}));
  add_shape(scene, sphere({0, 0, 0}, 1, water));
  finalize_scene(scene);
  const accel::Bvh bvh(scene);
  const struct {
    float nm;
    double n, primary, secondary;
  } colours[] = {{656.28f, 1.33115, 42.36, 50.39}, {404.66f, 1.34274, 40.69, 53.41}};
  for (const auto& colour : colours) {
    double primary = 0, secondary = 10;
    for (float b = 0.8f; b < 0.99f; b += 0.0005f) {
      primary = std::max(primary, angle_of_drop(bvh, b, colour.nm, "TRT"));
      secondary = std::min(secondary, angle_of_drop(bvh, b, colour.nm, "TRRT"));
    }
    EXPECT_NEAR(primary / kDegree, colour.primary, 0.03) << colour.nm;
    EXPECT_NEAR(secondary / kDegree, colour.secondary, 0.06) << colour.nm;
  }
}

// The half angle of the lamp's beam, and its angle of incidence on the prism.
constexpr double kBeam = 0.2 * kDegree, kIncidence = 48.6 * kDegree;

// A lamp that shines through the prism on a wall, wide enough to take the whole spectrum.
Scene spectrum_on_a_wall(const Spectrum& eta) {
  Scene scene = prism(eta);
  const uint32_t white = add_material(scene, Lambertian{Rgb(0.8f)});
  add_shape(scene, quad({8, -12, -8}, {8, -12, 8}, {8, 6, 8}, {8, 6, -8}, white));
  const double slope = kIncidence - 30 * kDegree;
  SpotLight lamp;
  lamp.frame = Frame::from_z(Vector3(float(std::cos(slope)), float(std::sin(slope)), 0));
  lamp.position = Point3(-0.5f * std::tan(30 * float(kDegree)), 0.5f, 0) - 2.0f * lamp.frame.z;
  lamp.cos_falloff_start = lamp.cos_total_width = float(std::cos(kBeam));
  scene.lights.emplace_back(lamp);
  finalize_scene(scene);
  return scene;
}

// The share of light of one index that passes both faces of the prism.
double passes_prism(double n) {
  const auto transmittance = [](double cos_i, double eta) {
    return 1 - double(fresnel_dielectric(float(cos_i), float(eta)));
  };
  const double inside = std::asin(std::sin(kIncidence) / n), second = 60 * kDegree - inside;
  return transmittance(std::cos(kIncidence), n) * transmittance(std::cos(second), 1 / n);
}

// What the wall receives of each colour, in watts, and how uncertain that is.
struct Received {
  glm::dvec3 flux{0}, square{0};
  uint64_t negative = 0;  // photons with a negative component
};
Received received(const Scene& scene, uint64_t photons) {
  photon::TraceSettings settings;
  settings.photons = photons;
  settings.kinds.caustic = true;
  const auto result = photon::shoot(scene, accel::Bvh(scene), settings);
  EXPECT_EQ(result.counters.energy.unaccounted(), 0);
  const photon::PhotonBuffer& buffer = result.buffers[size_t(photon::PhotonKind::kCaustic)];
  Received sum;
  for (size_t i = 0; i < buffer.records.size(); ++i) {
    const glm::dvec3 flux(buffer.photon(i).flux);
    sum.flux += flux;
    sum.square += flux * flux;
    sum.negative += flux.x < 0 || flux.y < 0 || flux.z < 0;
  }
  return sum;
}

// The spectrum adds up to white light, less what each wavelength loses at the faces, and is as bright as
// that. Tolerance: five standard errors; a beam of 0.2 degrees changes the loss by less than 0.0005 of it.
TEST(Prism, SpectrumAddsUpToWhite) {
  constexpr uint64_t kPhotons = 400'000;
  const Spectrum eta = abbe_index(1.5, 12);
  const Scene scene = spectrum_on_a_wall(eta);
  const Received sum = received(scene, kPhotons);
  glm::dvec3 expected(0);
  constexpr int kStrata = 1 << 16;
  for (int i = 0; i < kStrata; ++i) {
    const float nm = sample_wavelength((float(i) + 0.5f) / kStrata);
    expected += glm::dvec3(at_wavelength(power(scene.lights[0]), nm)) * passes_prism(eta.at(double(nm)));
  }
  expected /= kStrata;
  for (int c = 0; c < 3; ++c)
    EXPECT_NEAR(sum.flux[c], expected[c], 5 * std::sqrt(sum.square[c]) + 0.001 * expected[c]) << c;
  // Cyan and violet lie outside the gamut of RGB; maps keep their negative red and green.
  EXPECT_GT(sum.negative, kPhotons / 10);
}

// Reflection is white on the thinner side of smooth glass; on the denser side total reflection begins at
// another angle for each wavelength, and rough glass gives all that it scatters one.
TEST(Prism, OnlyItsOuterReflectionIsWhite) {
  const BsdfSample reflected{{0, 0, 1}, Rgb(1), 1, true, false}, refracted{{0, 0, -1}, Rgb(1), 1, true, true};
  const Vector3 above(0, 0, 1), below(0, 0, -1);
  for (const float eta : {1.5f, 1 / 1.5f}) {
    const bool denser_below = eta > 1;
    const Dielectric smooth{eta, {}, {}, true}, rough{eta, {0.3f, 0.3f}, {}, true}, plain{eta};
    EXPECT_EQ(smooth.selects_wavelength(above, reflected), !denser_below);
    EXPECT_EQ(smooth.selects_wavelength(below, reflected), denser_below);
    EXPECT_TRUE(smooth.selects_wavelength(above, refracted) && smooth.selects_wavelength(below, refracted));
    EXPECT_TRUE(rough.selects_wavelength(above, reflected));
    EXPECT_FALSE(plain.selects_wavelength(below, refracted));
  }
}

// One photon of dispersed light has more noise than one of white light: the mean square of its components is
// the factor by which the variance of a sum grows. The best density of wavelengths would reach 4.2.
TEST(Prism, ColoursOfPhotonsHaveLittleVariance) {
  constexpr int kStrata = 1 << 16;
  double square = 0;
  for (int i = 0; i < kStrata; ++i) {
    const Rgb colour = at_wavelength(Rgb(1), sample_wavelength((float(i) + 0.5f) / kStrata));
    square += double(glm::dot(colour, colour)) / (3 * kStrata);
  }
  EXPECT_LT(square, 4.25);
}

// Glass that disperses much over a coloured floor, seen from above through nothing.
TEST(Dispersion, CausticsAgreeWithPaths) {
  Scene scene;
  const uint32_t orange = add_material(scene, Lambertian{Rgb(0.8f, 0.4f, 0.1f)});
  const uint32_t black = add_material(scene, Lambertian{Rgb(0)});
  const uint32_t glass = add_glass(scene, abbe_index(1.5, 8));
  add_shape(scene, horizontal({0, 0, 0}, 2, 2, true, orange));
  add_shape(scene, sphere({0, 0.5f, -0.7f}, 0.35f, glass));
  make_light(scene, add_shape(scene, horizontal({0, 2, -1.4f}, 0.4f, 0.4f, false, black)), Rgb(12, 8, 5));
  look_at(scene, {0, 1.2f, 1.4f}, {0, 0, -0.2f}, {0, 1, 0}, 40, kSize, kSize);
  finalize_scene(scene);
  const auto by_paths = films(scene, settings_of(Method::kMc, 256, 0.1f, 100));
  for (const Method method : {Method::kPhoton, Method::kAuto}) {
    const Comparison c(scene, by_paths, method, 0.1f);
    c.expect_agreement_everywhere(Layer::kDirect);
    for (int block = -1; block < kSize / kBlock * (kSize / kBlock); ++block)
      c.expect_agreement(Layer::kCaustic, block, 1.0 / 2);
    c.write_pictures("dispersed_" + std::to_string(int(method)));
  }
}

}  // namespace
}  // namespace kaustik::render
