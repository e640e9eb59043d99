// Tests spectra, blackbodies and colour spaces in scene files, and the sensor of the film.

#include <gmock/gmock.h>

#include "core/spectrum/colour_space.h"
#include "core/spectrum/named_spectra.h"
#include "tests/apps/import/import_support.h"

namespace kaustik::pbrt {
namespace {

// Colours are computed in double and rounded to float once, with values below 4.
constexpr double kFloat = 3e-7;

using ImportColours = ImportTest;

void expect_near(const glm::dvec3& a, const glm::dvec3& b, double tolerance = kFloat) {
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(a[i], b[i], tolerance) << i;
}

Rgb intensity(const Scene& scene) {
  return std::get<PointLight>(scene.lights.at(0)).I;
}
Rgb reflectance(const Scene& scene) {
  return std::get<Lambertian>(scene.materials.at(0).typical()).reflectance;
}
constexpr std::string_view kSphere = "Shape \"sphere\"\n";

// A light with a spectrum has luminance 1 before `scale` and `power`, whatever the values of the spectrum.
TEST_F(ImportColours, LightsHaveLuminanceOne) {
  for (const std::string text : {"\"blackbody I\" 5500", "\"spectrum I\" \"stdillum-F11\"",
                                 "\"spectrum I\" [ 400 7 700 7 ]", "\"blackbody I\" 1200"}) {
    const Scene scene = world("LightSource \"point\" " + text);
    // luminance() uses weights with four digits, an error of up to 1e-4 of colours with channels up to 5.
    EXPECT_NEAR(luminance(intensity(scene)), 1, 5e-4) << text;
  }
  expect_near(intensity(world("LightSource \"point\" \"spectrum I\" \"stdillum-D65\" \"float scale\" 3")),
              glm::dvec3(3));
  expect_near(intensity(world("LightSource \"point\" \"blackbody I\" 5500 \"float scale\" 2")),
              2.0 * emitted_colour(blackbody(5500)));
  // `power` scales by luminance.
  EXPECT_NEAR(
      luminance(power(world("LightSource \"point\" \"blackbody I\" 3000 \"float power\" 100").lights[0])),
      100, 1e-4 * 100);
}

// pbrt-v3's blackbody has a second number, a factor.
TEST_F(ImportColours, BlackbodyTakesAFactor) {
  expect_near(intensity(world("LightSource \"point\" \"blackbody I\" [ 4000 5 ]")),
              5.0 * emitted_colour(blackbody(4000)), 1e-6);
}

TEST_F(ImportColours, SurfaceSpectraAreSeenUnderDaylight) {
  expect_near(reflectance(world("Material \"diffuse\" \"spectrum reflectance\" [ 300 0.25 900 0.25 ]\n" +
                                std::string(kSphere))),
              glm::dvec3(0.25));
  // A reflectance beyond 600 nm only is redder than any Rec. 709 red: green and blue are cut to zero.
  const Rgb red = reflectance(
      world("Material \"diffuse\" \"spectrum reflectance\" [ 600 0 601 1 800 1 ]\n" + std::string(kSphere)));
  EXPECT_GT(red.r, 0.3f);
  EXPECT_EQ(red.g, 0);
  EXPECT_EQ(red.b, 0);
}

TEST_F(ImportColours, SpectraAreReadFromFiles) {
  write("light.spd", "# wavelength value\n300 2\n 900 2 # flat\n");
  const auto flat = Spectrum::from([](double) { return 2; });
  expect_near(intensity(world("LightSource \"point\" \"spectrum I\" \"light.spd\"")), emitted_colour(flat));
  write("bad.spd", "300 2\n900");
  EXPECT_THAT(
      messages("WorldBegin LightSource \"point\" \"spectrum I\" \"bad.spd\""),
      testing::HasSubstr("a spectrum takes pairs of wavelength and value: the last of 3 numbers is ignored"));
  write("worse.spd", "300 2\n200 2");
  EXPECT_THAT(messages("WorldBegin LightSource \"point\" \"spectrum I\" \"worse.spd\""),
              testing::HasSubstr("worse.spd:2:1: warning: wavelengths must increase"));
  write("text.spd", "300 two");
  EXPECT_THAT(messages("WorldBegin LightSource \"point\" \"spectrum I\" \"text.spd\""),
              testing::HasSubstr(
                  "scene.pbrt:1:45: error: cannot read \"text.spd\": expected a number in line 1, column 5"));
}

TEST_F(ImportColours, MetalsKeepTheirColour) {
  const Scene scene =
      world("Material \"conductor\" \"spectrum eta\" \"metal-Au-eta\" \"spectrum k\" \"metal-Au-k\"\n" +
            std::string(kSphere));
  const auto& gold = std::get<Conductor>(scene.materials.at(0).typical());
  const MetalColour expected = metal_colour(*named_spectrum("metal-Au-eta"), *named_spectrum("metal-Au-k"));
  EXPECT_EQ(gold.eta, Rgb(expected.eta));
  EXPECT_EQ(gold.k, Rgb(expected.k));
}

// pbrt's default is "metal-Cu-eta" and "metal-Cu-k".
TEST_F(ImportColours, MetalWithoutIndicesIsCopper) {
  const Scene scene = world("Material \"conductor\"\n" + std::string(kSphere));
  const auto& metal = std::get<Conductor>(scene.materials.at(0).typical());
  const MetalColour copper = metal_colour(*named_spectrum("metal-Cu-eta"), *named_spectrum("metal-Cu-k"));
  EXPECT_EQ(metal.eta, Rgb(copper.eta));
  EXPECT_EQ(metal.k, Rgb(copper.k));
}

TEST_F(ImportColours, GlassDisperses) {
  const Scene scene =
      world("Material \"dielectric\" \"spectrum eta\" \"glass-BK7\"\n" + std::string(kSphere) +
            "Material \"dielectric\" \"spectrum eta\" [ 400 1.6 700 1.5 ]\n" + std::string(kSphere));
  const Material &named = scene.materials.at(0), &sampled = scene.materials.at(1);
  EXPECT_NEAR(std::get<Dielectric>(named.typical()).eta, 1.51680, 1e-5);
  ASSERT_TRUE(named.dispersion() && sampled.dispersion());
  EXPECT_NEAR(named.dispersion()->at(656.28), 1.51432, 1e-5);  // Schott, line C
  EXPECT_NEAR(sampled.dispersion()->at(550), 1.55, 1e-9);
  EXPECT_EQ(sampled.dispersion()->at(380), 1.6);
  EXPECT_TRUE(scene.needs.dispersion);
  EXPECT_EQ(diagnostics_.warning_count(), 0u);
}

TEST_F(ImportColours, ConstantIndexDoesNotDisperse) {
  const Scene scene =
      world("Material \"dielectric\" \"spectrum eta\" [ 300 1.6 900 1.6 ]\n" + std::string(kSphere));
  EXPECT_EQ(std::get<Dielectric>(scene.materials.at(0).typical()).eta, 1.6f);
  EXPECT_FALSE(scene.needs.dispersion);
}

TEST_F(ImportColours, PanesAndCoatsDoNotDisperse) {
  world("Material \"thindielectric\" \"spectrum eta\" \"glass-BK7\"\n" + std::string(kSphere) +
        "Material \"coateddiffuse\" \"spectrum eta\" \"glass-SF11\"\n" + std::string(kSphere));
  EXPECT_EQ(diagnostics_.warning_count(), 1u);
}

TEST_F(ImportColours, ColourSpacesAreConverted) {
  const std::string p3 = "ColorSpace \"dci-p3\"\n";
  // White stays white; a colour within our gamut is transformed by the matrices; one outside is cut.
  expect_near(intensity(world(p3 + "LightSource \"point\" \"rgb I\" [ 2 2 2 ]")), glm::dvec3(2));
  const glm::dvec3 c(0.5, 0.4, 0.3);
  expect_near(intensity(world(p3 + "LightSource \"point\" \"rgb I\" [ 0.5 0.4 0.3 ]")),
              find_colour_space("dci-p3")->light_to_ours() * c);
  const Rgb green =
      reflectance(world(p3 + "Material \"diffuse\" \"rgb reflectance\" [ 0 1 0 ]\n" + std::string(kSphere)));
  EXPECT_EQ(green.r, 0);
  EXPECT_EQ(green.g, 1);
  // The colour space belongs to the graphics state, and colours in our own space do not change at all.
  const std::string state =
      "AttributeBegin\n" + p3 + "AttributeEnd\nLightSource \"point\" \"rgb I\" [ 0 1 0 ]";
  EXPECT_EQ(intensity(world(state)), Rgb(0, 1, 0));
}

TEST_F(ImportColours, ExposureScalesTheImage) {
  const auto sensor = [&](const std::string& camera, const std::string& film) {
    return load("Camera \"perspective\" " + camera + "\nFilm \"rgb\" " + film + "\nWorldBegin").scene.sensor;
  };
  EXPECT_TRUE(sensor("", "").neutral);
  EXPECT_TRUE(sensor("\"float shutteropen\" 0 \"float shutterclose\" 1", "\"float iso\" 100").neutral);
  // The imaging ratio is time times iso / 100.
  EXPECT_EQ(
      sensor("\"float shutteropen\" 0.25 \"float shutterclose\" 0.75", "\"float iso\" 800")(Rgb(1, 2, 3)),
      Rgb(4, 8, 12));
  EXPECT_EQ(sensor("", "\"float exposuretime\" 0.5")(Rgb(1, 2, 3)), Rgb(0.5f, 1, 1.5f));
}

TEST_F(ImportColours, WhiteBalanceAdaptsColours) {
  const Sensor sensor = load("Film \"rgb\" \"float whitebalance\" 5000\nWorldBegin").scene.sensor;
  expect_near(sensor(Rgb(emitted_colour(daylight(5000)))), glm::dvec3(1), 1e-5);
  const Sensor none = load("Film \"rgb\" \"float whitebalance\" 6500\nWorldBegin").scene.sensor;
  expect_near(none(Rgb(1, 0.5, 0.25)), glm::dvec3(1, 0.5, 0.25), 1e-5);
}

TEST_F(ImportColours, SensorsAreKnownByName) {
  EXPECT_THAT(messages("Film \"rgb\" \"string sensor\" \"canon_eos_5d\"\nWorldBegin"),
              testing::HasSubstr("warning: sensor \"canon_eos_5d\" is replaced by \"cie1931\""));
  EXPECT_THAT(
      messages("Film \"rgb\" \"string sensor\" \"canon_eos_6d\"\nWorldBegin"),
      testing::HasSubstr("warning: unknown sensor \"canon_eos_6d\": \"cie1931\" stands in; did you mean"));
  EXPECT_THAT(messages("Camera \"perspective\" \"float shutterclose\" 0\nWorldBegin"),
              testing::HasSubstr("1:43: warning: the shutter opens for no time: one second is taken"));
}

}  // namespace
}  // namespace kaustik::pbrt
