#pragma once
// Loop's subdivision (1987) of a triangle mesh, taken to its limit surface, with pbrt's weights (Pharr et al.
// 2016, section 3.8).

#include <optional>
#include <string>

#include "core/geometry/shape.h"

namespace kaustik {

// Most triangles that a subdivision may come to.
inline constexpr uint64_t kMostSubdivided = 200'000'000;

// Each triangle of the cage becomes 4^levels, whose vertices lie on the limit surface and have its normals,
// on the side of the cage's winding. Boundaries become the limit curves of their own vertices. Nothing, with
// the reason, where an edge has more than two triangles, a vertex lies between several fans of them, two
// neighbours wind differently, or there would be more than kMostSubdivided triangles. Indices must be in
// range.
std::optional<TriangleMesh> subdivide_loop(const TriangleMesh& cage, int levels, std::string* error);

}  // namespace kaustik
