// Tests the colours of vertices: from COLOR_0 of a glTF file to the surface's albedo at a point.

#include "core/scene/bsdf_at.h"
#include "tests/apps/import/gltf/triangle_with.h"

namespace kaustik::pbrt {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

class GltfVertexColours : public GltfTriangleWith {
 protected:
  // The triangle with colours as floats, three or four a vertex.
  std::filesystem::path coloured(std::initializer_list<float> colours, const std::string& material = "{}") {
    Bytes bytes;
    bytes.floats(colours);
    return triangle_with(
        R"("COLOR_0": 4)",
        fmt::format(R"({{ "bufferView": 4, "componentType": 5126, "count": 3, "type": "VEC{}" }})",
                    colours.size() / 3),
        R"("nodes": [ { "mesh": 0 } ])", bytes.text(), material);
  }
  // The albedo at the point with barycentrics (1 - b1 - b2, b1, b2).
  static glm::dvec3 albedo_at(const Scene& scene, float b1, float b2) {
    SurfaceInteraction si = make_interaction(scene.shapes, {}, {1, 0, 0, {b1, b2}});
    return albedo(*BsdfAt(scene, si, si.n));
  }
};

constexpr const char* kRough = R"({ "pbrMetallicRoughness": { "metallicFactor": 0,
    "baseColorFactor": [ 0.5, 1, 1, 1 ] }, "extensions": { "KHR_materials_specular": { "specularFactor": 0 } } })";

// The reflectance is factor times colour; float roundings of three products and sums.
TEST_F(GltfVertexColours, AreInterpolated) {
  const auto loaded = load_scene(coloured({1, 0, 0, 0, 1, 0, 0, 0, 1}, kRough), diagnostics_);
  ASSERT_TRUE(loaded) << diagnostics_.format_all();
  const glm::dvec3 corner = albedo_at(loaded->scene, 0, 0), inner = albedo_at(loaded->scene, 0.25f, 0.5f);
  const glm::dvec3 expected(0.5 * 0.25, 0.25, 0.5);
  for (int c = 0; c < 3; ++c) {
    EXPECT_NEAR(corner[c], c == 0 ? 0.5 : 0, 1e-6);
    EXPECT_NEAR(inner[c], expected[c], 1e-6);
  }
}

// An equal colour is a factor of the material, which then does not vary.
TEST_F(GltfVertexColours, OfOneColourMultiplyTheFactor) {
  const auto s = describe(coloured({0.5f, 0.25f, 1, 0.5f, 0.25f, 1, 0.5f, 0.25f, 1}, kRough));
  EXPECT_THAT(numbers(s.materials.at(0), "reflectance"), ElementsAre(0.25, 0.25, 1));
  EXPECT_TRUE(s.textures.empty());
  EXPECT_FALSE(s.shapes.at(0).find("Cd"));
}

TEST_F(GltfVertexColours, AlphaCountsWhereTheMaterialBlends) {
  const auto path = coloured({1, 1, 1, 0, 1, 1, 1, 0.5f, 1, 1, 1, 1}, R"({ "alphaMode": "BLEND" })");
  const auto s = describe(path);
  const Parameter* alpha = s.shapes.at(0).find("alpha");
  ASSERT_TRUE(alpha && alpha->type == ParameterType::kTexture);
  const auto texture =
      std::ranges::find_if(s.textures, [&](const auto& t) { return t.name == alpha->strings[0]; });
  ASSERT_NE(texture, s.textures.end());
  EXPECT_EQ(texture->type, "vertexcolor");
  EXPECT_EQ(texture->value_type, "float");
  const auto loaded = load_scene(path, diagnostics_);
  const Shape& shape = loaded->scene.shapes.at(0);
  const SurfaceInteraction si = make_interaction(loaded->scene.shapes, {}, {1, 0, 0, {0.5f, 0.25f}});
  EXPECT_EQ(loaded->scene.textures->evaluate_float(shape.alpha_texture, texture_point(loaded->scene, si)),
            0.5f);
}

TEST_F(GltfVertexColours, CanBeNormalisedBytes) {
  Bytes bytes;
  bytes.shorts(
      {0x00ff, 0xff00, 0xff00, 0xff00, 0x3300, 0xff00});  // bytes 255 0 0 255, 0 255 0 255, 0 51 0 255
  const auto s = describe(triangle_with(
      R"("COLOR_0": 4)",
      R"({ "bufferView": 4, "componentType": 5121, "normalized": true, "count": 3, "type": "VEC4" })",
      R"("nodes": [ { "mesh": 0 } ])", bytes.text()));
  EXPECT_THAT(numbers(s.shapes.at(0), "Cd"), ElementsAre(1, 0, 0, 1, 0, 1, 0, 1, 0, 0.2, 0, 1));
}

// The surface emits what it would reflect, so that it looks as authored.
TEST_F(GltfVertexColours, UnlitSurfacesEmitTheirBaseColour) {
  const auto s = describe(triangle(R"({ "pbrMetallicRoughness": { "baseColorFactor": [ 0.5, 0.25, 1, 1 ] },
      "doubleSided": true, "extensions": { "KHR_materials_unlit": {} } })"));
  ASSERT_EQ(s.area_lights.size(), 1u);
  EXPECT_THAT(numbers(s.area_lights[0], "L"), ElementsAre(0.5, 0.25, 1));
  EXPECT_THAT(numbers(s.area_lights[0], "twosided"), ElementsAre(1));
  EXPECT_THAT(numbers(s.materials.at(0), "reflectance"), ElementsAre(0, 0, 0));
  describe(coloured({1, 0, 0, 0, 1, 0, 0, 0, 1}, R"({ "extensions": { "KHR_materials_unlit": {} } })"));
  EXPECT_THAT(diagnostics_.format_all(), HasSubstr("rendered as a diffuse surface (1 material)"));
}

}  // namespace
}  // namespace kaustik::pbrt
