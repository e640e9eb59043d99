// Tests kaustik info on scenes with textures, whose images it does not read.

#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "render/picture/image_io.h"
#include "tests/apps/support/program.h"

namespace kaustik::app {
namespace {

using test::Outcome;
using test::run_kaustik;
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

}  // namespace
}  // namespace kaustik::app
