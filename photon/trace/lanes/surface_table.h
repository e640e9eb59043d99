#pragma once
// What photons need to know about the scene's surfaces, one row per shape. A row is one cache line and takes
// one load, where the scene itself would be reached through variants and vectors.

#include <array>
#include <cstdint>
#include <vector>

#include "core/scene/scene.h"

namespace kaustik::photon {

// Flags that say how a surface is treated; combined by |.
enum SurfaceTraits : uint32_t {
  kSpecularTrait = 1,    // mirrors and dielectrics
  kDielectricTrait = 2,  // parameter[0] is eta
  kRoughTrait = 4,       // Oren-Nayar: parameter is {A, B}
  kSphereTrait = 8,
  kScalarTrait = 16,  // not computed in lanes: vertex normals, disks, textures, tints, media, other BSDFs
  kMissedTrait = 32,  // the ray met no surface
};

struct alignas(64) SurfaceRow {
  // Mesh data; for shapes that are not meshes, one degenerate triangle.
  const std::array<uint32_t, 3>* indices;
  const Point3* P;
  Rgb reflectance{1};  // 1 for dielectrics
  float parameter[2]{};
  float flip = 1;  // -1 for shapes with a flipped normal
  uint32_t traits = kMissedTrait;
  uint32_t surface_group = 0;
  uint32_t primitives = 0;  // mask for hit.primitive: all ones for meshes, zero for other shapes
};

// Thread-safe once constructed. Keeps pointers into the scene, which must outlive it unchanged.
class SurfaceTable {
 public:
  explicit SurfaceTable(const Scene& scene) : SurfaceTable(scene.shapes, scene.materials) {}
  SurfaceTable(const std::vector<Shape>& shapes, const std::vector<Material>& materials);

  // kNoIndex gives the row of rays that meet nothing.
  const SurfaceRow& row(uint32_t shape) const { return rows_[std::min<size_t>(shape, rows_.size() - 1)]; }
  const std::vector<Shape>& shapes() const { return *shapes_; }
  // True when the scene has so many triangles that most of them are not in the nearest caches.
  bool many_triangles() const { return many_triangles_; }

 private:
  const std::vector<Shape>* shapes_;
  std::vector<SurfaceRow> rows_;  // one more than shapes: the last is the row of rays that meet nothing
  bool many_triangles_ = false;
};

}  // namespace kaustik::photon
