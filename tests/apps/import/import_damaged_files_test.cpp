// Damages every kind of file that a scene reads, by cuts and by changed bytes: the file is read, or refused
// with an error that names it.

#include <gmock/gmock.h>

#include <random>

#include "tests/apps/import/gzipped.h"
#include "tests/apps/import/import_support.h"

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

std::string packed_mesh() {
  std::string text =
      "ply\nformat ascii 1.0\nelement vertex 20\nproperty float x\nproperty float y\nproperty float z\n"
      "element face 18\nproperty list uchar int vertex_indices\nend_header\n";
  for (int i = 0; i < 20; ++i) text += std::to_string(i) + " " + std::to_string(i * i % 7) + " 0.5\n";
  for (int i = 0; i < 18; ++i)
    text += "3 " + std::to_string(i) + " " + std::to_string(i + 1) + " " + std::to_string(i + 2) + "\n";
  return gzipped(text);
}

// A glTF file with its bytes in the text: a triangle of twelve zeros, then floats of 1.
std::string gltf_text() {
  return R"({ "asset": { "version": "2.0" }, "scene": 0, "scenes": [ { "nodes": [ 0, 1 ] } ],
  "nodes": [ { "mesh": 0, "skin": 0, "weights": [ 0.5 ] }, { "translation": [ 0, 0, 1 ], "children": [] } ],
  "skins": [ { "joints": [ 1 ] } ],
  "materials": [ { "name": "paint", "pbrMetallicRoughness": { "baseColorFactor": [ 1, 0.5, 0.25, 1 ] },
      "extensions": { "KHR_materials_anisotropy": { "anisotropyStrength": 0.5 } } } ],
  "meshes": [ { "primitives": [ { "material": 0, "targets": [ { "POSITION": 0 } ],
      "attributes": { "POSITION": 0, "JOINTS_0": 1, "WEIGHTS_0": 2, "COLOR_0": 0 } } ] } ],
  "accessors": [ { "bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3" },
      { "componentType": 5121, "count": 3, "type": "VEC4" },
      { "componentType": 5126, "count": 3, "type": "VEC4" } ],
  "bufferViews": [ { "buffer": 0, "byteLength": 36 } ],
  "buffers": [ { "byteLength": 36,
      "uri": "data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA" } ] })";
}

std::string library() {
  std::string text;
  for (int i = 0; i < 8; ++i)
    text += "newmtl m" + std::to_string(i) + "\nKd 0.5 0.25 0.125\nNs 20.5\nd -halo 0.75\nillum " +
            std::to_string(i) + "\nmap_Kd -s 2 2 1 -o 0.5 0 0 -clamp on none.png\naniso 0.5\n";
  return text;
}

struct Kind {
  std::string name, file;
  std::string scene;  // a scene that reads the file; empty where the file is the scene
  std::string (*bytes)();
};
// GoogleTest prints a case by its name.
void PrintTo(const Kind& kind, std::ostream* out) {
  *out << kind.name;
}

class DamagedFile : public ImportTest, public testing::WithParamInterface<Kind> {
 protected:
  // Returns whether the file was read.
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

// The material library of an OBJ is damaged: the faces are still read.
TEST_F(ImportTest, DamagedMaterialsOfAnObjKeepItsFaces) {
  const std::string bytes = library();
  std::mt19937 random(21);
  for (int trial = 0; trial < 60; ++trial) {
    std::string changed = trial == 0 ? bytes : bytes.substr(0, random() % bytes.size());
    for (int changes = trial % 4; changes > 0 && !changed.empty(); --changes)
      changed[random() % changed.size()] = static_cast<char>(random() % 256);
    write("scene.mtl", changed);
    Diagnostics diagnostics;
    const auto obj = write("scene.obj", "mtllib scene.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl m3\nf 1 2 3\n");
    EXPECT_TRUE(load_scene(obj, diagnostics)) << "trial " << trial << "\n" << diagnostics.format_all();
  }
}

TEST_P(DamagedFile, IsReadOrRefusedWhenCut) {
  const std::string bytes = GetParam().bytes();
  ASSERT_TRUE(try_bytes(bytes, "whole"));
  for (size_t i = 0; i < 50; ++i)
    try_bytes(bytes.substr(0, bytes.size() * i / 50), std::to_string(i) + "/50");
}

TEST_P(DamagedFile, IsReadOrRefusedWhenChanged) {
  const std::string bytes = GetParam().bytes();
  std::mt19937 random(20);
  for (int trial = 0; trial < 60; ++trial) {
    std::string changed = bytes;
    // Half of the changes are in the header, which holds the sizes.
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
        Kind{"gltf", "scene.gltf", "", gltf_text}, Kind{"obj", "scene.obj", "", grid_obj},
        Kind{"ply_gz", "mesh.ply.gz", kFilm + "Shape \"plymesh\" \"string filename\" \"mesh.ply.gz\"\n",
             packed_mesh},
        Kind{"include_gz", "part.pbrt.gz", kFilm + "Include \"part.pbrt.gz\"\n",
             [] {
               return gzipped(
                   "Material \"diffuse\" \"rgb reflectance\" [ 0.5 0.25 0.75 ]\nShape \"sphere\"\n");
             }},
        Kind{"png", "tiles.png", with_image(kTexture, "tiles.png"),
             [] { return of_gallery("images/tiles.png"); }},
        Kind{"exr", "slide.exr", with_image(kTexture, "slide.exr"), [] { return of_gallery("slide.exr"); }},
        Kind{"sky", "light.exr",
             with_image("LightSource \"infinite\" \"string filename\" \"image\"\n", "light.exr"),
             [] { return of_gallery("lamp.exr"); }},
        Kind{"slide", "slide.exr",
             with_image("LightSource \"projection\" \"string filename\" \"image\"\n", "slide.exr"),
             [] { return of_gallery("slide.exr"); }},
        Kind{"spectrum", "light.spd", kFilm + "LightSource \"point\" \"spectrum I\" \"light.spd\"\n",
             spectrum},
        Kind{"include", "part.pbrt", kFilm + "Include \"part.pbrt\"\n",
             [] {
               return of_gallery("rough-metal.pbrt")
                   .substr(of_gallery("rough-metal.pbrt").find("# The plate"));
             }}),
    [](const auto& kind) { return kind.param.name; });

}  // namespace
}  // namespace kaustik::pbrt
