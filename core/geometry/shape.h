#pragma once
// Geometry as plain data in world space. The outside of a shape is where its oriented geometric normal
// points: one-sided lights emit to that side, and dielectrics have their exterior medium there.

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <variant>
#include <vector>

#include "core/geometry/quadric.h"
#include "core/math/bounds.h"
#include "core/math/transform.h"
#include "core/math/vec.h"

namespace kaustik {

// Indexed triangles. N and uv are empty or have one entry per vertex. The outside is the side of cross(p1 -
// p0, p2 - p0); where N is given, the geometric normal is turned into the hemisphere of N (pbrt's rule).
struct TriangleMesh {
  std::vector<Point3> P;
  std::vector<Normal3> N;
  std::vector<Point2> uv;
  std::vector<std::array<uint32_t, 3>> indices;
};

// A mesh in a space of its own, placed by to_world; any number of instances share it. If N is given, its
// vectors have unit length, and are negated if the shape's orientation is reversed.
struct InstancedMesh {
  std::shared_ptr<const TriangleMesh> mesh;
  Bounds3 local;  // of the mesh
  Transform to_world;
};

// The unit sphere about the origin mapped by to_world: exact, including ellipsoids.
struct Sphere {
  Transform to_world;
};

// The annulus inner <= |xy| <= 1, z = 0 mapped by to_world. The outside is the side of +z (mapped as a
// normal).
struct Disk {
  Transform to_world;
  float inner = 0;  // inner radius over outer radius, in [0, 1)
};

inline constexpr uint32_t kNoIndex = 0xffffffffu;

struct Shape {
  std::variant<TriangleMesh, Sphere, Disk, InstancedMesh, Quadric> geometry;
  uint32_t material = 0;       // into Scene::materials
  uint32_t light = kNoIndex;   // into Scene::lights; kNoIndex unless the shape emits
  uint32_t surface_group = 0;  // photons are shared only within a group
  // ReverseOrientation xor the handedness of the transform (not applied where N is given).
  bool flip_normal = false;
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

// Converts spheres and disks to quadrics; nothing for meshes.
std::optional<Quadric> quadric_of(const Shape& shape);

Bounds3 bounds_of(const Shape& shape);
double surface_area(const Shape& shape);
uint64_t primitive_count(const Shape& shape);  // triangles, or 1

}  // namespace kaustik
