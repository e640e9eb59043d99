// Tests spectra against published chromaticities and against their definitions.

#include <gtest/gtest.h>

#include "core/spectrum/colour_space.h"
#include "core/spectrum/metal_tables.h"
#include "core/spectrum/named_spectra.h"

namespace kaustik {
namespace {

glm::dvec2 chromaticity(const Spectrum& s) {
  const glm::dvec3 xyz = tristimulus(s);
  return glm::dvec2(xyz) / (xyz.x + xyz.y + xyz.z);
}

void expect_near(const glm::dvec3& a, const glm::dvec3& b, double tolerance, std::string_view what = "") {
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(a[i], b[i], tolerance) << what << ' ' << i;
}

// The integral of the observer's y is 106.856895 nm by the CIE's table in steps of 1 nm, which pbrt's sums
// use. Our table is refined from steps of 5 nm.
TEST(Spectrum, ObserverHasThePublishedIntegral) {
  EXPECT_NEAR(tristimulus(Spectrum::from([](double) { return 1; })).y, 106.856895, 0.002);
}

// CIE 15:2004, table T.3: chromaticities of the illuminants, with the four digits printed there. F
// illuminants are tables in steps of 5 nm which the CIE sums at these steps; we interpolate, which moves
// peaked spectra by up to 0.0003.
TEST(Spectrum, IlluminantsHaveThePublishedChromaticities) {
  const struct {
    const char* name;
    double x, y, tolerance;
  } published[] = {
      {"stdillum-A", 0.44758, 0.40745, 5e-5},    {"stdillum-D50", 0.34567, 0.35851, 1e-4},
      {"stdillum-D55", 0.33243, 0.34744, 1e-4},  {"stdillum-D65", 0.31272, 0.32903, 5e-5},
      {"illum-acesD60", 0.32168, 0.33767, 2e-4}, {"stdillum-F1", 0.3131, 0.3371, 4e-4},
      {"stdillum-F2", 0.3721, 0.3751, 4e-4},     {"stdillum-F3", 0.4091, 0.3941, 4e-4},
      {"stdillum-F4", 0.4402, 0.4031, 4e-4},     {"stdillum-F5", 0.3138, 0.3452, 4e-4},
      {"stdillum-F6", 0.3779, 0.3882, 4e-4},     {"stdillum-F7", 0.3129, 0.3292, 4e-4},
      {"stdillum-F8", 0.3458, 0.3586, 4e-4},     {"stdillum-F9", 0.3741, 0.3727, 4e-4},
      {"stdillum-F10", 0.3458, 0.3588, 4e-4},    {"stdillum-F11", 0.3805, 0.3769, 4e-4},
      {"stdillum-F12", 0.4370, 0.4042, 4e-4},
  };
  for (const auto& p : published) {
    const auto s = named_spectrum(p.name);
    ASSERT_TRUE(s) << p.name;
    const glm::dvec2 xy = chromaticity(*s);
    EXPECT_NEAR(xy.x, p.x, p.tolerance) << p.name;
    EXPECT_NEAR(xy.y, p.y, p.tolerance) << p.name;
  }
}

// Points of the Planckian locus (Wyszecki and Stiles 1982, table 3.11, where c2 = 1.4388 cm K).
TEST(Spectrum, BlackbodiesLieOnThePlanckianLocus) {
  const struct {
    double kelvin, x, y;
  } published[] = {
      {2000, 0.5267, 0.4133}, {3000, 0.4369, 0.4041}, {5000, 0.3451, 0.3516}, {10000, 0.2807, 0.2884}};
  for (const auto& p : published) {
    const glm::dvec2 xy = chromaticity(blackbody(p.kelvin));
    EXPECT_NEAR(xy.x, p.x, 1.5e-4) << p.kelvin;
    EXPECT_NEAR(xy.y, p.y, 1.5e-4) << p.kelvin;
  }
}

TEST(Spectrum, BlackbodyPeaksAtOne) {
  // By Wien's law 5000 K peaks at 579.55 nm.
  const Spectrum s = blackbody(5000);
  EXPECT_NEAR(s.at(579.55), 1, 1e-5);  // linear between nanometres
  EXPECT_EQ(*std::max_element(s.values.begin(), s.values.end()), s.at(580));
}

TEST(Spectrum, DaylightIsWhite) {
  expect_near(emitted_colour(daylight(6500)), glm::dvec3(1), 1e-12);
  expect_near(reflected_colour(Spectrum::from([](double) { return 0.3; })), glm::dvec3(0.3), 1e-12);
}

TEST(Spectrum, LightsHaveLuminanceOne) {
  for (const std::string_view name : spectrum_names()) {
    const glm::dvec3 c = emitted_colour(*named_spectrum(name));
    // Luminance uses the middle row of the matrix from Rec. 709 to XYZ.
    const glm::dmat3& m = colour_spaces().front().to_xyz;
    if (name.ends_with("O-k") || name.ends_with("2-k")) continue;  // these spectra are zero
    EXPECT_NEAR(m[0].y * c.x + m[1].y * c.y + m[2].y * c.z, 1, 1e-12) << name;
  }
}

// IEC 61966-2-1 prints its matrix for the white point (0.3127, 0.3290); ours is 2e-5 from there.
TEST(Spectrum, SrgbMatchesThePublishedMatrix) {
  const glm::dmat3& m = colour_spaces().front().to_xyz;
  expect_near(m[0], {0.4124, 0.2126, 0.0193}, 2e-4);
  expect_near(m[1], {0.3576, 0.7152, 0.1192}, 2e-4);
  expect_near(m[2], {0.1805, 0.0722, 0.9505}, 4e-4);
}

// ITU-R BT.2087 gives the matrix from Rec. 709 to Rec. 2020; our matrix is its inverse.
TEST(Spectrum, Rec2020MatchesThePublishedMatrix) {
  const glm::dmat3 back({0.6274, 0.0691, 0.0164}, {0.3293, 0.9195, 0.0880}, {0.0433, 0.0114, 0.8956});
  const glm::dmat3 product = find_colour_space("rec2020")->light_to_ours() * back;
  for (int c = 0; c < 3; ++c) {
    for (int r = 0; r < 3; ++r) EXPECT_NEAR(product[c][r], c == r ? 1 : 0, 3e-4);
  }
}

TEST(Spectrum, WhiteSurfacesStayWhite) {
  for (const ColourSpace& space : colour_spaces())
    expect_near(space.surface_to_ours() * glm::dvec3(1), glm::dvec3(1), 1e-12, space.name);
  // The white point of ACES is warmer than ours.
  const glm::dvec3 light = find_colour_space("aces2065-1")->light_to_ours() * glm::dvec3(1);
  EXPECT_GT(light.r, 1.03);
  EXPECT_LT(light.b, 0.95);
  EXPECT_EQ(find_colour_space("rec709"), find_colour_space("srgb"));
  EXPECT_EQ(find_colour_space("prophoto"), nullptr);
}

// Schott's data sheets (for SF10, that of today's N-SF10): n_d at 587.56 nm.
TEST(Spectrum, GlassesHaveThePublishedIndices) {
  const std::pair<const char*, double> sheets[] = {
      {"glass-BK7", 1.51680}, {"glass-BAF10", 1.67003}, {"glass-FK51A", 1.48656}, {"glass-LASF9", 1.85025},
      {"glass-SF5", 1.67270}, {"glass-F5", 1.67270},    {"glass-SF10", 1.72828},  {"glass-SF11", 1.78472},
  };
  for (const auto& [name, nd] : sheets) EXPECT_NEAR(named_spectrum(name)->at(587.56), nd, 1e-5) << name;
}

// Gold reflects red and little blue; silver is the best mirror. Magnitudes are from Palik (1985), to 0.03.
TEST(Spectrum, MetalsHaveThePublishedReflectances) {
  for (const MetalIndex& m : metals()) {
    const MetalColour c = metal_colour(m.eta, m.k);
    const glm::dvec3 k2 = c.k * c.k;
    const glm::dvec3 r = ((c.eta - 1.0) * (c.eta - 1.0) + k2) / ((c.eta + 1.0) * (c.eta + 1.0) + k2);
    if (m.name == "Au") expect_near(r, {1.0, 0.78, 0.34}, 0.04, m.name);
    if (m.name == "Ag") expect_near(r, {0.97, 0.96, 0.92}, 0.03, m.name);
    if (m.name == "Al") expect_near(r, {0.91, 0.92, 0.92}, 0.02, m.name);
    if (m.name == "Cu") expect_near(r, {0.95, 0.64, 0.54}, 0.04, m.name);
    // The reduction to RGB keeps the colour of the spectral reflectance wherever a k exists that gives it.
    const Spectrum exact = Spectrum::from([&](double nm) {
      const double n = m.eta.at(nm), k = m.k.at(nm);
      return ((n - 1) * (n - 1) + k * k) / ((n + 1) * (n + 1) + k * k);
    });
    if (m.k.at(550) > 0) expect_near(r, glm::clamp(reflected_colour(exact), 0.0, 0.9999), 1e-6, m.name);
  }
}

TEST(Spectrum, SamplesAreInterpolatedLinearly) {
  const double nm[] = {400, 500, 600}, v[] = {0, 1, 0.5};
  const Spectrum s = sampled_spectrum(nm, v);
  EXPECT_EQ(s.at(399), 0);
  EXPECT_NEAR(s.at(450), 0.5, 1e-15);
  EXPECT_EQ(s.at(500), 1);
  EXPECT_NEAR(s.at(580), 0.6, 1e-15);
  EXPECT_EQ(s.at(600), 0.5);
  EXPECT_EQ(s.at(601), 0);
}

TEST(Spectrum, KnowsPbrtsSpectraThatAreMissingHere) {
  EXPECT_EQ(nearest_to_missing_spectrum("metal-CuZn-eta"), "metal-Cu-eta");
  EXPECT_EQ(nearest_to_missing_spectrum("canon_eos_5d_mkii_r"), "");
  EXPECT_FALSE(nearest_to_missing_spectrum("metal-Xy-eta"));
  for (const std::string_view name : spectrum_names()) EXPECT_FALSE(nearest_to_missing_spectrum(name));
}

}  // namespace
}  // namespace kaustik
