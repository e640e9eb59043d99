// Tests scenes far from the world's origin, made in code.
#include "core/scene/build/local_origin.h"

#include <gtest/gtest.h>

#include <cstring>
#include <glm/gtc/matrix_transform.hpp>

#include "core/scene/build/builder.h"

namespace kaustik {
namespace {

ExactBounds box(const glm::dvec3& center, const glm::dvec3& half) {
  return {center - half, center + half};
}

TEST(LocalOrigin, EqualsTheWorldsOriginForScenesNearIt) {
  const glm::dvec3 half(2, 1, 2);  // radius 3
  for (const double d : {0.0, 3.0, 64 * 3.0})
    for (const glm::dvec3& axis : {glm::dvec3(d, 0, 0), glm::dvec3(0, -d, 0), glm::dvec3(0, 0, d)})
      EXPECT_EQ(local_origin(box(axis, half)), glm::dvec3(0)) << d;
  EXPECT_NE(local_origin(box({64 * 3.0 + 1, 0, 0}, half)), glm::dvec3(0));
}

TEST(LocalOrigin, EqualsTheWorldsOriginForScenesWithoutExtent) {
  const double inf = std::numeric_limits<double>::infinity();
  EXPECT_EQ(local_origin({}), glm::dvec3(0));
  EXPECT_EQ(local_origin(box({1e6, 0, 0}, glm::dvec3(0))), glm::dvec3(0));
  EXPECT_EQ(local_origin({glm::dvec3(0), glm::dvec3(inf)}), glm::dvec3(0));
  EXPECT_EQ(local_origin({glm::dvec3(1e200), glm::dvec3(1e200 * (1 + 1e-12))}), glm::dvec3(0));
}

// The local origin is a multiple of the smallest power of two above the radius, and no farther from the
// centre than half of that.
TEST(LocalOrigin, IsARoundNumberNearTheCentre) {
  for (const double d : {1e3, 1e6, 1e9}) {
    const glm::dvec3 center(1.1 * d, -0.3 * d, 0.7), half(2, 1, 2);
    const glm::dvec3 origin = local_origin(box(center, half));
    for (int k = 0; k < 3; ++k) {
      EXPECT_EQ(std::remainder(origin[k], 4), 0);
      EXPECT_LE(std::abs(origin[k] - center[k]), 2);
    }
  }
}

TEST(LocalOrigin, ScalesWithTheScene) {
  const glm::dvec3 center(1.1e5, -0.3e5, 0.7e5), half(1, 0.1, 0.3);
  const glm::dvec3 one = local_origin(box(center, half));
  EXPECT_NE(one, glm::dvec3(0));
  for (const int k : {-40, -1, 1, 40}) {
    const double s = std::ldexp(1.0, k);
    EXPECT_EQ(local_origin(box(s * center, s * half)), s * one);
  }
}

Parameter numbers(ParameterType type, std::string name, std::vector<double> values) {
  Parameter p;
  p.type = type;
  p.name = std::move(name);
  p.numbers = std::move(values);
  return p;
}

Directive directive(std::string type, std::vector<Parameter> parameters = {}) {
  Directive d;
  d.type = std::move(type);
  d.parameters = std::move(parameters);
  return d;
}

ShapeDescription shape(std::string type, std::vector<Parameter> parameters, const glm::dmat4& to_world) {
  ShapeDescription s;
  static_cast<Directive&>(s) = directive(std::move(type), std::move(parameters));
  s.object_to_world = to_world;
  return s;
}

glm::dmat4 translation(const glm::dvec3& v) {
  return glm::translate(glm::dmat4(1), v);
}

// How the scene is moved: by transforms, or by the coordinates of vertices and lights themselves.
enum class Way { kTransforms, kCoordinates };

std::vector<double> moved(std::vector<double> coordinates, const glm::dvec3& move) {
  for (size_t i = 0; i < coordinates.size(); ++i) coordinates[i] += move[static_cast<int>(i % 3)];
  return coordinates;
}

// One of everything that has a position. The bounding box of all shapes is [-1, 1]^3, so its radius is
// sqrt(3) and the origin's step is 2. Coordinates are multiples of 2^-10, so that sums with moves are exact.
SceneDescription everything(const glm::dvec3& move, Way way) {
  const glm::dvec3 by_matrix = way == Way::kTransforms ? move : glm::dvec3(0);
  const glm::dvec3 by_number = move - by_matrix;
  const glm::dmat4 m = translation(by_matrix);
  const std::vector<double> corners = {-1, -1, -1, 1, -1, 0.1240234375, 1, 1, 1, -1, 0.7392578125, 0.25};
  SceneDescription d;
  const auto mesh = [&](const char* type, std::vector<Parameter> more) {
    more.push_back(numbers(ParameterType::kPoint3, "P", moved(corners, by_number)));
    return shape(type, std::move(more), m);
  };
  d.shapes.push_back(mesh("trianglemesh", {numbers(ParameterType::kInteger, "indices", {0, 1, 2, 0, 2, 3})}));
  d.shapes.push_back(mesh("bilinearmesh", {}));
  d.shapes.push_back(shape("sphere", {numbers(ParameterType::kFloat, "radius", {0.25})},
                           translation(move + glm::dvec3(0.125, 0.0009765625, -0.5))));
  d.shapes.push_back(shape("disk", {numbers(ParameterType::kFloat, "height", {0.5})}, translation(move)));
  d.shapes.back().area_light = 0;
  d.area_lights.push_back(directive("diffuse"));
  d.objects.push_back({"object", {}, {mesh("trianglemesh", {})}});
  d.objects[0].shapes[0].parameters[0].numbers.resize(9);
  if (way == Way::kTransforms) d.objects[0].shapes[0].object_to_world = glm::dmat4(1);
  d.instances.push_back({"object", {}, m});
  LightDescription light;
  static_cast<Directive&>(light) = directive(
      "point", {numbers(ParameterType::kPoint3, "from", moved({0.5, 0.75, 0.1240234375}, by_number))});
  light.light_to_world = m;
  d.lights.push_back(light);
  d.camera.emplace();
  static_cast<Directive&>(*d.camera) = directive("perspective");
  d.camera->camera_to_world = translation(move + glm::dvec3(0, 0, -3.0009765625));
  return d;
}

Scene built(const SceneDescription& d, const MeshLoader& load_mesh = nullptr) {
  Diagnostics diagnostics;
  auto scene = build_scene(d, load_mesh, diagnostics);
  EXPECT_TRUE(scene) << diagnostics.format_all();
  return scene ? std::move(*scene) : Scene();
}

const TriangleMesh& mesh_of(const Shape& s) {
  return std::get<TriangleMesh>(s.geometry);
}

void expect_same(const Transform& a, const Transform& b) {
  EXPECT_EQ(std::memcmp(&a, &b, sizeof(a)), 0);
}

void expect_same(const Scene& a, const Scene& b) {
  ASSERT_EQ(a.shapes.size(), b.shapes.size());
  for (size_t i = 0; i < a.shapes.size(); ++i) {
    SCOPED_TRACE(i);
    ASSERT_EQ(a.shapes[i].geometry.index(), b.shapes[i].geometry.index());
    EXPECT_EQ(a.shapes[i].surface_group, b.shapes[i].surface_group);
    if (std::holds_alternative<TriangleMesh>(a.shapes[i].geometry)) {
      EXPECT_EQ(mesh_of(a.shapes[i]).P, mesh_of(b.shapes[i]).P);
      EXPECT_EQ(mesh_of(a.shapes[i]).N, mesh_of(b.shapes[i]).N);
    } else if (const auto* s = std::get_if<Sphere>(&a.shapes[i].geometry)) {
      expect_same(s->to_world, std::get<Sphere>(b.shapes[i].geometry).to_world);
    } else {
      expect_same(std::get<Disk>(a.shapes[i].geometry).to_world,
                  std::get<Disk>(b.shapes[i].geometry).to_world);
    }
  }
  EXPECT_EQ(std::get<PointLight>(a.lights[0]).position, std::get<PointLight>(b.lights[0]).position);
  expect_same(a.camera.to_world, b.camera.to_world);
  EXPECT_EQ(a.bounds.min, b.bounds.min);
  EXPECT_EQ(a.bounds.max, b.bounds.max);
}

TEST(LocalOrigin, FarScenesHaveTheSameBitsAsAtTheOrigin) {
  const Scene reference = built(everything(glm::dvec3(0), Way::kTransforms));
  EXPECT_EQ(reference.origin, glm::dvec3(0));
  for (const double sizes : {1e3, 1e4, 1e5, 1e6, 1e9})
    for (const Way way : {Way::kTransforms, Way::kCoordinates}) {
      SCOPED_TRACE(sizes);
      const glm::dvec3 move = 2 * sizes * glm::dvec3(1, -0.5, 0.75);
      const Scene far = built(everything(move, way));
      EXPECT_EQ(far.origin, move);
      expect_same(far, reference);
    }
}

// Near scenes keep the world's coordinates, rounded to float.
TEST(LocalOrigin, NearScenesKeepWorldCoordinates) {
  const glm::dvec3 move(50, -25, 37.5);
  for (const Way way : {Way::kTransforms, Way::kCoordinates}) {
    const Scene scene = built(everything(move, way));
    EXPECT_EQ(scene.origin, glm::dvec3(0));
    EXPECT_EQ(mesh_of(scene.shapes[0]).P[1], Point3(move + glm::dvec3(1, -1, 0.1240234375)));
    EXPECT_EQ(std::get<Sphere>(scene.shapes[2].geometry).to_world.translation,
              Vector3(move + glm::dvec3(0.125, 0.0009765625, -0.5)));
    EXPECT_EQ(scene.camera.to_world.translation, Vector3(move + glm::dvec3(0, 0, -3.0009765625)));
  }
}

TEST(LocalOrigin, ScalingByAPowerOfTwoScalesFarScenesExactly) {
  const auto scaled = [](double s) {
    SceneDescription d = everything({1.1e5, -0.3e5, 0.7e5}, Way::kTransforms);
    const glm::dmat4 scale = glm::scale(glm::dmat4(1), glm::dvec3(s));
    for (ShapeDescription& shape : d.shapes) shape.object_to_world = scale * shape.object_to_world;
    for (InstanceDescription& i : d.instances) i.instance_to_world = scale * i.instance_to_world;
    return built(d);
  };
  const Scene one = scaled(1);
  for (const int k : {-20, 20}) {
    const Scene scene = scaled(std::ldexp(1.0, k));
    EXPECT_EQ(scene.origin, std::ldexp(1.0, k) * one.origin);
    for (const size_t i : {0, 1, 4}) {
      const auto &P = mesh_of(scene.shapes[i]).P, &expected = mesh_of(one.shapes[i]).P;
      for (size_t v = 0; v < P.size(); ++v) EXPECT_EQ(P[v], std::ldexp(1.0f, k) * expected[v]);
    }
  }
}

// A mesh file holds floats. Coordinates that are as coarse as the distance are moved without another
// rounding.
TEST(LocalOrigin, FloatsOfMeshFilesAreMovedExactly) {
  MeshResult file;
  file.mesh.P = {{1e6f, 1e6f, 0}, {1e6f + 1, 1e6f, 0.125f}, {1e6f, 1e6f + 0.0625f, 1}};
  file.mesh.indices = {{0, 1, 2}};
  SceneDescription d;
  Parameter name;
  name.type = ParameterType::kString;
  name.name = "filename";
  name.strings = {"m"};
  d.shapes.push_back(shape("plymesh", {name}, glm::dmat4(1)));
  const Scene scene = built(d, [&](const std::string&, const SourceLocation&) { return file; });
  EXPECT_NE(scene.origin, glm::dvec3(0));
  for (size_t i = 0; i < 3; ++i)
    EXPECT_EQ(glm::dvec3(mesh_of(scene.shapes[0]).P[i]) + scene.origin, glm::dvec3(file.mesh.P[i]));
}

// A metre is 1e36 units of the second mesh, so the origin, 1024 m away, is out of the range of floats there.
TEST(LocalOrigin, MeshesWithTinyUnitsArePlacedExactly) {
  const auto triangle = [](double size, const glm::dmat4& to_world) {
    return shape("trianglemesh", {numbers(ParameterType::kPoint3, "P", {0, 0, 0, size, 0, 0, 0, size, 0})},
                 to_world);
  };
  const glm::dvec3 at(0x1p20, 0, 0), aside(-0x1p10, 0, 0);
  SceneDescription d;
  d.shapes.push_back(triangle(1, translation(at)));
  d.shapes.push_back(triangle(1e36, glm::scale(translation(at + aside), glm::dvec3(1e-36))));
  const Scene scene = built(d);
  ASSERT_EQ(scene.shapes.size(), 2u);
  for (size_t i = 0; i < 2; ++i) {
    const glm::dvec3 corner = glm::dvec3(mesh_of(scene.shapes[i]).P[0]) + scene.origin;
    EXPECT_EQ(corner, at + double(i) * aside);
    EXPECT_NEAR(mesh_of(scene.shapes[i]).P[1].x - mesh_of(scene.shapes[i]).P[0].x, 1, 1e-4);
  }
}

}  // namespace
}  // namespace kaustik
