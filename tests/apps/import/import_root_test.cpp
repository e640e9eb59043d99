// Tests that scenes read nothing outside a root, whatever names the file, and that files of other kinds than
// the scene takes are not quoted.

#include <gmock/gmock.h>

#include "tests/apps/import/import_support.h"

namespace kaustik::pbrt {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

const std::string kPicture = "P6\n4 4\n255\n" + std::string(48, 'a');
const std::string kTriangle =
    "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
    "element face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
const std::string kQuad = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";
const std::string kBuffer(36, '\0');

std::string gltf(const std::string& buffer, const std::string& image) {
  return R"({ "asset": { "version": "2.0" }, "buffers": [ { "uri": ")" + buffer + R"(", "byteLength": 36 } ],
    "bufferViews": [ { "buffer": 0, "byteLength": 36 } ],
    "accessors": [ { "bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3" } ],
    "meshes": [ { "primitives": [ { "attributes": { "POSITION": 0 }, "material": 0 } ] } ],
    "materials": [ { "emissiveTexture": { "index": 0 }, "emissiveFactor": [ 1, 1, 1 ],
                     "pbrMetallicRoughness": { "baseColorTexture": { "index": 0 } } } ],
    "textures": [ { "source": 0 } ], "images": [ { "uri": ")" +
         image + R"(" } ], "nodes": [ { "mesh": 0 } ] })";
}

// A scene whose text names a file as `@`, that file, and where the error is.
struct Reference {
  std::string scene, text, file, content, place;
};

const std::string kWorld = "WorldBegin\n";
const std::vector<Reference> kReferences = {
    {"s.pbrt", kWorld + "Include \"@\"", "a.pbrt", "LightSource \"point\"", "s.pbrt:2:9: error"},
    {"s.pbrt", kWorld + "Import \"@\"", "a.pbrt", "LightSource \"point\"", "s.pbrt:2:8: error"},
    {"s.pbrt", kWorld + "Shape \"plymesh\" \"string filename\" \"@\"", "a.ply", kTriangle,
     "s.pbrt:2:35: error"},
    {"s.pbrt", kWorld + "Texture \"t\" \"spectrum\" \"imagemap\" \"string filename\" \"@\"", "a.ppm",
     kPicture, "s.pbrt:2:53: error"},
    {"s.pbrt", kWorld + "LightSource \"infinite\" \"string filename\" \"@\"", "a.ppm", kPicture,
     "s.pbrt:2:42: error"},
    {"s.pbrt", kWorld + "AreaLightSource \"diffuse\" \"string filename\" \"@\" Shape \"disk\"", "a.ppm",
     kPicture, "s.pbrt:2:45: error"},
    {"s.pbrt", kWorld + "Material \"diffuse\" \"string normalmap\" \"@\"", "a.ppm", kPicture,
     "s.pbrt:2:39: error"},
    {"s.pbrt", kWorld + "LightSource \"point\" \"spectrum I\" \"@\"", "a.spd", "300 1 900 2",
     "s.pbrt:2:34: error"},
    {"s.pbrt", "Camera \"realistic\" \"string lensfile\" \"@\"\nWorldBegin", "a.dat",
     "50 0 1.5 20 -50 0 1 20 0 1 0 10", "s.pbrt:1:38: error"},
    {"s.obj", "mtllib @\n" + kQuad + "usemtl m\nf 1 2 3\n", "a.mtl", "newmtl m\n", "s.obj:1:8: error"},
    {"s.gltf", gltf("@", "inside.ppm"), "a.bin", kBuffer, "s.gltf: error: `buffers[0]`"},
    {"s.gltf", gltf("inside.bin", "@"), "a.ppm", kPicture, "s.gltf: error: `images[0]`"},
};

class ImportRoot : public ImportTest {
 protected:
  void SetUp() override {
    ImportTest::SetUp();
    folder_ = fs::canonical(folder_);
    root_ = folder_ / "root";
    fs::create_directories(folder_ / "outside");
    write("root/inside.bin", kBuffer);
    write("root/inside.ppm", kPicture);
    fs::create_symlink("../outside", root_ / "linked");
  }

  // `sky`: what lights models; the studio that is made for them takes a while.
  bool loads(const Reference& r, const std::string& name, const std::string& root,
             const std::string& sky = "off") {
    std::string text = r.text;
    for (size_t at; (at = text.find('@')) != text.npos;) text.replace(at, 1, name);
    diagnostics_ = Diagnostics();
    const ImportOptions options{.view = {.sky = r.scene == "s.pbrt" ? "" : sky}, .root = root};
    return load_scene(write("root/" + r.scene, text), diagnostics_, options).has_value();
  }
  std::string said() const { return diagnostics_.format_all(); }
  void expect_refused(const Reference& r, const std::string& name) {
    SCOPED_TRACE(r.text + " " + name);
    EXPECT_FALSE(loads(r, name, root_.string()));
    EXPECT_EQ(diagnostics_.error_count(), 1u) << said();
    EXPECT_THAT(said(), HasSubstr(r.place));
    EXPECT_THAT(said(), HasSubstr("\": it lies outside --root " + root_.string()));
  }

  fs::path root_;
};

// Without a root each of these files is read.
TEST_F(ImportRoot, FilesOutsideAreRefusedWhetherOrNotTheyExist) {
  for (const Reference& r : kReferences) {
    const fs::path outside = write("outside/" + r.file, r.content), link = root_ / ("link-" + r.file);
    fs::remove(link);
    fs::create_symlink(outside, link);
    std::vector<std::string> names = {outside.string(), "../outside/" + r.file, "linked/" + r.file,
                                      link.filename().string()};
    if (r.scene == "s.gltf") names.push_back("%2e%2e/outside/%61" + r.file.substr(1));
    for (const std::string& name : names) {
      write("outside/" + r.file, r.content);
      EXPECT_TRUE(loads(r, name, "") || r.scene == "s.gltf") << name << said();
      EXPECT_THAT(said(), Not(HasSubstr("does not exist")));
      expect_refused(r, name);
      const std::string there = said();
      fs::remove(outside);
      expect_refused(r, name);
      EXPECT_EQ(said(), there);
    }
  }
}

TEST_F(ImportRoot, ImagesOfMaterialLibrariesAreRefused) {
  write("outside/a.ppm", kPicture);
  const Reference r{"s.obj", "mtllib s.mtl\n" + kQuad + "usemtl m\nf 1 2 3\n", "", "", "s.mtl:2:8: error"};
  for (const std::string name : {"../outside/a.ppm", "linked/a.ppm", "/etc/a.ppm"}) {
    write("root/s.mtl", "newmtl m\nmap_Kd " + name + "\n");
    expect_refused(r, "");
    EXPECT_THAT(said(), HasSubstr("map_Kd " + name + "\n       ^"));
  }
  // Names of other machines are known to lead nowhere: the file of the last name is taken.
  write("root/a.ppm", kPicture);
  write("root/s.mtl", "newmtl m\nmap_Kd /srv/elsewhere/a.ppm\n");
  EXPECT_TRUE(loads(r, "", root_.string())) << said();
}

TEST_F(ImportRoot, FilesInsideAreRead) {
  fs::create_symlink(root_, folder_ / "way");
  fs::create_directories(root_ / "sub");
  const std::string relative = fs::proximate(root_).string();
  for (const Reference& r : kReferences) {
    write("root/sub/" + r.file, r.content);
    for (const std::string& root :
         {root_.string(), root_.string() + "/", relative, relative + "/.", (folder_ / "way").string()})
      for (const std::string& name :
           {"sub/" + r.file, "sub/../sub/" + r.file, (root_ / "sub" / r.file).string()}) {
        EXPECT_TRUE(loads(r, name, root)) << r.text << " " << name << " " << root << "\n" << said();
        EXPECT_THAT(said(), Not(HasSubstr("grey")));
      }
  }
}

// A root changes nothing in what is read, so partial results of both go together.
TEST_F(ImportRoot, TheHashOfAContentIsTheSame) {
  write("root/a.ply", kTriangle);
  const fs::path scene = write("root/s.pbrt", kWorld + "Shape \"plymesh\" \"string filename\" \"a.ply\"");
  Diagnostics without, with;
  const auto a = load_scene(scene, without),
             b = load_scene(scene, with, ImportOptions{.root = root_.string()});
  ASSERT_TRUE(a && b) << with.format_all();
  EXPECT_EQ(a->content_hash, b->content_hash);
}

TEST_F(ImportRoot, TheSceneItselfMustLieInside) {
  for (const Reference& r : kReferences) {
    diagnostics_ = Diagnostics();
    const fs::path scene = write("outside/" + r.scene, r.text);
    EXPECT_FALSE(load_scene(scene, diagnostics_, ImportOptions{.root = root_.string()}));
    EXPECT_EQ(said(), "error: cannot read \"" + scene.string() + "\": it lies outside --root " +
                          root_.string() + "\n");
  }
}

// Images that are embedded in glTF files, that are made from others, and that of the studio lie in temporary
// folders, which are no part of the root.
TEST_F(ImportRoot, FilesThatTheImporterMakesAreRead) {
  const std::string text = gltf("inside.bin",
                                "data:image/bmp;base64,Qk06AAAAAAAAADYAAAAoAAAAAQAAAAEAAAABABgAA"
                                "AAAAAQAAAATCwAAEwsAAAAAAAAAAAAAAAD/AA==");
  EXPECT_TRUE(loads({"s.gltf", text, "", "", ""}, "", root_.string(), "")) << said();
  EXPECT_THAT(said(), AllOf(HasSubstr("studio"), Not(HasSubstr("grey"))));
  write("root/s.mtl", "newmtl m\nKd 0.5 0.5 0.5\nmap_Pr inside.ppm\n");
  const std::string obj = "mtllib s.mtl\n" + kQuad + "usemtl m\nf 1 2 3\n";
  EXPECT_TRUE(loads({"s.obj", obj, "", "", ""}, "", root_.string())) << said();
  EXPECT_EQ(diagnostics_.warning_count(), 1u) << said();  // that there is no camera
}

// Lines of any file but scenes stay unsaid, with a root or without.
TEST_F(ImportRoot, OtherFilesAreNotQuoted) {
  const std::string shadow = "root:$6$secret:19000:0:99999:7:::\n";
  for (const std::string& secret :
       std::vector<std::string>{shadow, "# users\n" + shadow, "Include /etc/secret\n" + shadow, "\"secret",
                                "{ \"secret\": secret }", "1 secret", "Host secret"}) {
    write("root/other", secret);
    for (const Reference& r : kReferences) {
      loads(r, "other", "");
      EXPECT_THAT(said(), Not(HasSubstr("secret"))) << r.text;
    }
    diagnostics_ = Diagnostics();
    load_scene(write("root/s.gltf", secret), diagnostics_);
    EXPECT_THAT(said(), Not(HasSubstr("secret")));
  }
}

}  // namespace
}  // namespace kaustik::pbrt
