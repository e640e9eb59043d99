// Tests kaustik convert: the text that it writes, and that this text renders to the same bits.

#include <gmock/gmock.h>

#include "tests/apps/support/program.h"

namespace kaustik::app {
namespace {

using test::Outcome;
using test::run_kaustik;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

class ConvertCommand : public test::ProgramTest {
 protected:
  // Renders in the test's folder and returns the picture's bytes.
  std::string picture(const std::string& scene, const std::string& name) const {
    const Outcome outcome = run_kaustik({"render", path(scene), "-o", path(name), "--spp", "2", "--photons",
                                         "2000", "--width", "24", "--threads", "1", "-q"});
    EXPECT_EQ(outcome.code, kDone) << outcome.err;
    return read(name);
  }
  // Expects that a scene and its conversion give the same picture, to the bit. Pictures are PNG, since EXR
  // files contain the scene's hash and times.
  void expect_same_picture(const std::string& scene) const {
    const Outcome outcome = run_kaustik({"convert", path(scene), path("converted.pbrt")});
    ASSERT_EQ(outcome.code, kDone) << outcome.err;
    EXPECT_THAT(outcome.err, HasSubstr("wrote " + path("converted.pbrt")));
    EXPECT_EQ(picture(scene, "a.png"), picture("converted.pbrt", "b.png"));
    const Outcome difference = run_kaustik({"compare", path("a.png"), path("b.png"), "--max-relmse", "0"});
    EXPECT_EQ(difference.code, kDone) << difference.out;
  }
};

TEST_F(ConvertCommand, PbrtRendersToTheSameBits) {
  std::string mesh = "\"integer indices\" [", points = "] \"point3 P\" [";
  for (int i = 0; i < 30; ++i) {
    const std::string x = std::to_string(0.05 * i - 0.75);
    mesh += " " + std::to_string(3 * i) + " " + std::to_string(3 * i + 1) + " " + std::to_string(3 * i + 2);
    points += " " + x + " 0.25 1  " + x + "25 0.75 1  " + x + "5 0.25 1.5\n";
  }
  write("scene.pbrt", read([this] {
                        small_scene(film(24, 18));
                        return std::string("small.pbrt");
                      }()) +
                          R"(
    MakeNamedMaterial "gold \"leaf\"" "string type" "conductor" "spectrum eta" "metal-Au-eta" "spectrum k" "metal-Au-k"
    AttributeBegin
      NamedMaterial "gold \"leaf\""
      Shape "trianglemesh" )" +
                          mesh + points + R"(]
    AttributeEnd
    ObjectBegin "ball" Shape "sphere" "float radius" 0.2 ObjectEnd
    AttributeBegin Translate 1 0.2 0 Rotate 33 1 2 3 ObjectInstance "ball" AttributeEnd
    LightSource "point" "blackbody I" 3000 "point3 from" [ 1 3 1 ])");
  expect_same_picture("scene.pbrt");
}

// Grids of densities stay where they were; so does the camera behind them.
TEST_F(ConvertCommand, MediaRenderToTheSameBits) {
  small_scene(R"(Translate 0.1 0.2 0 Rotate 20 1 2 3
    MakeNamedMedium "smoke" "string type" "uniformgrid" "integer nx" 2 "integer ny" 3 "float density" [ 1 2 3 0 5 6 ]
      "point3 p0" [ -2 0 -2 ] "point3 p1" [ 2 2 2 ]
    Identity )" +
              film(24, 18));
  write("scene.pbrt", read("small.pbrt") +
                          "MediumInterface \"smoke\" \"\" Material \"interface\" Shape \"sphere\" \"float "
                          "radius\" 1.5\n");
  expect_same_picture("scene.pbrt");
  EXPECT_THAT(read("converted.pbrt"), HasSubstr("uniformgrid"));
}

// Colours of vertices go into the PLY file as floats, and the texture that shows them into the text.
TEST_F(ConvertCommand, ColoursOfVerticesRenderToTheSameBits) {
  std::string corners = "\"integer indices\" [", points = "] \"point3 P\" [", colours = "] \"float Cd\" [";
  for (int i = 0; i < 13; ++i) {
    const double x = i * 0.125 - 0.75;
    corners +=
        " " + std::to_string(3 * i) + " " + std::to_string(3 * i + 1) + " " + std::to_string(3 * i + 2);
    for (const auto& [dx, y, z] : {std::array{0.0, 0.25, 1.0}, {0.0625, 0.75, 1.0}, {0.03125, 0.25, 1.5}})
      points += " " + std::to_string(x + dx) + " " + std::to_string(y) + " " + std::to_string(z);
    colours += " 1 0 0 1  0 1 0 1  0.25 0 " + std::to_string(i * 0.0625) + " 0.5";
  }
  small_scene(film(24, 18));
  write("scene.pbrt", read("small.pbrt") + R"(
    Texture "colours" "spectrum" "vertexcolor"
    Material "diffuse" "texture reflectance" "colours"
    Shape "trianglemesh" )" +
                          corners + points + colours + "]");
  expect_same_picture("scene.pbrt");
  EXPECT_THAT(read("converted.pbrt"), HasSubstr("plymesh"));
}

// Vertices that are exact floats are written to a PLY file.
TEST_F(ConvertCommand, ObjRendersToTheSameBits) {
  std::string obj = "mtllib scene.mtl\nusemtl clay\n";
  for (int i = 0; i <= 8; ++i) {
    for (int k = 0; k <= 8; ++k)
      obj += "v " + std::to_string(i / 8.0) + " " + std::to_string((i * k % 5) / 16.0) + " " +
             std::to_string(k / 8.0) + "\n";
  }
  for (int i = 0; i < 8; ++i) {
    for (int k = 0; k < 8; ++k) {
      const int a = 9 * i + k + 1;
      obj += "f " + std::to_string(a) + " " + std::to_string(a + 1) + " " + std::to_string(a + 10) + " " +
             std::to_string(a + 9) + "\n";
    }
  }
  write("scene.mtl", "newmtl clay\nKd 0.5 0.25 0.125\n");
  write("scene.obj", obj);
  expect_same_picture("scene.obj");
  EXPECT_TRUE(exists("converted-files/mesh0.ply"));
}

TEST_F(ConvertCommand, BadScenesWriteNothing) {
  write("bad.pbrt", "WorldBegin\nShape \"spere\"\n");
  const Outcome outcome = run_kaustik({"convert", path("bad.pbrt"), path("out.pbrt")});
  EXPECT_EQ(outcome.code, kBadScene);
  EXPECT_THAT(outcome.err, HasSubstr("bad.pbrt:2:7: error"));
  EXPECT_THAT(files(), ElementsAre("bad.pbrt"));
}

TEST_F(ConvertCommand, BadOutputNamesAreRefused) {
  const std::string scene = small_scene();
  EXPECT_EQ(run_kaustik({"convert", scene, path("out.obj")}).code, kBadCommandLine);
  EXPECT_EQ(run_kaustik({"convert", scene, scene}).code, kBadCommandLine);
  EXPECT_EQ(run_kaustik({"convert", scene, path("no/such/folder.pbrt")}).code, kBadCommandLine);
  EXPECT_EQ(run_kaustik({"convert", scene}).code, kBadCommandLine);
}

}  // namespace
}  // namespace kaustik::app
