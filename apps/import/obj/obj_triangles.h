#pragma once
// Turns the faces of an OBJ file into triangles, in parallel.

#include "apps/import/obj/obj_reader.h"

namespace kaustik::obj {

// Cuts every face into triangles (ply/polygon.h), so that corners come in threes, `sizes` is empty and `face`
// of the state changes counts triangles. Triangles without area and faces with positions that are not finite
// are left out; the warnings of each part count them at `file`.
void cut_into_triangles(ObjText& text, const SourceLocation& file);

// Half the cross product of two edges: the normal, as long as the triangle's area.
glm::dvec3 area_vector(const ObjText& text, const Corners& corners, size_t triangle);

}  // namespace kaustik::obj
