#pragma once
// Loop subdivision (1987) of a triangle mesh to its limit surface, with pbrt's weights (Pharr et al. 2016,
// section 3.8).

#include <optional>
#include <string>

#include "core/geometry/shape.h"
#include "core/memory/memory_room.h"

namespace kaustik {

// Limit on the number of triangles after subdivision.
inline constexpr uint64_t kMostSubdivided = 200'000'000;

// Divides each triangle of the cage into 4^levels, whose vertices lie on the limit surface and have its
// normals, on the side of the cage's winding. Boundaries become the limit curves of their own vertices.
// Returns nothing and sets the reason in *error if an edge has more than two triangles, several fans of
// triangles meet at a vertex, two neighbours have different winding or all vertices in common, or the result
// would exceed kMostSubdivided triangles or not fit into the room. Indices must be in range.
std::optional<TriangleMesh> subdivide_loop(const TriangleMesh& cage, int levels, std::string* error,
                                           const MemoryRoom& room = {});

}  // namespace kaustik
