// Makes the geometry of each shape type from its parameters.

#include "core/scene/shapes/shape_source.h"

#include <fmt/format.h>

#include <algorithm>
#include <glm/gtc/matrix_transform.hpp>

#include "core/scene/shapes/bilinear.h"
#include "core/scene/shapes/loop_subdivision.h"
#include "core/scene/shapes/parametric.h"

namespace kaustik {
namespace {

struct Context {
  const ShapeDescription& shape;
  const ParameterReader& reader;
  DiagnosticList& diagnostics;
  const MemoryRoom& room;
  glm::dvec3 mesh_origin;

  void error(const SourceLocation& where, std::string message) const {
    diagnostics.error(where, std::move(message));
  }
  const Parameter* required(std::string_view name) const {
    const Parameter* p = shape.find(name);
    if (!p && !shape.incomplete)
      error(shape.type_location, fmt::format("shape \"{}\" needs `{}`", shape.type, name));
    return p;
  }
};

template <class V, int kSize>
std::vector<V> vectors(const Parameter* p) {
  std::vector<V> out;
  if (!p) return out;
  out.resize(p->numbers.size() / kSize);
  for (size_t i = 0; i < out.size(); ++i) {
    for (int k = 0; k < kSize; ++k) out[i][k] = static_cast<float>(p->numbers[i * kSize + k]);
  }
  return out;
}

std::vector<Point3> positions(const Context& c, const Parameter& P) {
  std::vector<Point3> out(P.numbers.size() / 3);
  for (size_t i = 0; i < out.size(); ++i) {
    const double* p = &P.numbers[3 * i];
    out[i] = Point3(glm::dvec3(p[0], p[1], p[2]) - c.mesh_origin);
  }
  return out;
}

// Faces of kSize vertices each; without `indices`, one face of the only kSize vertices.
template <size_t kSize>
std::optional<std::vector<std::array<uint32_t, kSize>>> faces(const Context& c, size_t vertices) {
  const Parameter* p = c.shape.find("indices");
  if (!p) {
    std::array<uint32_t, kSize> only{};
    for (size_t k = 0; k < kSize; ++k) only[k] = static_cast<uint32_t>(k);
    if (vertices == kSize) return std::vector<std::array<uint32_t, kSize>>{only};
    c.required("indices");
    return std::nullopt;
  }
  if (p->numbers.size() % kSize != 0) {
    c.diagnostics.warning(
        p->location,
        fmt::format(
            "`indices` of shape \"{}\" come in groups of {}, but there are {}: the last ones are ignored",
            c.shape.type, kSize, p->numbers.size()));
  }
  std::vector<std::array<uint32_t, kSize>> out(p->numbers.size() / kSize);
  for (size_t i = 0; i < kSize * out.size(); ++i) {
    const double index = p->numbers[i];
    if (!(index >= 0 && index < static_cast<double>(vertices))) {
      c.error(p->value_location(i),
              fmt::format("index {} is out of range: there are {} vertices", index, vertices));
      return std::nullopt;
    }
    out[i / kSize][i % kSize] = static_cast<uint32_t>(index);
  }
  return out;
}

// Leaves out values that are not one per vertex, as pbrt does.
template <class V>
void check_per_vertex(const Context& c, std::string_view name, size_t vertices, std::vector<V>& values) {
  if (values.empty() || values.size() == vertices) return;
  c.diagnostics.warning(
      c.shape.find(name)->location,
      fmt::format("`{}` has {} entries for {} vertices and is ignored", name, values.size(), vertices));
  values.clear();
}

std::optional<ShapeSource> make_trianglemesh(const Context& c) {
  const Parameter* P = c.required("P");
  if (!P) return std::nullopt;
  TriangleMesh mesh;
  mesh.P = positions(c, *P);
  mesh.N = vectors<Normal3, 3>(c.shape.find("N"));
  mesh.uv = vectors<Point2, 2>(c.shape.find("uv"));
  mesh.colours = vectors<glm::vec4, 4>(c.shape.find("Cd"));
  check_per_vertex(c, "N", mesh.P.size(), mesh.N);
  check_per_vertex(c, "uv", mesh.P.size(), mesh.uv);
  check_per_vertex(c, "Cd", mesh.P.size(), mesh.colours);
  auto indices = faces<3>(c, mesh.P.size());
  if (!indices) return std::nullopt;
  mesh.indices = std::move(*indices);
  return ShapeSource{std::move(mesh), glm::translate(glm::dmat4(1), c.mesh_origin)};
}

std::optional<ShapeSource> make_bilinearmesh(const Context& c) {
  const Parameter* P = c.required("P");
  if (!P) return std::nullopt;
  PatchMesh mesh;
  mesh.P = positions(c, *P);
  mesh.N = vectors<Normal3, 3>(c.shape.find("N"));
  mesh.uv = vectors<Point2, 2>(c.shape.find("uv"));
  check_per_vertex(c, "N", mesh.P.size(), mesh.N);
  check_per_vertex(c, "uv", mesh.P.size(), mesh.uv);
  auto patches = faces<4>(c, mesh.P.size());
  if (!patches) return std::nullopt;
  mesh.patches = std::move(*patches);
  return ShapeSource{triangulate_patches(mesh), glm::translate(glm::dmat4(1), c.mesh_origin)};
}

std::optional<ShapeSource> make_loopsubdiv(const Context& c) {
  const Parameter* P = c.required("P");
  if (!P || !c.required("indices")) return std::nullopt;
  TriangleMesh cage;
  cage.P = positions(c, *P);
  auto indices = faces<3>(c, cage.P.size());
  if (!indices) return std::nullopt;
  cage.indices = std::move(*indices);
  std::string error;
  auto mesh = subdivide_loop(cage, static_cast<int>(c.reader.number("levels")), &error, c.room);
  if (!mesh) {
    c.error(c.reader.location("indices"), fmt::format("this mesh cannot be subdivided: {}", error));
    return std::nullopt;
  }
  return ShapeSource{std::move(*mesh), glm::translate(glm::dmat4(1), c.mesh_origin)};
}

std::optional<ShapeSource> make_plymesh(const Context& c, const MeshLoader& load_mesh) {
  if (!c.required("filename")) return std::nullopt;
  const SourceLocation where = c.reader.location("filename");
  MeshResult result = load_mesh(c.reader.text("filename"), where);
  if (!result.error.empty()) {
    c.error(where, std::move(result.error));
    return std::nullopt;
  }
  return ShapeSource{std::move(result.mesh)};
}

// Leaves out triangles with a corner that is not finite. Such vertices, which no triangle has then, are moved
// to a finite place.
void leave_out_infinite(const Context& c, const SourceLocation& where, TriangleMesh& mesh) {
  const auto finite = [](const Point3& p) { return is_finite(p); };
  if (std::all_of(mesh.P.begin(), mesh.P.end(), finite)) return;
  const auto first = std::find_if(mesh.P.begin(), mesh.P.end(), finite);
  const Point3 elsewhere = first == mesh.P.end() ? Point3(0) : *first;
  const size_t before = mesh.indices.size();
  std::erase_if(mesh.indices, [&](const auto& t) {
    return std::any_of(t.begin(), t.end(), [&](uint32_t i) { return !is_finite(mesh.P[i]); });
  });
  for (Point3& p : mesh.P) p = is_finite(p) ? p : elsewhere;
  c.diagnostics.warning(where,
                        fmt::format("{} of {} triangles have a position that is not finite and are left out",
                                    before - mesh.indices.size(), before));
}

// A normal of zero counts as none: the other corners' normals stand in, and then the face's.
void clear_infinite_normals(const Context& c, const SourceLocation& where, TriangleMesh& mesh) {
  size_t cleared = 0;
  for (Normal3& n : mesh.N) {
    if (is_finite(n)) continue;
    n = Normal3(0);
    ++cleared;
  }
  if (cleared == 0) return;
  c.diagnostics.warning(where, fmt::format("{} of {} normals are not finite: those of the faces stand in",
                                           cleared, mesh.N.size()));
}

// Checks that apply to both inline meshes and mesh files. What is not finite is left out.
bool check_mesh(const Context& c, TriangleMesh& mesh) {
  const std::string_view source = c.shape.find("P") ? "P" : "filename";
  const SourceLocation where = c.reader.location(source);
  for (size_t t = 0; t < mesh.indices.size(); ++t) {
    for (const uint32_t index : mesh.indices[t]) {
      if (index < mesh.P.size()) continue;
      c.error(where, fmt::format("triangle {} of the mesh has vertex {}: there are {} vertices", t, index,
                                 mesh.P.size()));
      return false;
    }
  }
  leave_out_infinite(c, where, mesh);
  clear_infinite_normals(c, where, mesh);
  return true;
}

std::optional<ShapeSource> source_of(std::optional<TriangleMesh> mesh) {
  if (!mesh) return std::nullopt;
  return ShapeSource{std::move(*mesh)};
}

bool all_required(const Context& c, std::initializer_list<std::string_view> names) {
  return std::all_of(names.begin(), names.end(), [&](std::string_view name) { return c.required(name); });
}

std::optional<ShapeSource> make_surface_of_nurbs(const Context& c) {
  if (!all_required(c, {"nu", "nv", "uorder", "vorder", "uknots", "vknots", c.shape.find("Pw") ? "Pw" : "P"}))
    return std::nullopt;
  auto source = source_of(make_nurbs(c.reader, c.mesh_origin, c.diagnostics));
  if (source) source->local = glm::translate(glm::dmat4(1), c.mesh_origin);
  return source;
}

std::optional<ShapeSource> make_mesh(const Context& c, const MeshLoader& load_mesh) {
  if (c.shape.type == "cone") return source_of(make_cone(c.reader, c.diagnostics));
  if (c.shape.type == "paraboloid") return source_of(make_paraboloid(c.reader, c.diagnostics));
  if (c.shape.type == "hyperboloid") return source_of(make_hyperboloid(c.reader, c.diagnostics));
  if (c.shape.type == "heightfield" && all_required(c, {"nu", "nv", "Pz"}))
    return source_of(make_heightfield(c.reader, c.diagnostics));
  if (c.shape.type == "nurbs") return make_surface_of_nurbs(c);
  if (c.shape.type == "plymesh") return make_plymesh(c, load_mesh);
  if (c.shape.type == "bilinearmesh") return make_bilinearmesh(c);
  if (c.shape.type == "loopsubdiv") return make_loopsubdiv(c);
  return c.shape.type == "trianglemesh" ? make_trianglemesh(c) : std::nullopt;
}

}  // namespace

std::optional<ShapeSource> make_shape_source(const ShapeDescription& shape, const ShapeRow& row,
                                             const MeshLoader& load_mesh, const MemoryRoom& room,
                                             DiagnosticList& diagnostics, const glm::dvec3& mesh_origin) {
  const ParameterReader reader(shape, row.spec);
  if (row.make) return row.make({reader, diagnostics});
  const Context context{shape, reader, diagnostics, room, mesh_origin};
  std::optional<ShapeSource> source = make_mesh(context, load_mesh);
  if (!source) return std::nullopt;
  auto* mesh = std::get_if<TriangleMesh>(&source->geometry);
  if (mesh && !check_mesh(context, *mesh)) return std::nullopt;
  return source;
}

}  // namespace kaustik
