// Tests material libraries as other programs write them: where they and their images are found, and what
// becomes of their statements.

#include "tests/apps/import/obj/obj_support.h"

namespace kaustik::pbrt {
namespace {

using testing::ElementsAre;
using testing::EndsWith;
using testing::HasSubstr;
using testing::Not;
using testing::SizeIs;

class ImportMtl : public ObjTest {
 protected:
  SceneDescription with_library(const std::string& mtllib) {
    return describe("mtllib " + mtllib + "\n" + std::string(kObjQuad) + "usemtl red\nf 1 2 3\n");
  }
  // A face of the only material `m`.
  SceneDescription with_material(const std::string& statements) {
    write("scene.mtl", "newmtl m\n" + statements);
    return describe("mtllib scene.mtl\n" + std::string(kObjQuad) + "usemtl m\nf 1 2 3\n");
  }
  MaterialDescription material(const std::string& statements) {
    const auto s = with_material(statements);
    return s.materials.empty() ? MaterialDescription{} : s.materials.back();
  }
};

TEST_F(ImportMtl, LibrariesOfOtherMachinesAreFound) {
  write("Red Paint.MTL", "newmtl red\nKd 0.75 0 0\n");
  for (const char* name : {"Red Paint.MTL", "red paint.mtl", "lib/Red Paint.mtl",
                           "C:\\work\\lib\\red paint.mtl", "/media/disk/Red Paint.mtl", "./Red Paint.mtl"}) {
    EXPECT_THAT(numbers(with_library(name).materials.at(0), "reflectance"), ElementsAre(0.75, 0, 0)) << name;
    EXPECT_THAT(said(), Not(HasSubstr("library"))) << name;
  }
}

TEST_F(ImportMtl, LibrariesInFoldersNameImagesBesideThem) {
  write("lib/red.mtl", "newmtl red\nmap_Kd red.ppm\n");
  write("lib/red.ppm", "P3 1 1 255 255 0 0\n");
  const auto s = with_library("lib/red.mtl");
  ASSERT_THAT(s.textures, SizeIs(1));
  EXPECT_EQ(s.textures[0].find("filename")->strings[0], "red.ppm");
  EXPECT_THAT(diagnostics_.files.name(s.textures[0].find("filename")->location.file),
              EndsWith("lib/red.mtl"));
  EXPECT_TRUE(load_scene(folder_ / "scene.obj", diagnostics_)) << said();
}

TEST_F(ImportMtl, LibrariesThatAreMissingGiveGrey) {
  EXPECT_THAT(numbers(with_library("none.mtl").materials.at(0), "reflectance"), ElementsAre(0.5, 0.5, 0.5));
  EXPECT_THAT(
      said(),
      HasSubstr(
          "scene.obj:1:8: warning: there is no material library \"none.mtl\"; its materials become grey"));
  write("scene.mtl", "newmtl red\nKd 0.75 0 0\n");
  EXPECT_THAT(numbers(with_library("none.mtl").materials.at(0), "reflectance"), ElementsAre(0.75, 0, 0));
  EXPECT_THAT(said(), HasSubstr("\"scene.mtl\" is read instead"));
  write("other.mtl", "newmtl blue\nKd 0 0 1\n");
  with_library("other.mtl");
  EXPECT_THAT(said(), HasSubstr("scene.obj:6:8: warning: no library has a material `red`: grey is used"));
}

TEST_F(ImportMtl, ImagesOfOtherMachinesAreFound) {
  write("textures/Wood.PPM", "P3 1 1 255 255 0 0\n");
  for (const char* name :
       {"C:\\models\\Textures\\wood.ppm", "textures/Wood.PPM",
        "-bm 0.5 -s 2 2 2 -mm 0 1 -blendu on D:/textures/wood.ppm", "textures\\wood.ppm -bm 1"}) {
    const auto s = with_material("map_Kd " + std::string(name) + "\n");
    ASSERT_THAT(s.textures, SizeIs(1)) << name << said();
    EXPECT_EQ(s.textures[0].find("filename")->strings[0], "textures/Wood.PPM");
  }
}

TEST_F(ImportMtl, MissingImagesGiveKdOrGrey) {
  EXPECT_THAT(numbers(material("Kd 0 0 0\nmap_Kd none.png\n"), "reflectance"), ElementsAre(0.5, 0.5, 0.5));
  EXPECT_THAT(said(), HasSubstr("scene.mtl:3:8: warning: there is no file \"none.png\""));
  EXPECT_THAT(numbers(material("Kd 1 1 1\nmap_Kd none.png\n"), "reflectance"), ElementsAre(0.5, 0.5, 0.5));
  EXPECT_THAT(numbers(material("Kd 0.75 0 0\nmap_Kd none.png\n"), "reflectance"), ElementsAre(0.75, 0, 0));
  EXPECT_THAT(numbers(material("Kd 0 0 0\n"), "reflectance"), ElementsAre(0, 0, 0));
}

TEST_F(ImportMtl, TransparencyIsRead) {
  EXPECT_THAT(numbers(with_material("Kd 1 0 0\nTr 0.25\n").shapes.at(0), "alpha"), ElementsAre(0.75));
  EXPECT_THAT(numbers(with_material("Kd 1 0 0\nd 0.75\nTr 0.75\n").shapes.at(0), "alpha"), ElementsAre(0.75));
  EXPECT_THAT(numbers(with_material("Kd 1 0 0\nTr 1\n").shapes.at(0), "alpha"), ElementsAre());
  EXPECT_EQ(material("Kd 1 0 0\nTr 1\n").type, "diffuse");
  EXPECT_EQ(material("Kd 1 0 0\nTr 0.9\nNi 1.4\n").type, "dielectric");
}

TEST_F(ImportMtl, IlluminationModelsAreRead) {
  for (const char* illum : {"4", "6", "7"}) {
    const auto m = material("Kd 0 0 0\nNi 1.4\nillum " + std::string(illum) + "\n");
    EXPECT_EQ(m.type, "dielectric") << illum;
    EXPECT_THAT(numbers(m, "eta"), ElementsAre(1.4));
  }
  EXPECT_EQ(material("Kd 0.5 0 0\nd 1\nillum 4\n").type, "diffuse")
      << "some programs write it for all materials";
  EXPECT_EQ(material("Kd 0 0 0\nKs 0.5 0.5 0.5\nillum 5\n").type, "conductor");
  EXPECT_EQ(material("Kd 0.5 0 0\nKs 0.5 0.5 0.5\nillum 5\n").type, "coateddiffuse");
  EXPECT_THAT(numbers(material("Ni 1\nillum 7\n"), "eta"), ElementsAre(1.5));
  EXPECT_THAT(said(), HasSubstr("glass of `Ni` 1 would not be seen"));
}

// Light crosses two surfaces of an object of glass.
TEST_F(ImportMtl, FiltersColourGlass) {
  const auto m = material("Ni 1.5\nTf 0.25 1 0.25\nillum 7\n");
  EXPECT_THAT(numbers(m, "transmittance"), ElementsAre(0.5, 1, 0.5));
  EXPECT_FALSE(material("Ni 1.5\nTf 0 0 0\nillum 7\n").find("transmittance"));
}

// A mirror over a diffuse surface reflects Kd + Ks.
TEST_F(ImportMtl, MirrorsOverDiffuseSurfacesAreMixtures) {
  const auto s = with_material("Kd 0.5 0.25 0\nKs 0.25 0.25 0.25\nillum 3\n");
  ASSERT_THAT(s.materials, SizeIs(3));
  EXPECT_EQ(s.materials[2].type, "mix");
  EXPECT_EQ(s.shapes.at(0).material.name, s.materials[2].name);
  const double share = numbers(s.materials[2], "amount").at(0);
  EXPECT_NEAR((1 - share) * numbers(s.materials[0], "reflectance").at(1), 0.25, 1e-15);
  EXPECT_NEAR(share * numbers(s.materials[1], "reflectance").at(1), 0.25, 1e-15);
  EXPECT_TRUE(load_scene(folder_ / "scene.obj", diagnostics_)) << said();
}

TEST_F(ImportMtl, ExtensionsForMetalAndRoughnessAreRead) {
  const auto gold = material("Kd 1 0.75 0.25\nKs 0.5 0.5 0.5\nPm 1\nPr 0.5\n");
  EXPECT_EQ(gold.type, "conductor");
  EXPECT_THAT(numbers(gold, "reflectance"), ElementsAre(1, 0.75, 0.25));
  EXPECT_THAT(numbers(gold, "roughness"), ElementsAre(0.25));
  write("rough.ppm", "P3 1 1 255 128 128 128\n");
  const auto s = with_material("Kd 0.5 0.5 0.5\nmap_Pr rough.ppm\n");
  EXPECT_EQ(s.materials.at(0).type, "coateddiffuse");
  ASSERT_THAT(s.textures, SizeIs(1));
  EXPECT_EQ(s.textures[0].value_type, "float");
  EXPECT_TRUE(load_scene(folder_ / "scene.obj", diagnostics_)) << said();
}

TEST_F(ImportMtl, MaterialsThatNoFaceUsesAreLeftOut) {
  write("scene.mtl", "newmtl m\nKd 0.5 0.5 0.5\nnewmtl light\nKe 60 55 45\n");
  const auto s = describe("mtllib scene.mtl\n" + std::string(kObjQuad) + "usemtl m\nf 1 2 3\n");
  EXPECT_THAT(s.materials, SizeIs(1));
  EXPECT_THAT(s.area_lights, SizeIs(0));
}

}  // namespace
}  // namespace kaustik::pbrt
