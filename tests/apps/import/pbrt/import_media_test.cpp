// Tests the media of pbrt scenes: where they are, and how much they absorb.

#include "tests/apps/import/import_support.h"

namespace kaustik::pbrt {
namespace {

class ImportMedia : public ImportTest {
 protected:
  static std::string medium(const std::string& name, const std::string& parameters) {
    return "MakeNamedMedium \"" + name + "\" \"string type\" \"homogeneous\" \"rgb sigma_s\" [ 0 0 0 ] " +
           parameters + "\n";
  }
};

TEST_F(ImportMedia, CoefficientsAreScaled) {
  const Scene s = world(medium("tea", "\"rgb sigma_a\" [ 0.25 1 4 ] \"float scale\" 2") +
                        "MediumInterface \"tea\" \"\" Material \"dielectric\" Shape \"sphere\"");
  ASSERT_EQ(s.media.size(), 2u);
  EXPECT_EQ(s.media[kVacuum].sigma_a, Rgb(0));
  EXPECT_EQ(s.media[1].sigma_a, Rgb(0.5f, 2, 8));
  EXPECT_EQ(s.shapes[0].media.inside, 1);
  EXPECT_EQ(s.shapes[0].media.outside, kVacuum);
  EXPECT_TRUE(s.needs.media);
}

// Definitions may follow their use, and the graphics state keeps the media as it keeps the material.
TEST_F(ImportMedia, InterfacesBelongToTheGraphicsState) {
  const Scene s = world(
      "AttributeBegin MediumInterface \"a\" \"b\" Shape \"sphere\" AttributeEnd\n"
      "Shape \"sphere\" MediumInterface \"b\" Shape \"sphere\" LightSource \"point\"\n" +
      medium("a", "\"rgb sigma_a\" [ 1 1 1 ]") + medium("b", "\"rgb sigma_a\" [ 2 2 2 ]"));
  ASSERT_EQ(s.shapes.size(), 3u);
  EXPECT_EQ(s.shapes[0].media.inside, 1);
  EXPECT_EQ(s.shapes[0].media.outside, 2);
  EXPECT_FALSE(s.shapes[1].media.is_transition());
  EXPECT_EQ(s.shapes[2].media.inside, 2);  // one name stands for both sides
  EXPECT_EQ(s.shapes[2].media.outside, 2);
  EXPECT_EQ(s.light_media, std::vector<MediumIndex>{2});
}

TEST_F(ImportMedia, TheCameraIsInTheOutsideMedium) {
  const Scene s = load(medium("water", "\"rgb sigma_a\" [ 1 1 1 ]") + "MediumInterface \"\" \"water\" " +
                       "Camera \"perspective\"\nWorldBegin\nShape \"sphere\"")
                      .scene;
  EXPECT_EQ(s.camera_medium, 1);
}

// What absorbs nothing costs nothing.
TEST_F(ImportMedia, ClearMediaAreNone) {
  const Scene s =
      world(medium("air", "\"rgb sigma_a\" [ 0 0 0 ]") + "MediumInterface \"air\" \"\" Shape \"sphere\"");
  EXPECT_TRUE(s.media.empty());
  EXPECT_FALSE(s.needs.media);
}

// Photons keep the index of their medium in eight bits.
TEST_F(ImportMedia, TheirNumberIsLimited) {
  std::string all;
  for (int i = 0; i < 255; ++i) all += medium("m" + std::to_string(i), "\"rgb sigma_a\" [ 1 1 1 ]");
  EXPECT_EQ(world(all).media.size(), 256u);
  EXPECT_EQ(first_lines(all + medium("more", "\"rgb sigma_a\" [ 1 1 1 ]")),
            "257:17: error: there are more than 255 media\n");
}

TEST_F(ImportMedia, CoefficientsAreFinite) {
  EXPECT_EQ(first_lines(medium("m", "\"rgb sigma_a\" [ 1e30 1 1 ] \"float scale\" 1e30")),
            "2:114: error: `scale` takes coefficients beyond the range of floats\n");
}

// As for lights, a black body has the luminance of a light of one, and negative colours are cut.
TEST_F(ImportMedia, TheyEmit) {
  const Scene s = world(
      medium("gas", "\"rgb sigma_a\" [ 1 2 0 ] \"rgb Le\" [ 1 2 3 ] \"float Lescale\" 2 \"float scale\" 3") +
      medium("ember", "\"rgb sigma_a\" [ 1 1 1 ] \"blackbody Le\" 2500") +
      R"(MakeNamedMedium "flame" "string type" "uniformgrid" "float density" [ 1 ] "rgb Le" [ 4 2 1 ]
      MediumInterface "gas" "ember" Material "interface" Shape "sphere" Shape "sphere")");
  ASSERT_EQ(s.media.size(), 4u);
  EXPECT_EQ(s.media[1].Le, Rgb(2, 4, 6));
  EXPECT_EQ(s.media[1].sigma_a, Rgb(3, 6, 0));
  EXPECT_NEAR(luminance(s.media[2].Le), 1, 1e-3);
  EXPECT_GT(s.media[2].Le.x, 2 * s.media[2].Le.z);
  EXPECT_EQ(s.media[3].Le, Rgb(4, 2, 1));
  EXPECT_TRUE(s.needs.emissive_media);
  EXPECT_FALSE(s.emissive_bodies.empty());
}

TEST_F(ImportMedia, EmissionIsFiniteAndHasOneColour) {
  EXPECT_EQ(
      first_lines(medium("m", "\"rgb sigma_a\" [ 1 1 1 ] \"rgb Le\" [ 1e30 1 1 ] \"float Lescale\" 1e30")),
      "2:135: error: `Lescale` takes `Le` beyond the range of floats\n");
  EXPECT_EQ(first_lines("MakeNamedMedium \"m\" \"string type\" \"uniformgrid\" \"float density\" [ 1 ] "
                        "\"float Lescale\" [ 1 ]"),
            "2:71: warning: `Lescale` of medium \"uniformgrid\" is ignored: `Le` is the same everywhere in a "
            "medium\n");
}

TEST_F(ImportMedia, TheyScatter) {
  const Scene s = world(
      R"(MakeNamedMedium "fog" "string type" "homogeneous" "rgb sigma_a" [ 1 0 0 ] "rgb sigma_s" [ 1 2 3 ]
      "float scale" 0.5 "float g" -0.25
      MakeNamedMedium "ray" "string type" "homogeneous" "float g" 1
      MediumInterface "fog" "ray" Shape "sphere")");
  ASSERT_EQ(s.media.size(), 3u);
  EXPECT_EQ(s.media[1].sigma_s, Rgb(0.5f, 1, 1.5f));
  EXPECT_EQ(s.media[1].sigma_a, Rgb(0.5f, 0, 0));
  EXPECT_EQ(s.media[1].g, -0.25f);
  EXPECT_LT(s.media[2].g, 1) << "a phase function of no width has no value";
  EXPECT_TRUE(s.needs.scattering);
}

// Coke by Narasimhan et al. 2006, in 1/mm for a scene in metres.
TEST_F(ImportMedia, PresetsAreMeasuredMedia) {
  const Scene s = world(R"(MakeNamedMedium "drink" "string type" "homogeneous" "string preset" "Coke"
      "float scale" 1000 MediumInterface "drink" "" Shape "sphere")");
  ASSERT_EQ(s.media.size(), 2u);
  EXPECT_NEAR(s.media[1].sigma_a.x, 100.14f, 1e-3f);
  EXPECT_NEAR(s.media[1].sigma_s.y, 0.08372f, 1e-6f);
  EXPECT_EQ(first_lines(R"(MakeNamedMedium "d" "string type" "homogeneous" "string preset" "Cok")"),
            "2:65: error: there is no measured medium `Cok`; did you mean `Coke`?\n");
}

// A `MediumInterface` behind `Camera` leaves the camera in the vacuum.
TEST_F(ImportMedia, ACameraOutsideTheLightsMediumIsWarnedOf) {
  const std::string fog = medium("fog", "\"rgb sigma_a\" [ 1 1 1 ]");
  const std::string rest = "WorldBegin LightSource \"point\" Shape \"sphere\" ";
  load(fog + "Camera \"perspective\"\nMediumInterface \"\" \"fog\"\n" + rest);
  EXPECT_THAT(
      diagnostics_.format_all(),
      ::testing::HasSubstr("the camera is in medium `vacuum` and light in `fog`, but no surface that lets"));
  EXPECT_EQ(diagnostics_.warning_count(), 1u);
  load(fog + "MediumInterface \"\" \"fog\"\nCamera \"perspective\"\n" + rest);
  EXPECT_EQ(diagnostics_.warning_count(), 0u);
  // Glass, or the boundary of the fog, leads from one to the other.
  load(fog + "Camera \"perspective\"\nMediumInterface \"\" \"fog\"\n" + rest +
       "MediumInterface \"fog\" \"\" Material \"interface\" Shape \"sphere\"");
  EXPECT_EQ(diagnostics_.warning_count(), 0u);
}

// The points are the centres of cells of a box that the directive's transform places.
TEST_F(ImportMedia, GridsGiveDensities) {
  const Scene s = world(R"(Translate 10 0 0 Scale 2 1 1
      MakeNamedMedium "smoke" "string type" "uniformgrid" "rgb sigma_a" [ 1 2 3 ] "float scale" 2
        "integer nx" 2 "integer ny" 1 "integer nz" 2 "float density" [ 1 2 3 4 ]
        "point3 p0" [ 0 0 0 ] "point3 p1" [ 2 4 2 ]
      MediumInterface "smoke" "" Material "interface" Shape "sphere")");
  ASSERT_EQ(s.media.size(), 2u);
  const Medium& smoke = s.media[1];
  EXPECT_EQ(smoke.sigma_a, Rgb(2, 4, 6));
  EXPECT_EQ(smoke.sigma_s, Rgb(2));  // as in pbrt-v4, 1 for grids
  const auto density = [&](float x, float y, float z) {
    return smoke.density_at(Point3(glm::dvec3(x, y, z) - s.origin));
  };
  EXPECT_FLOAT_EQ(density(11, 2, 0.5f), 1);
  EXPECT_FLOAT_EQ(density(13, 2, 0.5f), 2);
  EXPECT_FLOAT_EQ(density(11, 2, 1.5f), 3);
  EXPECT_FLOAT_EQ(density(12, 2, 1), 2.5f);
  EXPECT_EQ(density(9.9f, 2, 1), 0);
  EXPECT_EQ(density(11, 4.1f, 1), 0);
}

// Surfaces that only separate media are not among those that rays meet.
TEST_F(ImportMedia, InterfacesBoundMedia) {
  const Scene s = world(medium("smoke", "\"rgb sigma_a\" [ 1 1 1 ]") + R"(MediumInterface "smoke" ""
      Material "interface" Shape "sphere" AreaLightSource "diffuse" Shape "sphere"
      MediumInterface "smoke" "smoke" Shape "disk")");
  EXPECT_TRUE(s.shapes.empty());
  EXPECT_TRUE(s.lights.empty());
  ASSERT_TRUE(s.interfaces);
  ASSERT_EQ(s.interfaces->shapes.size(), 2u);
  EXPECT_EQ(s.interfaces->shapes[0].media.inside, 1);
  EXPECT_FALSE(s.bounds.empty());
  EXPECT_TRUE(s.needs.media);
}

TEST_F(ImportMedia, DefaultsAreThoseOfAttribute) {
  const Scene s = world("Attribute \"medium\" \"rgb sigma_a\" [ 1 2 3 ]\n" + medium("a", "") +
                        "MediumInterface \"a\" \"\" Shape \"sphere\"");
  ASSERT_EQ(s.media.size(), 2u);
  EXPECT_EQ(s.media[1].sigma_a, Rgb(1, 2, 3));
}

}  // namespace
}  // namespace kaustik::pbrt
