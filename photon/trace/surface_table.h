#pragma once
// What photons need to know about the surfaces of a scene, a row per shape: found by one load each, where the
// scene itself has variants and vectors on the way.

#include <array>
#include <cstdint>
#include <vector>

#include "core/scene/scene.h"

namespace kaustik::photon {

// How a surface is dealt with. Combined by |.
enum SurfaceTraits : uint32_t {
  kSpecularTrait = 1,    // mirrors and dielectrics
  kDielectricTrait = 2,  // parameter[0] is eta
  kRoughTrait = 4,       // Oren and Nayar: parameter is A, B
  kSphereTrait = 8,
  kScalarTrait = 16,  // has what is not computed in lanes: vertex normals, disks, textures, other BSDFs
  kMissedTrait = 32,  // no surface at all
};

struct alignas(64) SurfaceRow {
  // Of shapes that are no meshes: one degenerate triangle.
  const std::array<uint32_t, 3>* indices;
  const Point3* P;
  Rgb reflectance{1};  // one for dielectrics
  float parameter[2]{};
  float flip = 1;  // -1 for shapes of flipped normal
  uint32_t traits = kMissedTrait;
  uint32_t surface_group = 0;
  uint32_t primitives = 0;  // all ones for meshes, zero where hits name no primitive
};

// Thread-safe once made. Keeps pointers into the scene, which must outlive it unchanged.
class SurfaceTable {
 public:
  explicit SurfaceTable(const Scene& scene) : SurfaceTable(scene.shapes, scene.materials) {}
  SurfaceTable(const std::vector<Shape>& shapes, const std::vector<Material>& materials);

  // kNoIndex gives the row of rays that meet nothing.
  const SurfaceRow& row(uint32_t shape) const { return rows_[std::min<size_t>(shape, rows_.size() - 1)]; }
  const std::vector<Shape>& shapes() const { return *shapes_; }
  // Whether triangles are so many that most lie out of the nearest caches.
  bool many_triangles() const { return many_triangles_; }

 private:
  const std::vector<Shape>* shapes_;
  std::vector<SurfaceRow> rows_;  // one more than shapes
  bool many_triangles_ = false;
};

}  // namespace kaustik::photon
