// pbrt-v3's material "uber": each of its lobes, their blends, and its opacity.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/apps/import/import_support.h"

namespace kaustik::pbrt {
namespace {

using testing::DoubleNear;
using testing::ElementsAre;
using testing::HasSubstr;

class ImportUber : public ImportTest {
 protected:
  SceneDescription uber(const std::string& parameters, const std::string& more = "") {
    return describe(
        "WorldBegin\n" + more + "Material \"uber\" " + parameters +
        " Shape \"sphere\" AttributeBegin AreaLightSource \"diffuse\" Shape \"sphere\" AttributeEnd");
  }
  static std::vector<double> numbers(const Directive& d, std::string_view name) {
    const Parameter* p = d.find(name);
    return p ? p->numbers : std::vector<double>{};
  }
};

constexpr const char* kNoDiffuse = "\"rgb Kd\" [ 0 0 0 ] \"rgb Ks\" [ 0 0 0 ] ";

TEST_F(ImportUber, GlassAndMirrorAreTintedBoundaries) {
  const auto glass =
      uber(std::string(kNoDiffuse) + "\"rgb Kt\" [ .2 .4 .6 ] \"float index\" 1.3").materials.at(0);
  EXPECT_EQ(glass.type, "dielectric");
  EXPECT_THAT(numbers(glass, "reflectance"), ElementsAre(0, 0, 0));
  EXPECT_THAT(numbers(glass, "transmittance"), ElementsAre(.2, .4, .6));
  EXPECT_THAT(numbers(glass, "eta"), ElementsAre(1.3));
  const auto mirror = uber(std::string(kNoDiffuse) + "\"rgb Kr\" [ .2 .4 .6 ]").materials.at(0);
  EXPECT_EQ(mirror.type, "dielectric");
  EXPECT_THAT(numbers(mirror, "reflectance"), ElementsAre(.2, .4, .6));
  EXPECT_THAT(numbers(mirror, "transmittance"), ElementsAre(0, 0, 0));
  const auto gloss = uber("\"rgb Kd\" [ 0 0 0 ] \"float roughness\" 1").materials.at(0);
  EXPECT_EQ(gloss.type, "dielectric");
  EXPECT_THAT(numbers(gloss, "reflectance"), ElementsAre(.25, .25, .25));
  EXPECT_THAT(numbers(gloss, "roughness"), ElementsAre(1.62142));
}

TEST_F(ImportUber, DiffuseLightHasACoatWhereThereIsOne) {
  EXPECT_EQ(uber("\"rgb Ks\" [ 0 0 0 ] \"rgb Kd\" [ .1 .2 .3 ]").materials.at(0).type, "diffuse");
  const auto rough = uber("\"rgb Kd\" [ .1 .2 .3 ] \"float roughness\" 1").materials.at(0);
  EXPECT_EQ(rough.type, "coateddiffuse");
  EXPECT_THAT(numbers(rough, "roughness"), ElementsAre(1.62142));
  const auto smooth =
      uber("\"rgb Kd\" [ .1 .2 .3 ] \"rgb Kr\" [ 1 1 1 ] \"float roughness\" 1").materials.at(0);
  EXPECT_EQ(smooth.type, "coateddiffuse");
  EXPECT_THAT(numbers(smooth, "reflectance"), ElementsAre(.1, .2, .3));
  EXPECT_FALSE(smooth.find("roughness"));
}

// The mixture's share times each part is the uber's own colour.
TEST_F(ImportUber, DiffuseLightBesideGlassIsAMixture) {
  const auto scene =
      uber("\"rgb Kd\" [ .3 .15 0 ] \"rgb Ks\" [ 0 0 0 ] \"rgb Kt\" [ .6 .3 .3 ] \"rgb Kr\" [ .1 .1 .1 ]");
  ASSERT_EQ(scene.materials.size(), 3u);
  const auto &diffuse = scene.materials[0], &glass = scene.materials[1], &mix = scene.materials[2];
  EXPECT_EQ(diffuse.type, "diffuse");
  EXPECT_EQ(glass.type, "dielectric");
  EXPECT_EQ(mix.type, "mix");
  EXPECT_THAT(mix.find("materials")->strings, ElementsAre(diffuse.name, glass.name));
  const std::vector<double> Kd = {.3, .15, 0}, Kt = {.6, .3, .3};
  const double share = numbers(mix, "amount").at(0);
  for (size_t c = 0; c < 3; ++c) {
    EXPECT_NEAR((1 - share) * numbers(diffuse, "reflectance").at(c), Kd[c], 1e-12);
    EXPECT_NEAR(share * numbers(glass, "transmittance").at(c), Kt[c], 1e-12);
    EXPECT_NEAR(share * numbers(glass, "reflectance").at(c), .1, 1e-12);
  }
  EXPECT_EQ(scene.shapes.at(0).material.index, 2u);
  EXPECT_THAT(diagnostics_.format_all(), HasSubstr("a \"mix\" of a diffuse surface and tinted glass"));
}

TEST_F(ImportUber, OpacityIsTheAlphaOfTheShapes) {
  const auto grey = uber("\"rgb opacity\" [ .3 .6 .9 ]");
  EXPECT_FALSE(grey.materials.at(0).find("opacity"));
  EXPECT_THAT(numbers(grey.shapes.at(0), "alpha"), ElementsAre(DoubleNear(.6, 1e-12)));
  EXPECT_FALSE(grey.shapes.at(1).find("alpha"));  // what shines
  EXPECT_FALSE(uber("\"rgb opacity\" [ 1 1 1 ]").shapes.at(0).find("alpha"));
  const auto named = describe(
      "WorldBegin MakeNamedMaterial \"a\" \"string type\" \"uber\" \"rgb opacity\" [ .5 .5 .5 ] "
      "Material \"matte\" Shape \"sphere\" NamedMaterial \"a\" Shape \"sphere\" "
      "Shape \"sphere\" \"float alpha\" .1");
  EXPECT_FALSE(named.shapes.at(0).find("alpha"));
  EXPECT_THAT(numbers(named.shapes.at(1), "alpha"), ElementsAre(.5));
  EXPECT_THAT(numbers(named.shapes.at(2), "alpha"), ElementsAre(.1));
}

TEST_F(ImportUber, ImagesOfOpacityAreReadAsNumbers) {
  const auto scene = uber("\"texture opacity\" \"leaf\"",
                          "Texture \"leaf\" \"color\" \"imagemap\" \"string filename\" \"leaf.png\" ");
  const Parameter* alpha = scene.shapes.at(0).find("alpha");
  ASSERT_TRUE(alpha && alpha->type == ParameterType::kTexture);
  ASSERT_EQ(scene.textures.size(), 2u);
  EXPECT_EQ(scene.textures[1].name, alpha->strings.at(0));
  EXPECT_EQ(scene.textures[1].value_type, "float");
  EXPECT_EQ(scene.textures[1].find("filename")->strings, scene.textures[0].find("filename")->strings);
}

// All of them build: no parameter is refused later.
TEST_F(ImportUber, EveryKindRenders) {
  for (const char* kind :
       {"", "\"rgb Kt\" [ 1 1 1 ]", "\"rgb Kr\" [ 1 1 1 ]", "\"rgb Kd\" [ 0 0 0 ] \"rgb Kt\" [ 1 1 1 ]",
        "\"rgb Kd\" [ 0 0 0 ]", "\"rgb opacity\" [ .5 .5 .5 ] \"float roughness\" .2"}) {
    load("Camera \"perspective\" WorldBegin Material \"uber\" " + std::string(kind) + " Shape \"sphere\"");
    EXPECT_EQ(diagnostics_.error_count(), 0u) << diagnostics_.format_all();
  }
}

}  // namespace
}  // namespace kaustik::pbrt
