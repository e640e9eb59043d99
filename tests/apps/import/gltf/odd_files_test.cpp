// Tests files that are unusual but right, and files whose faults do not keep a picture from being right.

#include <limits>

#include "tests/apps/import/gltf/triangle_with.h"

namespace kaustik::pbrt {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

using GltfOddFiles = GltfTriangleWith;

std::string with(std::string text, const std::string& from, const std::string& to) {
  const size_t at = text.find(from);
  EXPECT_NE(at, text.npos) << from;
  return at == text.npos ? text : text.replace(at, from.size(), to);
}

TEST_F(GltfOddFiles, PointsAndLinesAreCounted) {
  const std::string primitive = R"({ "attributes": { "POSITION": 0 }, "mode": )";
  const auto s = describe(gltf(with(std::string(kTriangleParts), R"("primitives": [ )",
                                    R"("primitives": [ )" + primitive + "0 }, " + primitive + "3 }, ") +
                               R"("materials": [ {} ], "nodes": [ { "mesh": 0 } ])"));
  EXPECT_EQ(s.shapes.size(), 1u);
  EXPECT_THAT(diagnostics_.format_all(), HasSubstr("only triangles are rendered (2 primitives)"));
}

TEST_F(GltfOddFiles, TheSceneThatTheFileNamesIsShown) {
  const std::string parts = std::string(kTriangleParts) + R"("materials": [ {} ],
      "nodes": [ { "mesh": 0 }, { "mesh": 0, "translation": [ 5, 0, 0 ] } ],
      "scenes": [ { "nodes": [ 0 ] }, { "nodes": [ 1 ] } ])";
  EXPECT_EQ(describe(gltf(parts)).shapes.at(0).object_to_world[3].x, 0);  // the first where none is named
  EXPECT_EQ(describe(gltf(parts + R"(, "scene": 1)")).shapes.at(0).object_to_world[3].x, 5);
}

TEST_F(GltfOddFiles, BuffersMayBeDataOrHaveEscapedNames) {
  Bytes b;
  b.floats({0, 0, 0, 1, 0, 0, 0, 1, 0});
  const std::string rest =
      R"("accessors": [ { "bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3" } ],
      "bufferViews": [ { "buffer": 0, "byteLength": 36 } ],
      "meshes": [ { "primitives": [ { "attributes": { "POSITION": 0 } } ] } ], "nodes": [ { "mesh": 0 } ] })";
  write("my buffer.bin", b.text());
  // Base64 of the same bytes: 1 is 00 00 80 3f.
  const std::string data =
      "data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA";
  for (const std::string& uri : {std::string("my%20buffer.bin"), data}) {
    const auto path =
        write("scene.gltf", R"({ "asset": { "version": "2.0" }, "buffers": [ { "byteLength": 36, "uri": ")" +
                                uri + "\" } ], " + rest);
    EXPECT_THAT(numbers(describe(path).shapes.at(0), "P"), ElementsAre(0, 0, 0, 1, 0, 0, 0, 1, 0)) << uri;
  }
}

// A quaternion of length 2 turns as that of length 1; one of length 0 does not turn.
TEST_F(GltfOddFiles, QuaternionsMayHaveAnyLength) {
  const std::string parts =
      std::string(kTriangleParts) + R"("materials": [ {} ], "nodes": [ { "mesh": 0, "rotation": )";
  const auto turned = describe(gltf(parts + "[ 0, 0, 1.4142135623730951, 1.4142135623730951 ] } ]"));
  EXPECT_NEAR(turned.shapes.at(0).object_to_world[0].y, 1, 1e-12);
  EXPECT_NEAR(turned.shapes.at(0).object_to_world[0].x, 0, 1e-12);
  EXPECT_EQ(describe(gltf(parts + "[ 0, 0, 0, 0 ] } ]")).shapes.at(0).object_to_world, glm::dmat4(1));
  EXPECT_THAT(diagnostics_.format_all(), HasSubstr("quaternion of zeros"));
}

// Under a mirroring transform the front stays where the normals point.
TEST_F(GltfOddFiles, MirroringMatricesKeepTheFront) {
  const std::string nodes = R"("materials": [ {} ], "nodes": [ { "mesh": 0,
      "matrix": [ -1,0,0,0, 0,1,0,0, 0,0,1,0, 0,0,0,1 ] } ])";
  for (const bool normals : {true, false}) {
    std::string parts(kTriangleParts);
    if (!normals) parts = with(parts, R"("NORMAL": 1, )", "");
    const auto loaded = load_scene(gltf(parts + nodes), diagnostics_);
    ASSERT_TRUE(loaded) << diagnostics_.format_all();
    EXPECT_EQ(make_interaction(loaded->scene.shapes, {}, {1, 0, 0, {0.25f, 0.25f}}).n, Normal3(0, 0, 1));
  }
}

TEST_F(GltfOddFiles, NormalsThatAreNotNumbersAreNotUsed) {
  Bytes b;
  const float nan = std::numeric_limits<float>::quiet_NaN();
  b.floats({nan, nan, nan, nan, nan, nan, nan, nan, nan});
  const auto path = triangle_with(R"("TANGENT": 1)",
                                  R"({ "bufferView": 4, "componentType": 5126, "count": 3, "type": "VEC3" })",
                                  R"("nodes": [ { "mesh": 0 } ])", b.text());
  std::ifstream in(path);
  const std::string text(std::istreambuf_iterator<char>(in), {});
  const auto loaded =
      load_scene(write("nan.gltf", with(text, R"("NORMAL": 1)", R"("NORMAL": 4)")), diagnostics_);
  ASSERT_TRUE(loaded) << diagnostics_.format_all();
  EXPECT_EQ(make_interaction(loaded->scene.shapes, {}, {1, 0, 0, {0.25f, 0.25f}}).ns, Normal3(0, 0, 1));
  EXPECT_THAT(diagnostics_.format_all(), HasSubstr("NORMAL that are not finite"));
}

// Three corners of a fourth triangle's two are left out.
TEST_F(GltfOddFiles, IncompleteTrianglesAreLeftOut) {
  Bytes b;
  b.shorts({0, 1, 2, 0, 1});
  const auto path =
      triangle_with("", R"({ "bufferView": 4, "componentType": 5123, "count": 5, "type": "SCALAR" })",
                    R"("nodes": [ { "mesh": 0 } ])", b.text());
  std::ifstream in(path);
  const std::string text(std::istreambuf_iterator<char>(in), {});
  const auto s = describe(write("five.gltf", with(text, R"("indices": 3)", R"("indices": 4)")));
  EXPECT_THAT(numbers(s.shapes.at(0), "indices"), ElementsAre(0, 1, 2));
}

// Extensions without which geometry would be missing are errors; others are warnings.
TEST_F(GltfOddFiles, RequiredExtensionsAreErrorsOnlyForGeometry) {
  const auto file = [&](const std::string& name) {
    return triangle("{}", R"(, "extensionsRequired": [ ")" + name + "\" ]");
  };
  describe(file("VENDOR_materials_glitter"));
  EXPECT_THAT(diagnostics_.format_all(), HasSubstr("VENDOR_materials_glitter, which is ignored"));
  describe(file("KHR_materials_variants"));
  EXPECT_THAT(diagnostics_.format_all(), Not(HasSubstr("requires")));
  EXPECT_THAT(error(file("VENDOR_point_packing")), HasSubstr("VENDOR_point_packing, which is not supported"));
}

TEST_F(GltfOddFiles, WarningsOfMaterialsAreCounted) {
  const std::string sheen =
      R"({ "extensions": { "KHR_materials_sheen": { "sheenColorFactor": [ 1, 0, 0 ] } } })";
  std::string parts(kTriangleParts);
  const std::string primitive =
      parts.substr(parts.find(R"({ "attributes")"),
                   parts.find(" ] } ],", parts.find(R"({ "attributes")")) - parts.find(R"({ "attributes")"));
  parts = with(parts, primitive, primitive + ", " + with(primitive, R"("material": 0)", R"("material": 1)"));
  describe(gltf(parts + R"("materials": [ )" + sheen + ", " + sheen + R"( ], "nodes": [ { "mesh": 0 } ])"));
  EXPECT_THAT(
      diagnostics_.format_all(),
      HasSubstr("KHR_materials_sheen is left out: cloth lacks its soft edges of light (2 materials)"));
  describe(triangle(R"({ "extensions": { "KHR_materials_sheen": { "sheenColorFactor": [ 0, 0, 0 ] } } })"));
  EXPECT_THAT(diagnostics_.format_all(), Not(HasSubstr("sheen")));
}

// F0 of index 1.5 is 0.04; a factor of 1/4 leaves 0.01, which is that of index 1.1 / 0.9.
TEST_F(GltfOddFiles, SpecularScalesReflection) {
  const auto s = describe(triangle(R"({ "pbrMetallicRoughness": { "metallicFactor": 0 }, "extensions":
      { "KHR_materials_specular": { "specularFactor": 0.5, "specularColorFactor": [ 0.5, 0.5, 0.5 ] } } })"));
  EXPECT_NEAR(numbers(s.materials.at(0), "eta").at(0), 1.1 / 0.9, 1e-12);
}

}  // namespace
}  // namespace kaustik::pbrt
