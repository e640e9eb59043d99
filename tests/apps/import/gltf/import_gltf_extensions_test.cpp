// Tests extensions of glTF's materials and nodes, skins and morph targets.

#include "tests/apps/import/gltf/triangle_with.h"

namespace kaustik::pbrt {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

std::vector<double> numbers(const Directive& d, std::string_view name) {
  const Parameter* p = d.find(name);
  return p ? p->numbers : std::vector<double>{};
}

class ImportGltfExtensions : public GltfTriangleWith {
 protected:
  MaterialDescription material(const std::string& extensions, const std::string& factors = "") {
    return describe(triangle(R"({ "pbrMetallicRoughness": { "roughnessFactor": 0.5)" + factors +
                             R"( }, "extensions": { )" + extensions + " } }"))
        .materials.at(0);
  }
};

// Metal with wider facets along u: alpha_t = alpha + (1 - alpha) strength^2 (KHR_materials_anisotropy).
TEST_F(ImportGltfExtensions, AnisotropyWidensFacetsAlongU) {
  const auto along_u = material(R"("KHR_materials_anisotropy": { "anisotropyStrength": 0.5 })");
  EXPECT_THAT(numbers(along_u, "uroughness"), ElementsAre(0.25 + 0.75 * 0.25));
  EXPECT_THAT(numbers(along_u, "vroughness"), ElementsAre(0.25));
  const auto along_v = material(
      R"("KHR_materials_anisotropy": { "anisotropyStrength": 0.5, "anisotropyRotation": 1.5707963 })");
  EXPECT_THAT(numbers(along_v, "vroughness"), ElementsAre(0.25 + 0.75 * 0.25));
  EXPECT_THAT(diagnostics_.format_all(), testing::Not(HasSubstr("anisotropy")));
}

// The extension counts 20 over the Abbe number; panes do not disperse.
TEST_F(ImportGltfExtensions, DispersionOfBodiesIsAnAbbeNumber) {
  const std::string glass = R"("KHR_materials_transmission": { "transmissionFactor": 1 },
      "KHR_materials_dispersion": { "dispersion": 0.5 })";
  const auto body = material(glass + R"(, "KHR_materials_volume": { "thicknessFactor": 1 })");
  EXPECT_EQ(body.type, "dielectric");
  EXPECT_THAT(numbers(body, "abbe"), ElementsAre(40));
  EXPECT_FALSE(material(glass).find("abbe"));
  const auto more = material(R"("KHR_materials_transmission": { "transmissionFactor": 1 },
      "KHR_materials_volume": { "thicknessFactor": 1 }, "KHR_materials_dispersion": { "dispersion": 1e30 })");
  EXPECT_THAT(numbers(more, "abbe"), ElementsAre(1));
}

TEST_F(ImportGltfExtensions, ClearcoatBecomesACoat) {
  const auto paint =
      material(R"("KHR_materials_clearcoat": { "clearcoatFactor": 1, "clearcoatRoughnessFactor": 0.25 })",
               R"(, "metallicFactor": 0)");
  EXPECT_EQ(paint.type, "coateddiffuse");
  EXPECT_THAT(numbers(paint, "roughness"), ElementsAre(0.0625));
}

TEST_F(ImportGltfExtensions, SpecularGlossinessIsConverted) {
  const auto paint = material(R"("KHR_materials_pbrSpecularGlossiness": {
      "diffuseFactor": [ 0.5, 0.25, 0.125, 1 ], "specularFactor": [ 0.04, 0.04, 0.04 ], "glossinessFactor": 0.5 })");
  EXPECT_EQ(paint.type, "coateddiffuse");
  EXPECT_THAT(numbers(paint, "reflectance"), ElementsAre(0.5, 0.25, 0.125));
  EXPECT_NEAR(numbers(paint, "eta").at(0), 1.5, 1e-12);  // ((n - 1) / (n + 1))^2 = 0.04
  EXPECT_THAT(numbers(paint, "roughness"), ElementsAre(0.25));
  const auto gold = material(R"("KHR_materials_pbrSpecularGlossiness": {
      "diffuseFactor": [ 0, 0, 0, 1 ], "specularFactor": [ 1, 0.75, 0.25 ] })");
  EXPECT_EQ(gold.type, "conductor");
  EXPECT_THAT(numbers(gold, "reflectance"), ElementsAre(1, 0.75, 0.25));
}

TEST_F(ImportGltfExtensions, BaseColourTintsTransmittedLight) {
  const std::string glass = R"("KHR_materials_transmission": { "transmissionFactor": 1 })";
  const std::string green = R"(, "metallicFactor": 0, "baseColorFactor": [ 0.25, 1, 0.49, 1 ])";
  const auto pane = material(glass, green);
  EXPECT_EQ(pane.type, "thindielectric");
  EXPECT_THAT(numbers(pane, "transmittance"), ElementsAre(0.25, 1, 0.49));
  const auto body = material(glass + R"(, "KHR_materials_volume": { "thicknessFactor": 1 })", green);
  EXPECT_EQ(body.type, "dielectric");
  EXPECT_THAT(numbers(body, "transmittance"), ElementsAre(0.5, 1, testing::DoubleNear(0.7, 1e-12)));
  EXPECT_FALSE(material(glass).find("transmittance"));
}

// Half of the red is left after 2 m, and nothing of the blue.
TEST_F(ImportGltfExtensions, VolumesAreMedia) {
  const SceneDescription scene = describe(triangle(
      R"({ "name": "tea", "extensions": { "KHR_materials_transmission": { "transmissionFactor": 1 },
      "KHR_materials_volume": { "thicknessFactor": 4, "attenuationDistance": 2, "attenuationColor": [ 0.5, 1, 0 ] } } })"));
  ASSERT_EQ(scene.media.size(), 1u);
  EXPECT_EQ(scene.media[0].name, "tea");
  EXPECT_THAT(numbers(scene.media[0], "sigma_a"),
              ElementsAre(testing::DoubleNear(std::log(2.0) / 2, 1e-12), 0, testing::Gt(5)));
  EXPECT_EQ(scene.shapes.at(0).media.inside.name, "tea");
  EXPECT_EQ(scene.shapes.at(0).media.outside.name, "");
  EXPECT_FALSE(scene.materials.at(0).find("transmittance"));
}

TEST_F(ImportGltfExtensions, DiffuseTransmissionIsConverted) {
  const auto leaf = material(R"("KHR_materials_diffuse_transmission": { "diffuseTransmissionFactor": 0.25,
      "diffuseTransmissionColorFactor": [ 1, 0.5, 0 ] })",
                             R"(, "metallicFactor": 0)");
  EXPECT_EQ(leaf.type, "diffusetransmission");
  EXPECT_THAT(numbers(leaf, "reflectance"), ElementsAre(0.75, 0.75, 0.75));
  EXPECT_THAT(numbers(leaf, "transmittance"), ElementsAre(0.25, 0.125, 0));
}

TEST_F(ImportGltfExtensions, UnsupportedExtensionsAreNamed) {
  material(R"("VENDOR_materials_glitter": { "glitter": 1 })");
  EXPECT_THAT(diagnostics_.format_all(), HasSubstr("VENDOR_materials_glitter is ignored"));
}

// Joints a and b each have half of the weight of every vertex: the result is the mean of two translations,
// and the node's own transform does not count.
TEST_F(ImportGltfExtensions, SkinsMoveVerticesByTheirJoints) {
  Bytes bytes;
  bytes.shorts({0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0});
  bytes.floats({0.5f, 0.5f, 0, 0, 0.5f, 0.5f, 0, 0, 0.5f, 0.5f, 0, 0});
  const auto s =
      describe(triangle_with(R"("JOINTS_0": 4, "WEIGHTS_0": 5)",
                             R"({ "bufferView": 4, "componentType": 5123, "count": 3, "type": "VEC4" },
         { "bufferView": 4, "byteOffset": 24, "componentType": 5126, "count": 3, "type": "VEC4" })",
                             R"("skins": [ { "joints": [ 1, 2 ] } ],
         "nodes": [ { "mesh": 0, "skin": 0, "translation": [ 9, 9, 9 ] }, { "translation": [ 2, 0, 0 ] },
                    { "translation": [ 0, 4, 0 ] } ])",
                             bytes.text()));
  ASSERT_EQ(s.shapes.size(), 1u);
  EXPECT_EQ(s.shapes[0].object_to_world, glm::dmat4(1));
  EXPECT_THAT(numbers(s.shapes[0], "P"), ElementsAre(1, 2, 0, 2, 2, 0, 1, 3, 0));
}

TEST_F(ImportGltfExtensions, MorphTargetsAreApplied) {
  std::string parts(kTriangleParts);
  const std::string indices = R"("indices": 3,)";
  parts.replace(parts.find(indices), indices.size(), R"("indices": 3, "targets": [ { "POSITION": 1 } ],)");
  const auto s =
      describe(gltf(parts + R"("materials": [ {} ], "nodes": [ { "mesh": 0, "weights": [ 0.5 ] } ])"));
  EXPECT_THAT(numbers(s.shapes.at(0), "P"), ElementsAre(0, 0, 0.5, 1, 0, 0.5, 0, 1, 0.5));
}

TEST_F(ImportGltfExtensions, HiddenNodesAreLeftOut) {
  const auto s = describe(triangle("{}", R"(, "extensionsRequired": [ "KHR_node_visibility" ], "scenes": [ {
      "nodes": [ 0 ] } ])"));
  EXPECT_EQ(s.shapes.size(), 1u);
  const auto hidden =
      describe(gltf(std::string(kTriangleParts) + R"("materials": [ {} ], "nodes": [ { "children":
      [ 1 ], "extensions": { "KHR_node_visibility": { "visible": false } } }, { "mesh": 0 } ])"));
  EXPECT_TRUE(hidden.shapes.empty());
}

// Uses the accessor of the normals as three translations.
TEST_F(ImportGltfExtensions, InstancesAreExpanded) {
  const auto s = describe(gltf(std::string(kTriangleParts) + R"("materials": [ {} ], "nodes": [ { "mesh": 0,
      "extensions": { "EXT_mesh_gpu_instancing": { "attributes": { "TRANSLATION": 1 } } } } ],
      "extensionsRequired": [ "EXT_mesh_gpu_instancing" ])"));
  ASSERT_EQ(s.instances.size(), 3u);
  EXPECT_EQ(s.instances[2].instance_to_world[3], glm::dvec4(0, 0, 1, 1));
}

}  // namespace
}  // namespace kaustik::pbrt
