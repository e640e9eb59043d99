// Tests animated files at chosen moments: keys, interpolation, morph weights.

#include <numbers>

#include "tests/apps/import/gltf/triangle_with.h"

namespace kaustik::pbrt {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

class GltfAnimation : public GltfTriangleWith {
 protected:
  // The triangle, one of whose paths has these keys; `values` are the output's, `type` their element.
  std::filesystem::path animated(const std::string& path, const std::string& interpolation,
                                 const std::string& type, std::initializer_list<float> times,
                                 std::initializer_list<float> values, size_t components) {
    Bytes bytes;
    bytes.floats(times);
    bytes.floats(values);
    const std::string accessors = fmt::format(
        R"({{ "bufferView": 4, "componentType": 5126, "count": {}, "type": "SCALAR" }},
           {{ "bufferView": 4, "byteOffset": {}, "componentType": 5126, "count": {}, "type": "{}" }})",
        times.size(), 4 * times.size(), values.size() / components, type);
    const std::string more = fmt::format(
        R"("nodes": [ {{ "mesh": 0, "translation": [ 0, 7, 0 ] }} ], "animations": [ {{
           "samplers": [ {{ "input": 4, "output": 5, "interpolation": "{}" }} ],
           "channels": [ {{ "sampler": 0, "target": {{ "node": 0, "path": "{}" }} }} ] }} ])",
        interpolation, path);
    return triangle_with("", accessors, more, bytes.text());
  }
  SceneDescription at(const std::filesystem::path& path, std::optional<float> seconds) {
    diagnostics_ = Diagnostics();
    auto scene = import_scene(path, diagnostics_, {.seconds = seconds});
    EXPECT_TRUE(scene) << diagnostics_.format_all();
    return scene ? std::move(*scene) : SceneDescription{};
  }
  double x_at(const std::filesystem::path& path, std::optional<float> seconds) {
    return at(path, seconds).shapes.at(0).object_to_world[3].x;
  }
};

TEST_F(GltfAnimation, TranslationsAreInterpolatedLinearly) {
  const auto path = animated("translation", "LINEAR", "VEC3", {1, 2, 4}, {0, 0, 0, 8, 0, 0, 16, 0, 0}, 3);
  EXPECT_EQ(x_at(path, std::nullopt), 0);  // the beginning: the first key's value
  EXPECT_EQ(x_at(path, 1.5f), 4);
  EXPECT_EQ(x_at(path, 3.0f), 12);
  EXPECT_EQ(x_at(path, 9.0f), 16);
  const auto scene = at(path, 3.0f);
  EXPECT_EQ(scene.shapes.at(0).object_to_world[3].y, 0);  // replaces the node's own translation
  ASSERT_EQ(scene.notes.size(), 1u);
  EXPECT_THAT(scene.notes[0], HasSubstr("up to 4 s: it is shown at 3 s"));
}

TEST_F(GltfAnimation, StepsHoldTheirValue) {
  const auto path = animated("translation", "STEP", "VEC3", {1, 2}, {3, 0, 0, 8, 0, 0}, 3);
  EXPECT_EQ(x_at(path, 1.75f), 3);
  EXPECT_EQ(x_at(path, 2.0f), 8);
}

// Half-way between keys of 0 and 4 that are 2 s apart, with an out-tangent of 1/s and an in-tangent of 3/s:
// (0 + 4) / 2 + 2 s (1 - 3) / 8 = 1.5.
TEST_F(GltfAnimation, CubicSplinesUseTheirTangents) {
  const auto path = animated("translation", "CUBICSPLINE", "VEC3", {0, 2},
                             {0, 0, 0, 0, 0, 0, 1, 0, 0, 3, 0, 0, 4, 0, 0, 0, 0, 0}, 3);
  EXPECT_NEAR(x_at(path, 1.0f), 1.5, 1e-12);
  EXPECT_EQ(x_at(path, 2.0f), 4);
}

// From no turn to a quarter turn about z, by the shorter arc although the second quaternion is negated.
TEST_F(GltfAnimation, RotationsFollowTheShorterArc) {
  const float h = std::sqrt(0.5f);
  const auto path = animated("rotation", "LINEAR", "VEC4", {0, 1}, {0, 0, 0, 1, 0, 0, -h, -h}, 4);
  const auto x = at(path, 0.5f).shapes.at(0).object_to_world[0];
  EXPECT_NEAR(x.x, std::cos(std::numbers::pi / 4), 1e-6);  // the file's numbers are floats
  EXPECT_NEAR(x.y, std::sin(std::numbers::pi / 4), 1e-6);
}

TEST_F(GltfAnimation, WeightsMoveMorphTargets) {
  Bytes bytes;
  bytes.floats({0, 1});
  bytes.floats({0, 1});
  std::string parts(kTriangleParts);
  const std::string indices = R"("indices": 3,)", view = R"("byteLength": 6 } ])",
                    scalar = R"("type": "SCALAR" } ])";
  parts.replace(parts.find(indices), indices.size(), R"("indices": 3, "targets": [ { "POSITION": 1 } ],)");
  parts.replace(parts.find(view), view.size(),
                R"("byteLength": 6 }, { "buffer": 0, "byteOffset": 104, "byteLength": 16 } ])");
  parts.replace(
      parts.find(scalar), scalar.size(),
      R"("type": "SCALAR" }, { "bufferView": 4, "componentType": 5126, "count": 2, "type": "SCALAR" },
                   { "bufferView": 4, "byteOffset": 8, "componentType": 5126, "count": 2, "type": "SCALAR" } ])");
  const auto path = gltf(parts + R"("materials": [ {} ], "nodes": [ { "mesh": 0 } ], "animations": [ {
      "samplers": [ { "input": 4, "output": 5 } ],
      "channels": [ { "sampler": 0, "target": { "node": 0, "path": "weights" } } ] } ])",
                         triangle_bytes() + bytes.text());
  EXPECT_THAT(numbers(at(path, 0.25f).shapes.at(0), "P"), ElementsAre(0, 0, 0.25, 1, 0, 0.25, 0, 1, 0.25));
}

TEST_F(GltfAnimation, ChannelsThatDoNotFitAreLeftOut) {
  const auto path = animated("translation", "LINEAR", "VEC3", {0, 1, 2}, {1, 0, 0, 2, 0, 0}, 3);
  EXPECT_EQ(at(path, 1.0f).shapes.at(0).object_to_world[3].y, 7);
  EXPECT_THAT(diagnostics_.format_all(), HasSubstr("keys and values do not fit are left out (1 channel)"));
}

}  // namespace
}  // namespace kaustik::pbrt
