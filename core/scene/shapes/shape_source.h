#pragma once
// A shape in its own space, as given by the parameters of a Shape line, before any transform. Instances share
// it.

#include <optional>
#include <variant>

#include "core/geometry/shape.h"
#include "core/memory/memory_room.h"
#include "core/scene/schema/schema.h"
#include "core/scene/shapes/mesh_loader.h"

namespace kaustik {

// Makes the geometry of a Shape line. Returns nothing, with errors added, if the parameters contradict each
// other or an index of the mesh is out of range. Triangles with positions that are not finite are left out,
// and such normals become zero, with warnings. The directive must have passed check_parameters. mesh_origin:
// in the shape's space; vertices given in the scene file are rounded to float relative to it. room: for what
// is subdivided. Thread-safe.
std::optional<ShapeSource> make_shape_source(const ShapeDescription& shape, const ShapeRow& row,
                                             const MeshLoader& load_mesh, const MemoryRoom& room,
                                             DiagnosticList& diagnostics,
                                             const glm::dvec3& mesh_origin = glm::dvec3(0));

struct PlacedShape {
  Shape shape;
  size_t without_area = 0;  // triangles left out because their corners lie on one line
  bool finite = true;       // false if the transform takes the shape beyond the range of floats
};

// Bakes the transform into the shape. Triangles keep their order.
PlacedShape place_shape(ShapeSource source, const glm::dmat4& object_to_world, bool reverse_orientation);

// A mesh that is shared by its instances.
struct SharedMesh {
  InstancedMesh instance;  // without its placement
  glm::dmat4 local{1};     // as in ShapeSource
  size_t without_area = 0;
  bool finite = true;
};

// Whether this many placements of the shape should share its mesh. Copies are faster to trace as long as they
// are few and small.
bool pays_to_share(const ShapeSource& source, size_t placements);
SharedMesh share_mesh(ShapeSource source, bool reverse_orientation);
PlacedShape place_instance(const SharedMesh& shared, const glm::dmat4& object_to_world,
                           bool reverse_orientation);

}  // namespace kaustik
