// Tests the builder on descriptions made in code, for what needs no text.
#include "core/scene/build/builder.h"

#include <gtest/gtest.h>

#include <glm/gtc/matrix_transform.hpp>

#include "core/scene/shapes/bilinear.h"

namespace kaustik {
namespace {

Parameter numbers(ParameterType type, std::string name, std::vector<double> values) {
  Parameter p;
  p.type = type;
  p.name = std::move(name);
  p.numbers = std::move(values);
  return p;
}

ShapeDescription shape_of(std::string type, std::vector<Parameter> parameters) {
  ShapeDescription shape;
  shape.type = std::move(type);
  shape.parameters = std::move(parameters);
  return shape;
}

ShapeDescription mesh_file(std::string name) {
  Parameter p;
  p.type = ParameterType::kString;
  p.name = "filename";
  p.strings = {std::move(name)};
  return shape_of("plymesh", {p});
}

// A mesh of `count` triangles; the x of its first corner is the count.
MeshResult fan(size_t count) {
  MeshResult result;
  TriangleMesh& mesh = result.mesh;
  mesh.P.push_back({static_cast<float>(count), 0, 0});
  for (size_t i = 0; i <= count; ++i) mesh.P.push_back({static_cast<float>(i), 1, 0});
  for (uint32_t i = 0; i < count; ++i) mesh.indices.push_back({0, i + 2, i + 1});
  return result;
}

TEST(Builder, LoadsMeshesInParallelAndKeepsTheirOrder) {
  SceneDescription d;
  for (int i = 1; i <= 64; ++i) d.shapes.push_back(mesh_file(std::to_string(i)));
  Diagnostics diagnostics;
  const auto scene = build_scene(
      d, [](const std::string& name, const SourceLocation&) { return fan(std::stoul(name)); }, diagnostics);
  ASSERT_TRUE(scene) << diagnostics.format_all();
  ASSERT_EQ(scene->shapes.size(), 64u);
  for (size_t i = 0; i < 64; ++i) EXPECT_EQ(primitive_count(scene->shapes[i]), i + 1);
}

// A shape of a few numbers may be made of tens of thousands of triangles: those up to the limit are made.
TEST(Builder, ShapesMustFitIntoMemory) {
  const auto fits = [](const std::string& type, bool emits) {
    SceneDescription d;
    d.shapes.assign(3, shape_of(type, {}));
    d.area_lights.emplace_back().type = "diffuse";
    for (ShapeDescription& shape : d.shapes) {
      shape.object_to_world = glm::scale(glm::dmat4(1), glm::dvec3(1, 1, 2));
      if (emits) shape.area_light = 0;
    }
    Diagnostics diagnostics;
    diagnostics.files.root().set_room(MemoryRoom(1, "the test"));
    const bool built = build_scene(d, {}, diagnostics).has_value();
    if (!built) {
      EXPECT_GE(diagnostics.error_count(), 1u);
      for (const Diagnostic& error : diagnostics.entries())
        if (error.severity == Severity::kError) {
          EXPECT_EQ(error.message, "the shapes up to this one take more memory than the test allows");
        }
    }
    return built;
  };
  EXPECT_FALSE(fits("paraboloid", false));
  EXPECT_TRUE(fits("sphere", false));
  EXPECT_FALSE(fits("sphere", true));  // scaled unevenly, it shines as triangles
}

TEST(Builder, ReportsEveryMeshThatFailsInFileOrder) {
  SceneDescription d;
  for (int i = 0; i < 20; ++i) d.shapes.push_back(mesh_file(std::to_string(i)));
  Diagnostics diagnostics;
  const auto scene = build_scene(
      d,
      [](const std::string& name, const SourceLocation&) {
        return std::stoi(name) % 2 == 0 ? MeshResult{{}, "bad " + name} : fan(1);
      },
      diagnostics);
  EXPECT_FALSE(scene);
  ASSERT_EQ(diagnostics.entries().size(), 10u);
  for (int i = 0; i < 10; ++i) {
    EXPECT_EQ(diagnostics.entries()[static_cast<size_t>(i)].message, "bad " + std::to_string(2 * i));
  }
}

TEST(Builder, ChecksTheMeshesThatLoadersReturn) {
  const auto message = [](const MeshResult& result) {
    SceneDescription d;
    d.shapes.push_back(mesh_file("m"));
    Diagnostics diagnostics;
    build_scene(
        d, [&](const std::string&, const SourceLocation&) { return result; }, diagnostics);
    return diagnostics.entries().empty() ? std::string() : diagnostics.entries()[0].message;
  };
  MeshResult bad = fan(2);
  bad.mesh.indices[1][2] = 99;
  EXPECT_EQ(message(bad), "triangle 1 of the mesh has vertex 99: there are 4 vertices");
  bad = fan(2);
  bad.mesh.P[3].y = kInfinity;
  EXPECT_EQ(message(bad), "1 of 2 triangles have a position that is not finite and are left out");
  bad = fan(2);
  bad.mesh.N.assign(4, Normal3(0, 0, 1));
  bad.mesh.N[2].x = std::numeric_limits<float>::quiet_NaN();
  EXPECT_EQ(message(bad), "1 of 4 normals are not finite: those of the faces stand in");
}

TEST(Builder, ScalingByAPowerOfTwoScalesEveryVertexExactly) {
  const std::vector<double> P = {0.1, 0.7, -3.3, 1.9, 0.3, 0.2, -0.6, 1e-3, 4.7};
  const auto corners = [&](double scale) {
    SceneDescription d;
    d.shapes.push_back(shape_of("trianglemesh", {numbers(ParameterType::kPoint3, "P", P)}));
    d.shapes[0].object_to_world = glm::scale(glm::dmat4(1), glm::dvec3(scale)) *
                                  glm::rotate(glm::dmat4(1), 0.3, glm::dvec3(1, 2, 3)) *
                                  glm::translate(glm::dmat4(1), glm::dvec3(0.1, 0.2, 0.3));
    Diagnostics diagnostics;
    const auto scene = build_scene(d, nullptr, diagnostics);
    return std::get<TriangleMesh>(scene->shapes.at(0).geometry).P;
  };
  const auto one = corners(1);
  for (const int k : {-20, 20}) {
    const auto scaled = corners(std::ldexp(1.0, k));
    for (size_t i = 0; i < 3; ++i) EXPECT_EQ(scaled[i], one[i] * std::ldexp(1.0f, k));
  }
}

TEST(Builder, TrianglesWithoutAreaAreLeftOutAtEveryScale) {
  for (const double scale : {0x1p-40, 1.0, 0x1p40}) {
    SceneDescription d;
    d.shapes.push_back(
        shape_of("trianglemesh", {numbers(ParameterType::kPoint3, "P", {0, 0, 0, 1, 1, 1, 3, 3, 3, 0, 1, 0}),
                                  numbers(ParameterType::kInteger, "indices", {0, 1, 2, 0, 1, 3, 3, 3, 0})}));
    d.shapes[0].object_to_world = glm::scale(glm::dmat4(1), glm::dvec3(scale));
    Diagnostics diagnostics;
    const auto scene = build_scene(d, nullptr, diagnostics);
    ASSERT_TRUE(scene);
    EXPECT_EQ(std::get<TriangleMesh>(scene->shapes.at(0).geometry).indices,
              (std::vector<std::array<uint32_t, 3>>{{0, 1, 3}}));
    ASSERT_EQ(diagnostics.entries().size(), 1u);
    EXPECT_EQ(diagnostics.entries()[0].message, "2 of 3 triangles have no area and are left out");
  }
}

TEST(Builder, AllTrianglesWithoutAreaAreOneWarning) {
  SceneDescription d;
  for (int i = 0; i < 3; ++i)
    d.shapes.push_back(
        shape_of("trianglemesh", {numbers(ParameterType::kPoint3, "P", {0, 0, 0, 1, 1, 1, 0, 1, 0}),
                                  numbers(ParameterType::kInteger, "indices", {0, 1, 2, 0, 1, 1})}));
  Diagnostics diagnostics;
  EXPECT_TRUE(build_scene(d, nullptr, diagnostics));
  ASSERT_EQ(diagnostics.entries().size(), 1u);
  EXPECT_EQ(diagnostics.entries()[0].message, "3 of 6 triangles in 3 meshes have no area and are left out");
}

TEST(Bilinear, FlatConvexPatchesAreTwoTriangles) {
  const PatchMesh patch{{{0, 0, 0}, {2, 0, 0}, {0, 1, 0}, {3, 4, 0}}, {}, {}, {{0, 1, 2, 3}}};
  const TriangleMesh mesh = triangulate_patches(patch);
  EXPECT_EQ(mesh.P, patch.P);
  EXPECT_EQ(mesh.indices, (std::vector<std::array<uint32_t, 3>>{{0, 1, 3}, {0, 3, 2}}));
  EXPECT_TRUE(mesh.N.empty());
}

TEST(Bilinear, TiltedFlatPatchesStayFlat) {
  // The corners of this parallelogram are rounded, so it is flat up to rounding.
  const Point3 p(0.1f, 0.7f, 0.3f);
  const Vector3 u(0.3f, 0.17f, -0.9f), v(-0.23f, 0.77f, 0.41f);
  const TriangleMesh mesh = triangulate_patches({{p, p + u, p + v, p + u + v}, {}, {}, {{0, 1, 2, 3}}});
  EXPECT_EQ(mesh.indices.size(), 2u);
}

TEST(Bilinear, CurvedPatchesStayWithinTheChord) {
  // The patch is z = u v over the unit square.
  const TriangleMesh mesh =
      triangulate_patches({{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 1}}, {}, {}, {{0, 1, 2, 3}}});
  ASSERT_EQ(mesh.N.size(), mesh.P.size());
  const double tolerance = std::sqrt(3.0) / 1024;
  for (const auto& t : mesh.indices) {
    // The patch is farthest from a triangle at the middle of its diagonal; the edges along u or v lie in the
    // patch.
    for (int k = 0; k < 3; ++k) {
      const Point3 middle = 0.5f * (mesh.P[t[k]] + mesh.P[t[(k + 1) % 3]]);
      EXPECT_LE(std::abs(middle.z - middle.x * middle.y), tolerance);
    }
  }
  for (size_t i = 0; i < mesh.P.size(); ++i) {
    const Point3& q = mesh.P[i];
    const Normal3 n = glm::normalize(Normal3(-q.y, -q.x, 1));  // normal of z - x y = 0
    for (int k = 0; k < 3; ++k) EXPECT_NEAR(mesh.N[i][k], n[k], 4 * std::numeric_limits<float>::epsilon());
  }
}

TEST(Bilinear, LongThinPatchesStayWithinTheTriangleLimit) {
  const PatchMesh patch{{{0, 0, 0}, {1e6f, 0, 0}, {1e6f, 0, 1e-6f}, {0, 0, 1e-6f}}, {}, {}, {{0, 1, 2, 3}}};
  EXPECT_LE(triangulate_patches(patch).indices.size(), 2u * 23 * 23);
}

}  // namespace
}  // namespace kaustik
