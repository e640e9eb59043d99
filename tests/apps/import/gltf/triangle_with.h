#pragma once
// The triangle of gltf_support.h with more attributes.

#include "tests/apps/import/gltf/gltf_support.h"

namespace kaustik::pbrt {

class GltfTriangleWith : public ImportGltf {
 protected:
  // The bytes of the attributes follow those of triangle_bytes() as buffer view 4; their accessors begin
  // at 4.
  std::filesystem::path triangle_with(const std::string& attributes, const std::string& accessors,
                                      const std::string& more, const std::string& bytes,
                                      const std::string& material = "{}") {
    std::string parts(kTriangleParts);
    const auto replace = [&](const std::string& from, const std::string& to) {
      const size_t at = parts.find(from);
      ASSERT_NE(at, parts.npos) << from;
      parts.replace(at, from.size(), to);
    };
    if (!attributes.empty()) replace(R"("TEXCOORD_0": 2 })", R"("TEXCOORD_0": 2, )" + attributes + " }");
    replace(R"("type": "SCALAR" } ])", R"("type": "SCALAR" }, )" + accessors + " ]");
    replace(R"("byteLength": 6 } ])",
            R"("byteLength": 6 }, { "buffer": 0, "byteOffset": 104, "byteLength": )" +
                std::to_string(bytes.size()) + " } ]");
    return gltf(parts + R"("materials": [ )" + material + " ], " + more, triangle_bytes() + bytes);
  }
};

}  // namespace kaustik::pbrt
