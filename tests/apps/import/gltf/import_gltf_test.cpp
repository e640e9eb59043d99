// Tests the import of glTF 2.0.

#include <numbers>

#include "tests/apps/import/gltf/gltf_support.h"

namespace kaustik::pbrt {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

TEST_F(ImportGltf, TriangleIsRead) {
  const SceneDescription s = describe(triangle("{}"));
  ASSERT_EQ(s.shapes.size(), 1u);
  const ShapeDescription& shape = s.shapes[0];
  EXPECT_EQ(shape.type, "trianglemesh");
  EXPECT_THAT(numbers(shape, "P"), ElementsAre(0, 0, 0, 1, 0, 0, 0, 1, 0));
  EXPECT_THAT(numbers(shape, "indices"), ElementsAre(0, 1, 2));
  // t points down in glTF and up in pbrt.
  EXPECT_THAT(numbers(shape, "uv"), ElementsAre(0, 1, 1, 1, 0, 0.75));
}

TEST_F(ImportGltf, BinaryContainerIsRead) {
  const std::string json =
      std::string(R"({ "asset": { "version": "2.0" }, "buffers": [ { "byteLength": 104 } ],)") +
      std::string(kTriangleParts) + R"("materials": [ {} ], "nodes": [ { "mesh": 0 } ] })";
  const SceneDescription s = describe(write("scene.glb", glb(json, triangle_bytes())));
  ASSERT_EQ(s.shapes.size(), 1u);
  EXPECT_THAT(numbers(s.shapes[0], "P"), ElementsAre(0, 0, 0, 1, 0, 0, 0, 1, 0));
}

// A whole scene goes through the builder: the imported camera sees the triangle.
TEST_F(ImportGltf, BuildsAScene) {
  Diagnostics diagnostics;
  const auto loaded =
      load_scene(triangle(R"({ "pbrMetallicRoughness": { "metallicFactor": 1, "roughnessFactor": 0 } })"),
                 diagnostics, kWithoutFloor);
  ASSERT_TRUE(loaded) << diagnostics.format_all();
  ASSERT_EQ(loaded->scene.shapes.size(), 1u);
  Point2 raster;
  Point3 origin;
  ASSERT_TRUE(loaded->scene.camera.project(Point3(0.25f, 0.25f, 0), &raster, &origin));
  // The world is right-handed: points towards +x appear on the right, and higher points nearer to the top.
  Point2 right, above;
  ASSERT_TRUE(loaded->scene.camera.project(Point3(0.75f, 0.25f, 0), &right, &origin));
  ASSERT_TRUE(loaded->scene.camera.project(Point3(0.25f, 0.75f, 0), &above, &origin));
  EXPECT_GT(right.x, raster.x);
  EXPECT_LT(above.y, raster.y);
}

TEST_F(ImportGltf, MetalsAndDielectricsAreConverted) {
  const auto metal = describe(triangle(R"({ "name": "m", "pbrMetallicRoughness": {
      "baseColorFactor": [ 0.9, 0.6, 0.3, 1 ], "roughnessFactor": 0.5 } })"))
                         .materials.at(0);
  EXPECT_EQ(metal.type, "conductor");
  EXPECT_THAT(numbers(metal, "reflectance"), ElementsAre(0.9, 0.6, 0.3));
  EXPECT_THAT(numbers(metal, "roughness"), ElementsAre(0.25));  // alpha is the square
  EXPECT_THAT(numbers(metal, "remaproughness"), ElementsAre(0));
  const auto paint = describe(triangle(R"({ "pbrMetallicRoughness": { "metallicFactor": 0 },
      "extensions": { "KHR_materials_ior": { "ior": 1.3 } } })"))
                         .materials.at(0);
  EXPECT_EQ(paint.type, "coateddiffuse");
  EXPECT_THAT(numbers(paint, "eta"), ElementsAre(1.3));
  const auto dull = describe(triangle(R"({ "pbrMetallicRoughness": { "metallicFactor": 0 },
      "extensions": { "KHR_materials_specular": { "specularFactor": 0 } } })"))
                        .materials.at(0);
  EXPECT_EQ(dull.type, "diffuse");
}

TEST_F(ImportGltf, GlassIsConverted) {
  const auto pane =
      describe(triangle(R"({ "pbrMetallicRoughness": { "metallicFactor": 0, "roughnessFactor": 0 },
      "extensions": { "KHR_materials_transmission": { "transmissionFactor": 1 },
                      "KHR_materials_volume": { "thicknessFactor": 0.1 } } })"))
          .materials.at(0);
  EXPECT_EQ(pane.type, "dielectric");
  EXPECT_THAT(numbers(pane, "eta"), ElementsAre(1.5));
}

TEST_F(ImportGltf, LightsAreConverted) {
  const auto s = describe(triangle(R"({ "emissiveFactor": [ 1, 0.5, 0 ], "doubleSided": true,
      "extensions": { "KHR_materials_emissive_strength": { "emissiveStrength": 4 } } })"));
  ASSERT_EQ(s.area_lights.size(), 1u);
  EXPECT_THAT(numbers(s.area_lights[0], "L"), ElementsAre(4, 2, 0));
  EXPECT_TRUE(s.area_lights[0].find("twosided"));
  EXPECT_EQ(s.shapes[0].area_light, 0u);
  EXPECT_TRUE(s.lights.empty());
}

// The field is 60 degrees high and twice as wide; pbrt's angle is that of the shorter side, the height.
TEST_F(ImportGltf, CamerasAreConverted) {
  const auto s = describe(gltf(R"("cameras": [ { "type": "perspective",
        "perspective": { "yfov": 1.0471975511965976, "aspectRatio": 2, "znear": 0.1 } } ],
      "extensions": { "KHR_lights_punctual": { "lights": [
        { "type": "point", "color": [ 1, 0.5, 0.25 ], "intensity": 5464 },
        { "type": "spot", "intensity": 1366, "spot": { "innerConeAngle": 0.1, "outerConeAngle": 0.2 } },
        { "type": "directional", "intensity": 2049 } ] } },
      "nodes": [ { "camera": 0, "translation": [ 1, 2, 3 ] },
                 { "extensions": { "KHR_lights_punctual": { "light": 0 } }, "translation": [ 0, 5, 0 ] },
                 { "extensions": { "KHR_lights_punctual": { "light": 1 } } },
                 { "extensions": { "KHR_lights_punctual": { "light": 2 } } } ])"));
  EXPECT_NEAR(numbers(*s.camera, "fov").at(0), 60, 1e-12);
  EXPECT_THAT(numbers(*s.film, "xresolution"), ElementsAre(1440));
  EXPECT_EQ(s.camera->camera_to_world[3], glm::dvec4(1, 2, 3, 1));
  EXPECT_EQ(s.camera->camera_to_world[2], glm::dvec4(0, 0, -1, 0));  // the direction of view
  ASSERT_EQ(s.lights.size(), 3u);
  EXPECT_THAT(numbers(s.lights[0], "I"), ElementsAre(8, 4, 2));
  EXPECT_EQ(s.lights[0].light_to_world[3].y, 5);
  EXPECT_THAT(numbers(s.lights[1], "I"), ElementsAre(2, 2, 2));
  EXPECT_THAT(numbers(s.lights[2], "L"), ElementsAre(3, 3, 3));
  ASSERT_EQ(s.notes.size(), 1u);
  EXPECT_THAT(s.notes[0], testing::HasSubstr("683 lm to the watt (--light-unit watt"));
  EXPECT_NEAR(numbers(s.lights[1], "coneangle").at(0), 0.2 * 180 / std::numbers::pi, 1e-12);
  EXPECT_NEAR(numbers(s.lights[1], "conedeltaangle").at(0), 0.1 * 180 / std::numbers::pi, 1e-12);
  EXPECT_THAT(numbers(s.lights[2], "to"), ElementsAre(0, 0, -1));
  EXPECT_EQ(diagnostics_.warning_count(), 0u) << diagnostics_.format_all();
}

// Old exporters wrote the power of point and spot lights, which shine 1 / (4 pi) of it per steradian.
TEST_F(ImportGltf, LightsCanBeReadInWatts) {
  const auto path = gltf(R"("extensions": { "KHR_lights_punctual": { "lights": [
        { "type": "point", "intensity": 100 }, { "type": "directional", "intensity": 3 } ] } },
      "nodes": [ { "extensions": { "KHR_lights_punctual": { "light": 0 } } },
                 { "extensions": { "KHR_lights_punctual": { "light": 1 } } } ])");
  const auto s = import_scene(path, diagnostics_, {.light_unit = LightUnit::kWatt});
  ASSERT_TRUE(s && s->lights.size() == 2u) << diagnostics_.format_all();
  EXPECT_NEAR(numbers(s->lights[0], "I").at(0), 100 / (4 * std::numbers::pi), 1e-12);
  EXPECT_THAT(numbers(s->lights[1], "L"), ElementsAre(3, 3, 3));
  ASSERT_EQ(s->notes.size(), 1u);
  EXPECT_THAT(s->notes[0], testing::HasSubstr("watts"));
}

// A quarter turn about z after scaling by 2, below a parent with a translation: (1, 0, 0) -> (0, 2, 0) + (10,
// 0, 0).
TEST_F(ImportGltf, TransformsOfParentsApply) {
  const auto s = describe(gltf(std::string(kTriangleParts) + R"("materials": [ {} ],
      "nodes": [ { "children": [ 1 ], "translation": [ 10, 0, 0 ] },
                 { "mesh": 0, "rotation": [ 0, 0, 0.7071067811865476, 0.7071067811865476 ], "scale": [ 2, 2, 2 ] } ],
      "scene": 0, "scenes": [ { "nodes": [ 0 ] } ])"));
  const glm::dvec4 p = s.shapes.at(0).object_to_world * glm::dvec4(1, 0, 0, 1);
  EXPECT_NEAR(glm::length(p - glm::dvec4(10, 2, 0, 1)), 0, 1e-14);
}

TEST_F(ImportGltf, MeshesOfSeveralNodesBecomeInstances) {
  const auto s = describe(gltf(std::string(kTriangleParts) + R"("materials": [ {} ],
      "nodes": [ { "mesh": 0 }, { "mesh": 0, "translation": [ 1, 0, 0 ] } ])"));
  EXPECT_TRUE(s.shapes.empty());
  ASSERT_EQ(s.objects.size(), 1u);
  EXPECT_EQ(s.objects[0].shapes.size(), 1u);
  ASSERT_EQ(s.instances.size(), 2u);
  EXPECT_EQ(s.instances[1].instance_to_world[3].x, 1);
}

TEST_F(ImportGltf, SparseAndQuantisedAccessorsAreRead) {
  Bytes b;
  b.shorts({0, 0, 0, 65535, 0, 0, 0, 65535, 0});  // 0: 18 bytes, padded to 20
  b.shorts({1});                                  // 20: index of the changed vertex
  b.shorts({0, 0, 65535});                        // 24: its new value
  const auto s = describe(gltf(R"("bufferViews": [ { "buffer": 0, "byteLength": 18 },
      { "buffer": 0, "byteOffset": 20, "byteLength": 2 }, { "buffer": 0, "byteOffset": 24, "byteLength": 6 } ],
      "accessors": [ { "bufferView": 0, "componentType": 5123, "normalized": true, "count": 3, "type": "VEC3",
        "sparse": { "count": 1, "indices": { "bufferView": 1, "componentType": 5123 }, "values": { "bufferView": 2 } } } ],
      "meshes": [ { "primitives": [ { "attributes": { "POSITION": 0 } } ] } ], "nodes": [ { "mesh": 0 } ],
      "extensionsRequired": [ "KHR_mesh_quantization" ])",
                               b.text()));
  EXPECT_THAT(numbers(s.shapes.at(0), "P"), ElementsAre(0, 0, 0, 0, 0, 1, 0, 1, 0));
}

TEST_F(ImportGltf, StripsAndFansBecomeTriangles) {
  for (const auto& [mode, expected] : {std::pair{5, std::vector<double>{0, 1, 2, 2, 1, 3}},
                                       std::pair{6, std::vector<double>{0, 1, 2, 0, 2, 3}}}) {
    Bytes b;
    b.floats({0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0});
    const auto s = describe(gltf(fmt::format(R"("bufferViews": [ {{ "buffer": 0, "byteLength": 48 }} ],
      "accessors": [ {{ "bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3" }} ],
      "meshes": [ {{ "primitives": [ {{ "attributes": {{ "POSITION": 0 }}, "mode": {} }} ] }} ], "nodes": [ {{ "mesh": 0 }} ])",
                                             mode),
                                 b.text()));
    EXPECT_EQ(numbers(s.shapes.at(0), "indices"), expected);
  }
}

}  // namespace
}  // namespace kaustik::pbrt
