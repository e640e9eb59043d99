#pragma once
// Geometry as plain data in world space. The outside of a shape is where its oriented geometric normal
// points: one-sided lights emit to that side, and dielectrics have their exterior medium there.

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <variant>
#include <vector>

#include "core/geometry/analytic/disk.h"
#include "core/geometry/analytic/quadric.h"
#include "core/geometry/analytic/sphere.h"
#include "core/math/bounds.h"
#include "core/math/index.h"
#include "core/math/transform.h"
#include "core/math/vec.h"
#include "core/medium/medium.h"

namespace kaustik {

// Indexed triangles. N, uv and colours are empty or have one entry per vertex. The outside is the side of
// cross(p1 - p0, p2 - p0); where N is given, the geometric normal is turned into the hemisphere of N (pbrt's
// rule).
struct TriangleMesh {
  static constexpr std::string_view kName = "trianglemesh";

  std::vector<Point3> P;
  std::vector<Normal3> N;
  std::vector<Point2> uv;
  std::vector<std::array<uint32_t, 3>> indices;
  std::vector<glm::vec4> colours{};  // linear red, green and blue, and alpha
};

// A mesh in a space of its own, placed by to_world; any number of instances share it. If N is given, its
// vectors have unit length, and are negated if the shape's orientation is reversed.
struct InstancedMesh {
  static constexpr std::string_view kName = "instance";

  std::shared_ptr<const TriangleMesh> mesh;
  Bounds3 local;  // of the mesh
  Transform to_world;
};

// Every shape is a mesh or an AnalyticShape; a type that lacks a member does not compile.
template <class G>
concept ShapeGeometry = AnalyticShape<G> || std::same_as<G, TriangleMesh> || std::same_as<G, InstancedMesh>;
template <ShapeGeometry... G>
using VariantOfShapes = std::variant<G...>;

// The list of all shapes. To add an analytic one: (1) write a header with the struct, and its source
// (core/geometry/analytic/analytic_shape.h says what it must have), (2) add its name here, and below if it is
// a SweptShape, (3) add its row to core/scene/schema/shape_rows.cpp. The tests then ask for an oracle in
// tests/accel/support/brute_force.h and for examples in tests/core/support/shape_examples.h.
using Geometry = VariantOfShapes<TriangleMesh, Sphere, Disk, InstancedMesh, Quadric>;
template <SweptShape... S>
using VariantOfSweptShapes = std::variant<S...>;
using SweptGeometry = VariantOfSweptShapes<Quadric>;

struct Shape {
  Geometry geometry;
  uint32_t material = 0;       // into Scene::materials
  uint32_t light = kNoIndex;   // into Scene::lights; kNoIndex unless the shape emits
  uint32_t surface_group = 0;  // photons are shared only within a group
  // ReverseOrientation xor the handedness of the transform (not applied where N is given).
  bool flip_normal = false;
  MediumInterface media{};
  // Opacity of the surface: a constant, or a float texture of the scene (core/scene/alpha.h).
  float alpha = 1;
  uint32_t alpha_texture = kNoIndex;

  bool has_alpha() const { return alpha < 1 || alpha_texture != kNoIndex; }

  // Its triangles, in world space or in an instance's own space; null for other shapes.
  const TriangleMesh* mesh() const {
    if (const auto* instance = std::get_if<InstancedMesh>(&geometry)) return instance->mesh.get();
    return std::get_if<TriangleMesh>(&geometry);
  }
};

// The shape as a grid over (s, phi); nothing for meshes.
std::optional<SweptGeometry> swept_of(const Shape& shape);
std::string_view name_of(const Shape& shape);

Bounds3 bounds_of(const Shape& shape);
double surface_area(const Shape& shape);
uint64_t primitive_count(const Shape& shape);  // triangles, or 1

}  // namespace kaustik
