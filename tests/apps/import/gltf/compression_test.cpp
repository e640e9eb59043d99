// Tests compressed meshes, which the tests encode by the libraries' own encoders.

#include <draco/compression/expert_encode.h>
#include <draco/mesh/triangle_soup_mesh_builder.h>
#include <meshoptimizer.h>

#include <array>

#include "tests/apps/import/gltf/gltf_support.h"

namespace kaustik::pbrt {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

// A square of two triangles.
const std::array<float, 12> kSquare = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0};
const std::array<uint32_t, 6> kCorners = {0, 1, 2, 0, 2, 3};

std::string padded(std::string bytes) {
  while (bytes.size() % 4 != 0) bytes += '\0';
  return bytes;
}

class GltfCompression : public ImportGltf {
 protected:
  std::filesystem::path meshopt(const std::string& vertices, const std::string& indices) {
    const std::string parts = fmt::format(
        R"("extensionsRequired": [ "EXT_meshopt_compression" ],
        "bufferViews": [ {{ "buffer": 1, "byteLength": 48, "byteStride": 12, "extensions": {{
            "EXT_meshopt_compression": {{ "buffer": 0, "byteOffset": 0, "byteLength": {0}, "byteStride": 12,
              "count": 4, "mode": "ATTRIBUTES" }} }} }},
          {{ "buffer": 1, "byteLength": 24, "extensions": {{ "EXT_meshopt_compression": {{ "buffer": 0,
              "byteOffset": {1}, "byteLength": {2}, "byteStride": 4, "count": 6, "mode": "TRIANGLES" }} }} }} ],
        "accessors": [ {{ "bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3" }},
                       {{ "bufferView": 1, "componentType": 5125, "count": 6, "type": "SCALAR" }} ],
        "meshes": [ {{ "primitives": [ {{ "attributes": {{ "POSITION": 0 }}, "indices": 1 }} ] }} ],
        "nodes": [ {{ "mesh": 0 }} ])",
        vertices.size(), padded(vertices).size(), indices.size());
    const std::string bytes = padded(vertices) + indices;
    write("buffer.bin", bytes);
    return write("scene.gltf", fmt::format(R"({{ "asset": {{ "version": "2.0" }}, "buffers": [
        {{ "uri": "buffer.bin", "byteLength": {} }}, {{ "byteLength": 72, "extensions": {{
          "EXT_meshopt_compression": {{ "fallback": true }} }} }} ], {} }})",
                                           bytes.size(), parts));
  }
};

std::string packed_vertices() {
  std::string out(meshopt_encodeVertexBufferBound(4, 12), '\0');
  meshopt_encodeVertexVersion(0);  // the version of EXT_meshopt_compression
  out.resize(meshopt_encodeVertexBuffer(reinterpret_cast<unsigned char*>(out.data()), out.size(),
                                        kSquare.data(), 4, 12));
  return out;
}
std::string packed_indices() {
  std::string out(meshopt_encodeIndexBufferBound(6, 4), '\0');
  out.resize(meshopt_encodeIndexBuffer(reinterpret_cast<unsigned char*>(out.data()), out.size(),
                                       kCorners.data(), 6));
  return out;
}

// The encoder may begin a triangle at another corner.
TEST_F(GltfCompression, MeshoptIsDecoded) {
  const auto s = describe(meshopt(packed_vertices(), packed_indices()));
  EXPECT_EQ(numbers(s.shapes.at(0), "P"), std::vector<double>(kSquare.begin(), kSquare.end()));
  const std::vector<double> indices = numbers(s.shapes[0], "indices");
  EXPECT_THAT(std::vector<double>(indices.begin(), indices.begin() + 3),
              testing::UnorderedElementsAre(0, 1, 2));
  EXPECT_THAT(std::vector<double>(indices.begin() + 3, indices.end()),
              testing::UnorderedElementsAre(0, 2, 3));
}

TEST_F(GltfCompression, DamagedMeshoptIsRefusedAndNamesATool) {
  EXPECT_THAT(error(meshopt(packed_vertices().substr(0, 9), packed_indices())), HasSubstr("gltf-transform"));
}

// Two triangles with the positions P, which have the type.
template <class T>
std::string draco_bytes(const T& P, draco::DataType type) {
  draco::TriangleSoupMeshBuilder builder;
  builder.Start(2);
  const int position = builder.AddAttribute(draco::GeometryAttribute::POSITION, 3, type);
  for (uint32_t f = 0; f < 2; ++f)
    builder.SetAttributeValuesForFace(position, draco::FaceIndex(f), &P[3 * kCorners[3 * f]],
                                      &P[3 * kCorners[3 * f + 1]], &P[3 * kCorners[3 * f + 2]]);
  const auto mesh = builder.Finalize();
  draco::ExpertEncoder encoder(*mesh);
  draco::EncoderBuffer buffer;
  EXPECT_TRUE(encoder.EncodeToBuffer(&buffer).ok());
  return {buffer.data(), buffer.size()};
}

std::string draco_parts(size_t size) {
  return fmt::format(R"("extensionsRequired": [ "KHR_draco_mesh_compression" ],
      "bufferViews": [ {{ "buffer": 0, "byteLength": {} }} ],
      "accessors": [ {{ "componentType": 5126, "count": 4, "type": "VEC3" }},
                     {{ "componentType": 5125, "count": 6, "type": "SCALAR" }} ],
      "meshes": [ {{ "primitives": [ {{ "attributes": {{ "POSITION": 0 }}, "indices": 1, "extensions": {{
        "KHR_draco_mesh_compression": {{ "bufferView": 0, "attributes": {{ "POSITION": 0 }} }} }} }} ] }} ],
      "nodes": [ {{ "mesh": 0 }} ])",
                     size);
}

// Draco changes the order of vertices, so that the corners' positions are compared.
TEST_F(GltfCompression, DracoIsDecoded) {
  const std::string bytes = draco_bytes(kSquare, draco::DT_FLOAT32);
  const auto s = describe(gltf(draco_parts(bytes.size()), bytes));
  const std::vector<double> P = numbers(s.shapes.at(0), "P"), indices = numbers(s.shapes[0], "indices");
  EXPECT_EQ(P.size(), 12u);
  ASSERT_EQ(indices.size(), 6u);
  double area = 0;  // of both triangles, which wind counter-clockwise
  for (size_t i = 0; i < 6; i += 3) {
    const auto at = [&](size_t k) {
      const auto v = static_cast<size_t>(indices[i + k]);
      return glm::dvec3(P[3 * v], P[3 * v + 1], P[3 * v + 2]);
    };
    area += 0.5 * glm::cross(at(1) - at(0), at(2) - at(0)).z;
  }
  EXPECT_NEAR(area, 1, 1e-6);
}

TEST_F(GltfCompression, DamagedDracoIsRefusedAndNamesATool) {
  const std::string bytes = draco_bytes(kSquare, draco::DT_FLOAT32).substr(0, 20);
  EXPECT_THAT(error(gltf(draco_parts(bytes.size()), bytes)), HasSubstr("gltf-transform"));
}

// Draco would read other bytes than 0 and 1 as a bool, too.
TEST_F(GltfCompression, DracoOfTruthValuesIsRefused) {
  constexpr std::array<uint8_t, 12> kTruths = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0};
  const std::string bytes = draco_bytes(kTruths, draco::DT_BOOL);
  EXPECT_THAT(error(gltf(draco_parts(bytes.size()), bytes)), HasSubstr("POSITION` has truth values"));
}

}  // namespace
}  // namespace kaustik::pbrt
