// Every kind of file that a scene reads, cut short and with changed bytes: it is read or refused, and what is
// refused is named.

#include <gmock/gmock.h>

#include <random>

#include "import_support.h"

namespace kaustik::pbrt {
namespace {

std::string contents(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}
std::string of_gallery(const std::string& name) {
  return contents(std::filesystem::path(KAUSTIK_SCENES_DIR) / "gallery" / name);
}

std::string grid_obj() {
  std::string text = "# a grid\nmtllib grid.mtl\n";
  for (int i = 0; i < 5; ++i)
    for (int j = 0; j < 5; ++j)
      text +=
          "v " + std::to_string(i) + " " + std::to_string(j) + " 0.25\nvt 0." + std::to_string(i) + " 0.5\n";
  text += "vn 0 0 1\nusemtl red\ng part\n";
  for (int i = 0; i < 4; ++i) {
    for (int j = 1; j < 5; ++j) {
      const auto corner = [](int k) { return " " + std::to_string(k) + "/" + std::to_string(k) + "/1"; };
      text += "f" + corner(5 * i + j) + corner(5 * i + j + 1) + corner(5 * i + j + 6) +
              corner(5 * i + j + 5) + "\n";
    }
  }
  return text;
}

std::string spectrum() {
  std::string text = "# nm, value\n";
  for (int nm = 360; nm <= 830; nm += 10) text += std::to_string(nm) + " " + std::to_string(nm % 70) + ".5\n";
  return text;
}

struct Kind {
  std::string name, file;
  std::string scene;  // that reads it; empty where the file is the scene
  std::string (*bytes)();
};
// By which ctest names the case.
void PrintTo(const Kind& kind, std::ostream* out) {
  *out << kind.name;
}

class DamagedFile : public ImportTest, public testing::WithParamInterface<Kind> {
 protected:
  // Whether it was read.
  bool try_bytes(const std::string& bytes, const std::string& what) {
    const Kind& kind = GetParam();
    const auto file = write(kind.file, bytes);
    const auto scene = kind.scene.empty() ? file : write("scene.pbrt", kind.scene);
    Diagnostics diagnostics;
    const auto loaded = load_scene(scene, diagnostics);
    EXPECT_EQ(loaded.has_value(), !diagnostics.has_errors()) << what;
    if (!loaded) {
      EXPECT_THAT(diagnostics.format_all(), testing::HasSubstr(kind.file)) << what;
    }
    return loaded.has_value();
  }
};

TEST_P(DamagedFile, CutAnywhere) {
  const std::string bytes = GetParam().bytes();
  ASSERT_TRUE(try_bytes(bytes, "whole"));
  for (size_t i = 0; i < 50; ++i)
    try_bytes(bytes.substr(0, bytes.size() * i / 50), std::to_string(i) + "/50");
}

TEST_P(DamagedFile, ChangedAnywhere) {
  const std::string bytes = GetParam().bytes();
  std::mt19937 random(20);
  for (int trial = 0; trial < 60; ++trial) {
    std::string changed = bytes;
    // Some in the head, where the sizes are.
    const size_t within = trial % 2 ? std::min<size_t>(bytes.size(), 400) : bytes.size();
    for (int changes = 1 + trial % 4; changes > 0; --changes)
      changed[random() % within] = static_cast<char>(random() % 256);
    try_bytes(changed, "trial " + std::to_string(trial));
  }
}

const std::string kFilm = "Film \"rgb\" \"integer xresolution\" 8 \"integer yresolution\" 8\nWorldBegin\n";
const std::string kTexture =
    "Texture \"t\" \"spectrum\" \"imagemap\" \"string filename\" \"image\"\n"
    "Material \"diffuse\" \"texture reflectance\" \"t\"\nShape \"sphere\"\n";
std::string with_image(const std::string& scene, const std::string& file) {
  std::string text = kFilm + scene;
  return text.replace(text.find("\"image\""), 7, "\"" + file + "\"");
}

INSTANTIATE_TEST_SUITE_P(
    All, DamagedFile,
    testing::Values(
        Kind{"glb", "scene.glb", "", [] { return of_gallery("gltf.glb"); }},
        Kind{"obj", "scene.obj", "", grid_obj},
        Kind{"png", "tiles.png", with_image(kTexture, "tiles.png"),
             [] { return of_gallery("images/tiles.png"); }},
        Kind{"exr", "slide.exr", with_image(kTexture, "slide.exr"), [] { return of_gallery("slide.exr"); }},
        Kind{"sky", "lamp.exr",
             with_image("LightSource \"infinite\" \"string filename\" \"image\"\n", "lamp.exr"),
             [] { return of_gallery("lamp.exr"); }},
        Kind{"slide", "slide.exr",
             with_image("LightSource \"projection\" \"string filename\" \"image\"\n", "slide.exr"),
             [] { return of_gallery("slide.exr"); }},
        Kind{"spectrum", "lamp.spd", kFilm + "LightSource \"point\" \"spectrum I\" \"lamp.spd\"\n", spectrum},
        Kind{"include", "part.pbrt", kFilm + "Include \"part.pbrt\"\n",
             [] {
               return of_gallery("rough-metal.pbrt")
                   .substr(of_gallery("rough-metal.pbrt").find("# The plate"));
             }}),
    [](const auto& kind) { return kind.param.name; });

}  // namespace
}  // namespace kaustik::pbrt
