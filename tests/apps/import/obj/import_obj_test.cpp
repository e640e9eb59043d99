// Tests the import of OBJ with MTL.

#include <gmock/gmock.h>

#include "tests/apps/import/obj/obj_support.h"

namespace kaustik::pbrt {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

using ImportObj = ObjTest;

TEST_F(ImportObj, QuadsBecomeTriangles) {
  const auto s = describe(std::string(kObjQuad) + "f 1 2 3 4\n");
  ASSERT_EQ(s.shapes.size(), 1u);
  EXPECT_EQ(numbers(s.shapes[0], "P").size(), 12u);
  EXPECT_EQ(numbers(s.shapes[0], "indices").size(), 6u);
}

TEST_F(ImportObj, MaterialsAreConverted) {
  write("scene.mtl",
        "newmtl paint\nKd 0.25 0.5 0.75\nKs 0.5 0.5 0.5\nNs 98\n"
        "newmtl wall\nKd 0.5 0.5 0.5\nKs 0 0 0\n"
        "newmtl glass\nd 0.25\nNi 1.33\n"
        "newmtl steel\nillum 3\nKs 0.5 0.5 0.5\n"
        "newmtl light\nKe 4 2 1\n");
  const auto s =
      describe("mtllib scene.mtl\n" + std::string(kObjQuad) +
               "usemtl paint\nf 1 2 3\nusemtl wall\nf 1 3 4\nusemtl glass\nf 1 2 4\nusemtl steel\nf 2 3 4\n"
               "usemtl light\nf 1 2 3\n");
  const auto named = [&](std::string_view prefix) -> const MaterialDescription& {
    for (const MaterialDescription& m : s.materials) {
      if (m.name.starts_with(prefix)) return m;
    }
    static const MaterialDescription none;
    return none;
  };
  EXPECT_EQ(named("paint").type, "coateddiffuse");
  EXPECT_THAT(numbers(named("paint"), "reflectance"), ElementsAre(0.25, 0.5, 0.75));
  EXPECT_NEAR(numbers(named("paint"), "roughness").at(0), std::sqrt(2.0 / 100), 1e-12);
  EXPECT_EQ(named("wall").type, "diffuse");
  EXPECT_EQ(named("glass").type, "dielectric");
  EXPECT_EQ(numbers(named("glass"), "eta").at(0), 1.33);
  EXPECT_EQ(named("steel").type, "conductor");
  ASSERT_EQ(s.area_lights.size(), 1u);
  EXPECT_THAT(numbers(s.area_lights[0], "L"), ElementsAre(4, 2, 1));
}

// Options of maps, unknown keywords, and paths of another machine.
TEST_F(ImportObj, TypicalLibrariesAreRead) {
  write("wood.png", "");
  write("my wood.png", "");
  write("scene.mtl",
        "newmtl a\n\tKd 0.5\n\tmap_Kd -s 2 3 1 -o 0.5 0 0 -clamp on wood.png\n\td -halo 0.75\naniso 0.5\n"
        "newmtl b\nKd spectral x.rfl 1\nmap_Kd C:\\\\textures\\\\my wood.png\ndecal d.png\n"
        "newmtl c\nmap_Kd none.png\nKe 2 1 0.5\nmap_Ke wood.png\n");
  const auto s = describe("mtllib scene.mtl\n" + std::string(kObjQuad) +
                          "usemtl a\nf 1 2 3\nusemtl b\nf 1 3 4\nusemtl c\nf 1 2 4\n");
  ASSERT_EQ(s.textures.size(), 2u);
  EXPECT_EQ(s.textures[0].find("filename")->strings[0], "wood.png");
  EXPECT_THAT(numbers(s.textures[0], "uscale"), ElementsAre(2));
  EXPECT_THAT(numbers(s.textures[0], "vscale"), ElementsAre(3));
  EXPECT_THAT(numbers(s.textures[0], "udelta"), ElementsAre(0.5));
  EXPECT_EQ(s.textures[0].find("wrap")->strings[0], "clamp");
  EXPECT_EQ(s.textures[1].find("filename")->strings[0], "my wood.png");
  ASSERT_EQ(s.shapes.size(), 3u);
  EXPECT_THAT(numbers(s.shapes[0], "alpha"), ElementsAre(0.75));
  ASSERT_EQ(s.area_lights.size(), 1u);
  EXPECT_EQ(s.area_lights[0].find("filename")->strings[0], "wood.png");
  EXPECT_THAT(numbers(s.area_lights[0], "scale"), ElementsAre(2));
  for (const char* said : {"`aniso`", "`Kd spectral`", "`decal`", "there is no file \"none.png\""})
    EXPECT_THAT(diagnostics_.format_all(), HasSubstr(said));
}

TEST_F(ImportObj, SeveralLibrariesAreRead) {
  write("a.mtl", "newmtl a\nKd 0.25 0.25 0.25\n");
  write("b.mtl", "newmtl b\nKd 0.75 0.75 0.75\n");
  const auto s =
      describe("mtllib a.mtl b.mtl\n" + std::string(kObjQuad) + "usemtl a\nf 1 2 3\nusemtl b\nf 1 3 4\n");
  double sum = 0;
  for (const MaterialDescription& m : s.materials) {
    if (m.name == "a" || m.name == "b") sum += numbers(m, "reflectance").at(0);
  }
  EXPECT_EQ(sum, 1);
}

TEST_F(ImportObj, MissingLibrariesGiveGreyMaterials) {
  describe("mtllib none.mtl\n" + std::string(kObjQuad) + "f 1 2 3\n");
  EXPECT_THAT(diagnostics_.format_all(),
              HasSubstr("scene.obj:1:8: warning: there is no material library \"none.mtl\""));
}

TEST_F(ImportObj, DamagedFilesAreRefused) {
  EXPECT_THAT(error(std::string(kObjQuad) + "f 1 2 9\n"), HasSubstr("scene.obj"));
  EXPECT_THAT(error(std::string(kObjQuad)), HasSubstr("scene.obj"));
  EXPECT_THAT(error("v nan 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"), HasSubstr("scene.obj"));
  EXPECT_THAT(error(std::string("\0\x01\x7f\xff", 4)), HasSubstr("scene.obj"));
  EXPECT_THAT(error(""), HasSubstr("scene.obj"));
}

}  // namespace
}  // namespace kaustik::pbrt
