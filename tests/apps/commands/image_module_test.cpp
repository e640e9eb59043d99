// Tests which libraries the program, as a process of its own, loads and when: loading OpenImageIO takes
// longer than many renders.

#include <gmock/gmock.h>

#include <cstdio>

#include "render/picture/image_io.h"
#include "tests/apps/support/program.h"

namespace kaustik::app {
namespace {

namespace fs = std::filesystem;
using test::run_kaustik;
using ::testing::HasSubstr;
using ::testing::Not;

using Arguments = std::vector<std::string>;

class ImageModule : public test::ProgramTest {
 protected:
  struct Run {
    int code = -1;
    std::string said;    // output of both streams
    std::string loader;  // log of the dynamic loader, by LD_DEBUG=files
  };

  Run run(const std::string& program, const Arguments& arguments) const {
    const std::string log = path("loader");
    std::string line = "LD_DEBUG=files LD_DEBUG_OUTPUT='" + log + "' '" + program + "'";
    for (const std::string& argument : arguments) line += " '" + argument + "'";
    Run out;
    FILE* const pipe = popen((line + " 2>&1").c_str(), "r");
    for (int c; (c = std::fgetc(pipe)) != EOF;) out.said += static_cast<char>(c);
    out.code = WEXITSTATUS(pclose(pipe));
    for (const std::string& name : files()) {
      if (!name.starts_with("loader.")) continue;  // the name ends with the process id
      out.loader += read(name);
      fs::remove(path(name));
    }
    return out;
  }

  static Arguments render(const std::string& scene, const std::string& output) {
    return {"render", scene, "-o", output, "--photons", "5k", "--guide", "off", "--spp", "1", "-q"};
  }

  // A scene of a floor with an image on it.
  std::string textured_scene() const {
    render::Image image(2, 2, Rgb(0.5f, 0.1f, 0.1f));
    image.at(1, 0) = Rgb(0.1f, 0.5f, 0.1f);
    render::write_image(path("tiles.png"), image);
    return write("textured.pbrt",
                 "LookAt 0 2 6  0 0 0  0 1 0\nCamera \"perspective\"\n" + film(24, 16) +
                     "\nWorldBegin\nLightSource \"point\" \"point3 from\" [0 3 0] \"rgb I\" [9 9 9]\n"
                     "Texture \"tiles\" \"spectrum\" \"imagemap\" \"string filename\" \"tiles.png\"\n"
                     "Material \"diffuse\" \"texture reflectance\" \"tiles\"\n"
                     "Shape \"trianglemesh\" \"integer indices\" [0 1 2 0 2 3] \"point3 P\" "
                     "[-3 0 3  3 0 3  3 0 -3  -3 0 -3] \"point2 uv\" [0 0  1 0  1 1  0 1]\n");
  }

  // A copy of the program alone in a folder.
  std::string copied_program() const {
    fs::copy_file(KAUSTIK_PROGRAM, path("kaustik"));
    return path("kaustik");
  }
};

TEST_F(ImageModule, ExrIsRenderedWithoutOpenImageIo) {
  const Run run = this->run(KAUSTIK_PROGRAM, render(small_scene(film(24, 16)), path("a.exr")));
  ASSERT_EQ(run.code, kDone) << run.said;
  EXPECT_TRUE(exists("a.exr"));
  EXPECT_THAT(run.loader, HasSubstr("libOpenEXR"));
  EXPECT_THAT(run.loader, Not(HasSubstr("libOpenImageIO")));
}

// The bits are those of the code that this test is linked to.
TEST_F(ImageModule, PngAndTexturesUseIt) {
  const std::string scene = textured_scene();
  for (const std::string extension : {".png", ".exr"}) {
    const Run run = this->run(KAUSTIK_PROGRAM, render(scene, path("program" + extension)));
    ASSERT_EQ(run.code, kDone) << run.said;
    EXPECT_THAT(run.loader, HasSubstr("libOpenImageIO"));
    ASSERT_EQ(run_kaustik(render(scene, path("linked" + extension))).code, kDone);
    EXPECT_EQ(read("program" + extension), read("linked" + extension)) << extension;
  }
}

TEST_F(ImageModule, OnlyItsUsersFailWithoutIt) {
  const std::string program = copied_program(), plain = small_scene(film(24, 16));
  EXPECT_EQ(run(program, render(plain, path("a.exr"))).code, kDone);
  for (const Arguments& arguments : {render(plain, path("b.png")), render(textured_scene(), path("c.exr")),
                                     Arguments{"compare", path("a.exr"), path("a.exr")}}) {
    const Run run = this->run(program, arguments);
    EXPECT_EQ(run.code, kFailed) << arguments[0];
    EXPECT_THAT(run.said, HasSubstr("cannot load kaustik-images.so"));
    EXPECT_THAT(run.said, HasSubstr("No such file")) << "the loader's own words";
  }
  EXPECT_FALSE(exists("b.png"));
  EXPECT_FALSE(exists("c.exr"));
}

}  // namespace
}  // namespace kaustik::app
