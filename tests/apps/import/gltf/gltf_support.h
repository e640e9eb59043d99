#pragma once
// Helpers that write glTF files.

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <cstring>

#include "tests/apps/import/import_support.h"

namespace kaustik::pbrt {

// A buffer that grows; its functions return the offset of the new bytes.
class Bytes {
 public:
  uint64_t floats(std::initializer_list<float> values) {
    const uint64_t at = bytes_.size();
    for (const float v : values) bytes_.append(reinterpret_cast<const char*>(&v), sizeof v);
    return at;
  }
  uint64_t shorts(std::initializer_list<uint16_t> values) {
    const uint64_t at = bytes_.size();
    for (const uint16_t v : values) bytes_.append(reinterpret_cast<const char*>(&v), sizeof v);
    while (bytes_.size() % 4 != 0) bytes_ += '\0';
    return at;
  }
  const std::string& text() const { return bytes_; }

 private:
  std::string bytes_;
};

// A triangle with indices, normals and uv in a buffer of 110 bytes.
inline const std::string& triangle_bytes() {
  static const std::string bytes = [] {
    Bytes b;
    b.floats({0, 0, 0, 1, 0, 0, 0, 1, 0});  // 0: positions
    b.floats({0, 0, 1, 0, 0, 1, 0, 0, 1});  // 36: normals
    b.floats({0, 0, 1, 0, 0, 0.25f});       // 72: uv
    b.shorts({0, 1, 2});                    // 96: indices, padded to 104
    return b.text();
  }();
  return bytes;
}

inline constexpr std::string_view kTriangleParts = R"(
  "bufferViews": [ { "buffer": 0, "byteOffset": 0, "byteLength": 36 },
                   { "buffer": 0, "byteOffset": 36, "byteLength": 36 },
                   { "buffer": 0, "byteOffset": 72, "byteLength": 24 },
                   { "buffer": 0, "byteOffset": 96, "byteLength": 6 } ],
  "accessors": [ { "bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3" },
                 { "bufferView": 1, "componentType": 5126, "count": 3, "type": "VEC3" },
                 { "bufferView": 2, "componentType": 5126, "count": 3, "type": "VEC2" },
                 { "bufferView": 3, "componentType": 5123, "count": 3, "type": "SCALAR" } ],
  "meshes": [ { "primitives": [ { "attributes": { "POSITION": 0, "NORMAL": 1, "TEXCOORD_0": 2 }, "indices": 3,
                                  "material": 0 } ] } ],)";

class ImportGltf : public ImportTest {
 protected:
  // Writes the JSON, with its buffer in a .bin file beside it.
  std::filesystem::path gltf(const std::string& parts, const std::string& bytes = triangle_bytes()) {
    write("buffer.bin", bytes);
    return write("scene.gltf",
                 fmt::format(R"({{ "asset": {{ "version": "2.0" }}, "buffers": [ {{ "uri": "buffer.bin", )"
                             R"("byteLength": {} }} ], {} }})",
                             bytes.size(), parts));
  }
  std::filesystem::path triangle(const std::string& material, const std::string& more = "") {
    return gltf(std::string(kTriangleParts) + R"("materials": [ )" + material +
                R"( ], "nodes": [ { "mesh": 0 } ])" + more);
  }
  SceneDescription describe(const std::filesystem::path& path) {
    diagnostics_ = Diagnostics();
    auto scene = import_scene(path, diagnostics_, kWithoutFloor);
    EXPECT_TRUE(scene && !diagnostics_.has_errors()) << diagnostics_.format_all();
    return scene ? std::move(*scene) : SceneDescription{};
  }
  std::string error(const std::filesystem::path& path) {
    diagnostics_ = Diagnostics();
    const auto scene = import_scene(path, diagnostics_, kWithoutFloor);
    EXPECT_FALSE(scene);
    EXPECT_EQ(diagnostics_.error_count(), 1u);
    return diagnostics_.format_all();
  }
};

inline std::vector<double> numbers(const Directive& d, std::string_view name) {
  const Parameter* p = d.find(name);
  return p ? p->numbers : std::vector<double>{};
}

inline std::string glb(std::string json, std::string binary) {
  while (json.size() % 4 != 0) json += ' ';
  const auto word = [](size_t v) {
    const auto n = static_cast<uint32_t>(v);
    return std::string(reinterpret_cast<const char*>(&n), sizeof n);
  };
  return "glTF" + word(2) + word(12 + 8 + json.size() + 8 + binary.size()) + word(json.size()) + "JSON" +
         json + word(binary.size()) + std::string("BIN\0", 4) + binary;
}

}  // namespace kaustik::pbrt
