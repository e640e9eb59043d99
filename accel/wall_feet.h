#pragma once
// Wall feet: the lines along which other surfaces stand on a surface or pierce it.
//
// Light on one side of a wall of no thickness says nothing about the other side, although the floor under it
// is one surface. A density estimate next to a wall must know where its foot is (photon/estimate/walls.h).
//
// A wall that ends just above the surface, like a door above its sill, separates the light on both sides as
// well.
//
// Not handled: walls and floors that are not triangles; walls that share their bend of less than 60 degrees
// with the surface they stand on.

#include <vector>

#include "accel/edge_index.h"
#include "core/scene/scene.h"

namespace kaustik::accel {

// Shapes with the fewest triangles are looked at, up to this number in all. Finer ones give no feet.
inline constexpr uint64_t kMostWallTriangles = 1 << 20;
// If more pairs of boxes than this have to be compared, walls above the surface are left out; and if there
// are still more without a gap, the scene has no feet: its triangles are a thicket.
inline constexpr uint64_t kMostWallPairs = uint64_t{1} << 30;

// The feet of walls on surfaces with diffuse lobes. a, b and surface_group say where; n is the normal of the
// surface on the side on which the wall stands, and both_sides whether it goes on behind; the other members
// mean nothing. A triangle touches a surface if it comes within 2^-19 of the coordinates' size. Not walls
// are: glass, masked surfaces, other shapes' triangles that bend away by less than 26 degrees, those of the
// same surface that bend by less than 60, and what stands along `ends`, where the surface ends anyway.
// gap: metres; a triangle of another surface is a wall, too, if two of its corners are at most so high above
// this one and the third is higher. Its foot is the line below those two. Triangles smaller than twice the
// gap may be left out. Sorted; does not depend on the number of threads, and scales with the scene by powers
// of two.
std::vector<BoundaryEdge> find_wall_feet(const Scene& scene, const EdgeIndex& ends, float gap);

}  // namespace kaustik::accel
