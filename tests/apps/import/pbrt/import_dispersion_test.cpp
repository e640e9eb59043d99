// Tests the ways in which a scene tells how an index of refraction depends on the wavelength.

#include "tests/apps/import/import_support.h"

namespace kaustik::pbrt {
namespace {

class ImportDispersion : public ImportTest {
 protected:
  static std::string glass(const std::string& parameters) {
    return "Material \"dielectric\" " + parameters + "\nShape \"sphere\"\n";
  }
  // The index at a wavelength in nm.
  double index(const std::string& parameters, double nm) {
    const Scene scene = world(glass(parameters));
    const Spectrum* eta = scene.materials.at(0).dispersion();
    EXPECT_TRUE(eta && scene.needs.dispersion) << parameters;
    return eta ? eta->at(nm) : 0;
  }
};

TEST_F(ImportDispersion, HasFourForms) {
  EXPECT_NEAR(index("\"float eta\" 1.62 \"float abbe\" 36", 587.56), 1.62, 1e-6);
  EXPECT_NEAR(index("\"float abbe\" 50", 587.56), 1.5, 1e-6);  // the default of `eta`
  EXPECT_NEAR(index("\"float cauchy\" [ 1.5 0.01 ]", 500), 1.54, 1e-9);
  EXPECT_NEAR(index("\"float indices\" [ 400 1.7 600 1.5 ]", 500), 1.6, 1e-9);
  // BK7 at line F, as Schott prints it.
  EXPECT_NEAR(index("\"float sellmeier\" [ 1.03961212 0.231792344 1.01046945 0.00600069867 0.0200179144 "
                    "103.560653 ]",
                    486.13),
              1.52238, 1e-5);
}

TEST_F(ImportDispersion, IndexWithoutWavelengthIsThatOfTheHeliumLine) {
  const Scene scene = world(glass("\"float cauchy\" [ 1.5 0.01 ]"));
  EXPECT_NEAR(std::get<Dielectric>(scene.materials.at(0).typical()).eta, 1.5 + 0.01 / (0.58756 * 0.58756),
              1e-5);
}

TEST_F(ImportDispersion, TexturedRoughnessKeepsIt) {
  const Scene scene = world("Texture \"r\" \"float\" \"checkerboard\" \"float tex1\" 0 \"float tex2\" 0.2\n" +
                            glass("\"float abbe\" 30 \"texture roughness\" \"r\""));
  EXPECT_TRUE(scene.materials.at(0).textured());
  EXPECT_TRUE(scene.needs.dispersion);
}

TEST_F(ImportDispersion, MixturesDisperse) {
  const Scene scene = world(
      "MakeNamedMaterial \"a\" \"string type\" \"diffuse\"\n"
      "MakeNamedMaterial \"b\" \"string type\" \"dielectric\" \"float abbe\" 30\n"
      "Material \"mix\" \"string materials\" [ \"a\" \"b\" ]\nShape \"sphere\"");
  EXPECT_TRUE(scene.needs.dispersion);
}

TEST_F(ImportDispersion, OnlyMaterialsThatAreUsedCount) {
  const Scene scene = world(
      "MakeNamedMaterial \"b\" \"string type\" \"dielectric\" \"float abbe\" 30\n"
      "Material \"diffuse\"\nShape \"sphere\"");
  EXPECT_FALSE(scene.needs.dispersion);
}

// What a formula tells replaces `eta`, before it is asked whether there is a boundary at all.
TEST_F(ImportDispersion, RoughnessStaysWhateverEtaSays) {
  const Scene scene = world(glass("\"float eta\" 1 \"float cauchy\" [ 1.5 0.01 ] \"float roughness\" 0.3"));
  EXPECT_FALSE(std::get<Dielectric>(scene.materials.at(0).typical()).facets.smooth());
}

TEST_F(ImportDispersion, ConstantIndicesDoNotDisperse) {
  const Scene scene = world(glass("\"float cauchy\" [ 1.6 ]"));
  EXPECT_EQ(std::get<Dielectric>(scene.materials.at(0).typical()).eta, 1.6f);
  EXPECT_FALSE(scene.needs.dispersion);
}

TEST_F(ImportDispersion, MixturesOfMixturesDisperse) {
  const Scene scene = world(nested_mixtures(R"("dielectric" "spectrum eta" "glass-BK7")", 60) +
                            "NamedMaterial \"m60\" Shape \"sphere\"");
  EXPECT_TRUE(scene.needs.dispersion);
  EXPECT_TRUE(scene.materials[scene.shapes[0].material].is_dispersive());
  EXPECT_FALSE(scene.materials[scene.shapes[0].material].has_textured_bsdf());
}

TEST_F(ImportDispersion, SamplesMayLieCloseTogether) {
  const Scene scene = world(glass("\"spectrum eta\" [ 586 1.5 588 1.51 ]"));
  EXPECT_NEAR(scene.materials.at(0).dispersion()->at(587), 1.505, 1e-9);
  EXPECT_EQ(scene.materials.at(0).dispersion()->at(400), 1.5);
}

TEST_F(ImportDispersion, WrongParametersAreErrors) {
  EXPECT_EQ(
      first_lines(glass("\"float abbe\" 30 \"float cauchy\" [ 1.5 0.01 ]")),
      "2:23: error: `cauchy` and `abbe` both tell how the index of refraction depends on the wavelength: "
      "give one of them\n");
  EXPECT_EQ(first_lines(glass("\"float indices\" [ 500 1.5 400 1.6 ]")),
            "2:41: error: `indices` takes pairs of wavelength and index of refraction, and the wavelengths "
            "increase\n");
  EXPECT_EQ(
      first_lines(glass("\"float cauchy\" [ -3 ]")),
      "2:40: error: `cauchy` leads to indices of refraction that are not between 0.01 and 100, from 360 nm "
      "to 830 nm\n");
  EXPECT_EQ(first_lines(glass("\"float sellmeier\" [ 1 2 3 ]")),
            "2:23: error: `sellmeier` of material \"dielectric\" takes 6 values, not 3\n");
  EXPECT_EQ(first_lines(glass("\"float cauchy\" [ 1 1 1 1 1 1 1 1 1 ]")),
            "2:23: error: `cauchy` of material \"dielectric\" takes 1 to 8 values, not 9\n");
  EXPECT_EQ(first_lines(glass("\"spectrum eta\" \"glass-BK7\" \"float abbe\" 64")),
            "2:50: error: `abbe` cannot be given where `eta` is a spectrum\n");
  EXPECT_EQ(first_lines("Texture \"e\" \"float\" \"constant\" \"float value\" 1.5\n" +
                        glass("\"float abbe\" 30 \"texture eta\" \"e\"")),
            "3:39: error: `eta` cannot be a texture where `abbe` is given\n");
}

}  // namespace
}  // namespace kaustik::pbrt
