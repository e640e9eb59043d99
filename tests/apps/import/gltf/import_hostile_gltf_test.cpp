// Tests damaged and hostile glTF files.

#include <random>

#include "tests/apps/import/gltf/gltf_support.h"

namespace kaustik::pbrt {
namespace {

using testing::HasSubstr;

struct Damage {
  std::string_view parts, message;
};
class DamagedGltf : public ImportGltf, public testing::WithParamInterface<Damage> {};

TEST_P(DamagedGltf, MessageMatches) {
  EXPECT_THAT(error(gltf(std::string(GetParam().parts))), HasSubstr(std::string(GetParam().message)));
}

INSTANTIATE_TEST_SUITE_P(
    Files, DamagedGltf,
    testing::Values(
        Damage{
            R"("accessors": [ { "bufferView": 0, "componentType": 5126, "count": 1000000000000, "type": "VEC3" } ],
          "bufferViews": [ { "buffer": 0, "byteLength": 36 } ],
          "meshes": [ { "primitives": [ { "attributes": { "POSITION": 0 } } ] } ], "nodes": [ { "mesh": 0 } ])",
            "meshes[0].primitives[0]` makes the scene larger than 4294967296 numbers"},
        Damage{R"("accessors": [ { "bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3" } ],
          "bufferViews": [ { "buffer": 0, "byteLength": 36 } ],
          "meshes": [ { "primitives": [ { "attributes": { "POSITION": 0 } } ] } ], "nodes": [ { "mesh": 0 } ])",
               "accessors[0]` reaches beyond its bytes: 4 elements of 12 bytes from 0, of 36"},
        Damage{R"("accessors": [ { "componentType": 5126, "count": 1000000000000, "type": "VEC3" } ],
          "meshes": [ { "primitives": [ { "attributes": { "POSITION": 0 } } ] } ], "nodes": [ { "mesh": 0 } ])",
               "`"},
        Damage{R"("accessors": [ { "bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3" } ],
          "bufferViews": [ { "buffer": 0, "byteOffset": 100, "byteLength": 36 } ],
          "meshes": [ { "primitives": [ { "attributes": { "POSITION": 0 } } ] } ], "nodes": [ { "mesh": 0 } ])",
               "bufferViews[0]` reaches beyond its buffer: 36 bytes from 100, of 104"},
        Damage{R"("accessors": [ { "bufferView": 7, "componentType": 5126, "count": 3, "type": "VEC3" } ],
          "meshes": [ { "primitives": [ { "attributes": { "POSITION": 0 } } ] } ], "nodes": [ { "mesh": 0 } ])",
               "accessors[0].bufferView` is 7: there are 0"},
        Damage{R"("accessors": [ { "bufferView": 0, "componentType": 5126, "count": -3, "type": "VEC3" } ],
          "bufferViews": [ { "buffer": 0, "byteLength": 36 } ],
          "meshes": [ { "primitives": [ { "attributes": { "POSITION": 0 } } ] } ], "nodes": [ { "mesh": 0 } ])",
               "accessors[0].count` must be a non-negative integer, not -3"},
        Damage{
            R"("nodes": [ { "children": [ 1 ] }, { "children": [ 0 ] } ], "scenes": [ { "nodes": [ 0 ] } ])",
            "nodes[0]` has two parents or is its own ancestor"},
        Damage{R"("nodes": [ { "children": [ 0 ] } ], "scenes": [ { "nodes": [ 0 ] } ])",
               "nodes[0]` has two parents or is its own ancestor"},
        Damage{R"("nodes": [ { "children": [ 5 ] } ])", "nodes[0].children[0]` is 5: there are 1"},
        Damage{R"("nodes": [ { "mesh": 2 } ])", "nodes[0].mesh` is 2: there are 0"},
        Damage{R"("nodes": { "mesh": 2 })", "`nodes` must be a list"},
        Damage{R"("nodes": [ 3 ])", "`nodes[0]` must be an object"},
        Damage{R"("nodes": [ { "translation": [ 1, 2 ] } ])",
               "nodes[0].translation` must be 3 numbers, not 2"},
        Damage{R"("nodes": [ { "translation": [ 1, 2, "x" ] } ])",
               "nodes[0].translation[2]` must be a number"},
        Damage{R"("extensionsRequired": [ "VENDOR_mesh_packing" ])",
               "it requires the extension VENDOR_mesh_packing, which is not supported"},
        Damage{
            R"("cameras": [ { "type": "perspective", "perspective": { "yfov": 4 } } ], "nodes": [ { "camera": 0 } ])",
            "cameras[0].perspective.yfov` is 4"}));

TEST_F(ImportGltf, IndicesOutOfRangeAreRefused) {
  Bytes b;
  b.floats({0, 0, 0, 1, 0, 0, 0, 1, 0});
  b.shorts({0, 1, 9});
  EXPECT_THAT(error(gltf(R"("bufferViews": [ { "buffer": 0, "byteLength": 36 },
      { "buffer": 0, "byteOffset": 36, "byteLength": 6 } ],
      "accessors": [ { "bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3" },
                     { "bufferView": 1, "componentType": 5123, "count": 3, "type": "SCALAR" } ],
      "meshes": [ { "primitives": [ { "attributes": { "POSITION": 0 }, "indices": 1 } ] } ], "nodes": [ { "mesh": 0 } ])",
                         b.text())),
              HasSubstr("meshes[0].primitives[0].indices` names vertex 9, but there are 3"));
}

TEST_F(ImportGltf, DamagedContainersAreRefused) {
  const std::string json = R"({ "asset": { "version": "2.0" } })";
  std::string file = glb(json, "");
  EXPECT_THAT(error(write("a.glb", file.substr(0, 15))), HasSubstr("the file ends within its header"));
  EXPECT_THAT(error(write("a.glb", file.substr(0, file.size() - 12))), HasSubstr("the header promises"));
  file[12] = '\x7f';
  file[15] = '\x7f';
  EXPECT_THAT(error(write("a.glb", file)), HasSubstr("chunk 0 promises"));
  EXPECT_THAT(error(write("a.gltf", "{ \"asset\": ")), HasSubstr("its JSON cannot be read"));
  EXPECT_THAT(error(write("a.gltf", std::string(100000, '['))), HasSubstr("its JSON cannot be read"));
  EXPECT_THAT(error(write("a.gltf", "{ \"asset\": 1e400 }")), HasSubstr("beyond the range of doubles"));
  EXPECT_THAT(error(write("a.gltf", "{}")), HasSubstr("it is not glTF 2.0"));
  std::string empty = glb(json, "");
  empty.replace(8, 4, std::string("\x0c\0\0\0", 4));  // the length of a file that ends behind its header
  EXPECT_THAT(error(write("a.glb", empty)), HasSubstr("the JSON is missing"));
  EXPECT_THAT(error(folder_ / "none.glb"), HasSubstr("no such file"));
  EXPECT_THAT(
      error(write(
          "a.gltf",
          R"({ "asset": { "version": "2.0" }, "buffers": [ { "uri": "none.bin", "byteLength": 4 } ] })")),
      HasSubstr("no such file"));
  EXPECT_THAT(error(write("a.gltf", R"({ "asset": { "version": "2.0" }, "buffers": [
                  { "uri": "data:application/octet-stream;base64,AAAA", "byteLength": 4 } ] })")),
              HasSubstr("has 3 bytes, `byteLength` promises 4"));
}

// 100,000 nested nodes must not exhaust the stack.
TEST_F(ImportGltf, DeepHierarchiesDoNotExhaustTheStack) {
  std::string nodes = "\"nodes\": [ ";
  constexpr int kNodes = 100'000;
  for (int i = 0; i + 1 < kNodes; ++i) nodes += fmt::format("{{ \"children\": [ {} ] }}, ", i + 1);
  describe(gltf(nodes + "{} ], \"scenes\": [ { \"nodes\": [ 0 ] } ]"));
}

// Whatever bytes, digits or cuts are changed, the file is read or refused.
TEST_F(ImportGltf, ChangedFilesAreReadOrRefused) {
  const std::string json =
      std::string(R"({ "asset": { "version": "2.0" }, "buffers": [ { "byteLength": 104 } ],)") +
      std::string(kTriangleParts) +
      R"("materials": [ { "emissiveFactor": [ 1, 1, 1 ] } ], "nodes": [ { "children": [ 1 ] }, { "mesh": 0 } ] })";
  const std::string file = glb(json, triangle_bytes());
  std::mt19937 random(7);
  const auto below = [&](size_t n) { return random() % n; };
  for (int trial = 0; trial < 400; ++trial) {
    std::string changed = file;
    for (size_t changes = 1 + below(3); changes > 0; --changes) {
      char& c = changed[below(changed.size())];
      const bool digit = c >= '0' && c <= '9';
      c = static_cast<char>(digit ? '0' + below(10) : below(256));
    }
    if (below(8) == 0) changed.resize(below(changed.size()));
    Diagnostics diagnostics;
    const auto loaded = load_scene(write("changed.glb", changed), diagnostics);
    EXPECT_EQ(loaded.has_value(), !diagnostics.has_errors()) << trial;
  }
}

}  // namespace
}  // namespace kaustik::pbrt
