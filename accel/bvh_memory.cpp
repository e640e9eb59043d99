#include "accel/bvh_memory.h"

#include <set>

namespace kaustik::accel {

namespace {

// Measured as what the process holds at the peak of the build. Vertices are copies that are scaled for
// Embree. A leaf of the BVH has room for four triangles; one that shares no side with others (foliage, hair)
// mostly takes all of it.
constexpr uint64_t kTriangle = 100, kApart = 150, kVertex = 16, kAnalytic = 200, kInstance = 1400,
                   kAny = 4u << 20;

uint64_t bytes_of(const TriangleMesh& mesh) {
  return kTriangle * mesh.indices.size() + kVertex * mesh.P.size();
}

}  // namespace

uint64_t forecast_bytes(const Scene& scene, const SideEstimate& sides) {
  uint64_t bytes = kAny + static_cast<uint64_t>(double(kApart) * sides.apart);
  std::set<const TriangleMesh*> shared;
  for (const Shape& shape : scene.shapes) {
    const TriangleMesh* mesh = shape.mesh();
    const bool instance = std::holds_alternative<InstancedMesh>(shape.geometry);
    if (!mesh) bytes += kAnalytic;
    if (instance) bytes += kInstance;
    if (mesh && (!instance || shared.insert(mesh).second)) bytes += bytes_of(*mesh);
  }
  if (scene.interfaces) bytes += forecast_bytes(*scene.interfaces, estimate_sides(scene.interfaces->shapes));
  return bytes;
}

}  // namespace kaustik::accel
