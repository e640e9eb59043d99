// Tests kaustik info on scenes with textures, whose images it does not read.

#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "render/picture/image_io.h"
#include "tests/apps/support/program.h"

namespace kaustik::app {
namespace {

using test::Outcome;
using test::run_kaustik;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

class InfoCommand : public test::ProgramTest {
 protected:
  std::string scene_with(const std::string& image) const {
    return write("textured.pbrt",
                 "WorldBegin\nLightSource \"point\"\n"
                 "Texture \"t\" \"spectrum\" \"imagemap\" \"string filename\" \"" +
                     image +
                     "\"\nMaterial \"diffuse\" \"rgb reflectance\" [ .5 .5 .5 ]\nShape \"sphere\"\n"
                     "Material \"diffuse\" \"texture reflectance\" \"t\"\nShape \"sphere\"\n");
  }
};

// The second half of the pixels is missing: a render refuses the image.
TEST_F(InfoCommand, ReadsTheHeadersOfTexturesOnly) {
  render::Image noise(64, 64);
  for (size_t i = 0; i < noise.pixels.size(); ++i) noise.pixels[i] = Rgb(float(i * i % 251) / 251);
  render::write_image(path("whole.png"), noise);
  const std::string bytes = read("whole.png");
  write("half.png", bytes.substr(0, bytes.size() / 2));
  for (const char* image : {"whole.png", "half.png"}) {
    const Outcome info = run_kaustik({"info", scene_with(image), "--json"});
    ASSERT_EQ(info.code, kDone) << info.err;
    const nlohmann::json materials = nlohmann::json::parse(info.out)["materials"];
    ASSERT_EQ(materials.size(), 2u);
    EXPECT_EQ(materials[0]["albedo"][0], 0.5);
    EXPECT_TRUE(materials[1]["albedo"].is_null());
  }
  EXPECT_THAT(run_kaustik({"info", scene_with("half.png")}).out, HasSubstr("diffuse, with textures"));
  EXPECT_EQ(run_kaustik({"render", scene_with("half.png"), "-o", path("a.exr"), "-q"}).code, kBadScene);
}

TEST_F(InfoCommand, ReportsImagesThatAreMissingOrNone) {
  const Outcome missing = run_kaustik({"info", scene_with("none.png")});
  EXPECT_EQ(missing.code, kBadScene);
  EXPECT_THAT(missing.err, HasSubstr("no such file"));
  write("text.png", "no picture at all");
  const Outcome text = run_kaustik({"info", scene_with("text.png")});
  EXPECT_EQ(text.code, kBadScene);
  EXPECT_THAT(text.err, HasSubstr("cannot read the image"));
}

TEST_F(InfoCommand, TellsMediaAndTheirGrids) {
  const std::string scene = write(
      "smoke.pbrt",
      "WorldBegin\nLightSource \"point\"\nMakeNamedMedium \"fog\" \"string type\" \"homogeneous\"\n"
      "MakeNamedMedium \"smoke\" \"string type\" \"uniformgrid\" \"integer ny\" 2 \"integer nz\" 3 \"float "
      "density\" [ 0 1 2 3 0.5 0 ]\nMediumInterface \"smoke\" \"fog\"\nShape \"sphere\"\n");
  const nlohmann::json media = nlohmann::json::parse(run_kaustik({"info", scene, "--json"}).out)["media"];
  ASSERT_EQ(media.size(), 2u);
  EXPECT_FALSE(media[0].contains("grid"));
  EXPECT_THAT(media[1]["grid"], ElementsAre(1, 2, 3));
  EXPECT_EQ(media[1]["largest_density"], 3);
  EXPECT_THAT(run_kaustik({"info", scene}).out,
              HasSubstr("g 0, times densities up to 3 on a grid of 1 x 2 x 3 points\n"));
}

// Two objects share a material whose name the MTL file has once; faces before the first object have their
// material's name. Shapes lie apart, since those that touch share their photons.
TEST_F(InfoCommand, NamesThingsAsTheirFileDoes) {
  write("room.mtl", "newmtl oak\nKd .5 .4 .3\nnewmtl unused\nKd 1 0 0\n");
  std::string vertices;
  for (int i = 0; i < 3; ++i)
    for (const char* corner : {"0 0", "1 0", "0 1"})
      vertices += "v " + std::to_string(3 * i) + " " + corner + "\n";
  const std::string scene = write(
      "room.obj", "mtllib room.mtl\n" + vertices + "usemtl oak\nf 1 2 3\no table\nf 4 5 6\no oak\nf 7 8 9\n");
  const Outcome info = run_kaustik({"info", scene, "--json", "--floor", "on"});
  ASSERT_EQ(info.code, kDone) << info.err;
  const auto names = [json = nlohmann::json::parse(info.out)](const char* list) {
    std::vector<std::string> found;
    for (const nlohmann::json& item : json[list]) found.push_back(item["name"]);
    return found;
  };
  EXPECT_THAT(names("materials"), ElementsAre("oak", "studio floor"));
  EXPECT_THAT(names("surface_groups"), ElementsAre("oak", "table, oak", "oak", "studio floor"));
}

}  // namespace
}  // namespace kaustik::app
