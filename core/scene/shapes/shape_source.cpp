// Makes the geometry of each shape type from its parameters.

#include "core/scene/shapes/shape_source.h"

#include <fmt/format.h>

#include <algorithm>
#include <glm/gtc/matrix_transform.hpp>

#include "core/scene/shapes/bilinear.h"
#include "core/scene/shapes/loop_subdivision.h"

namespace kaustik {
namespace {

struct Context {
  const ShapeDescription& shape;
  const ParameterReader& reader;
  DiagnosticList& diagnostics;
  glm::dvec3 mesh_origin;

  void error(const SourceLocation& where, std::string message) const {
    diagnostics.error(where, std::move(message));
  }
  const Parameter* required(std::string_view name) const {
    const Parameter* p = shape.find(name);
    if (!p) error(shape.type_location, fmt::format("shape \"{}\" needs `{}`", shape.type, name));
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
    c.error(p->location, fmt::format("`indices` of shape \"{}\" come in groups of {}, but there are {}",
                                     c.shape.type, kSize, p->numbers.size()));
    return std::nullopt;
  }
  std::vector<std::array<uint32_t, kSize>> out(p->numbers.size() / kSize);
  for (size_t i = 0; i < p->numbers.size(); ++i) {
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

bool check_per_vertex(const Context& c, std::string_view name, size_t count, size_t vertices) {
  if (count == 0 || count == vertices) return true;
  c.error(c.shape.find(name)->location,
          fmt::format("`{}` has {} entries for {} vertices", name, count, vertices));
  return false;
}

std::optional<ShapeSource> make_trianglemesh(const Context& c) {
  const Parameter* P = c.required("P");
  if (!P) return std::nullopt;
  TriangleMesh mesh;
  mesh.P = positions(c, *P);
  mesh.N = vectors<Normal3, 3>(c.shape.find("N"));
  mesh.uv = vectors<Point2, 2>(c.shape.find("uv"));
  const bool complete = check_per_vertex(c, "N", mesh.N.size(), mesh.P.size()) &&
                        check_per_vertex(c, "uv", mesh.uv.size(), mesh.P.size());
  mesh.colours = vectors<glm::vec4, 4>(c.shape.find("Cd"));
  auto indices = faces<3>(c, mesh.P.size());
  if (!complete || !check_per_vertex(c, "Cd", mesh.colours.size(), mesh.P.size()) || !indices)
    return std::nullopt;
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
  const bool complete = check_per_vertex(c, "N", mesh.N.size(), mesh.P.size()) &&
                        check_per_vertex(c, "uv", mesh.uv.size(), mesh.P.size());
  auto patches = faces<4>(c, mesh.P.size());
  if (!complete || !patches) return std::nullopt;
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
  auto mesh = subdivide_loop(cage, static_cast<int>(c.reader.number("levels")), &error);
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

// Checks that apply to both inline meshes and mesh files.
bool check_mesh(const Context& c, const TriangleMesh& mesh) {
  const std::string_view source = c.shape.find("P") ? "P" : "filename";
  const SourceLocation where = c.reader.location(source);
  for (size_t i = 0; i < mesh.P.size(); ++i) {
    if (is_finite(mesh.P[i]) && (mesh.N.empty() || is_finite(mesh.N[i]))) continue;
    c.error(where, fmt::format("vertex {} of the mesh has a {} that is not finite", i,
                               is_finite(mesh.P[i]) ? "normal" : "position"));
    return false;
  }
  for (size_t t = 0; t < mesh.indices.size(); ++t) {
    for (const uint32_t index : mesh.indices[t]) {
      if (index < mesh.P.size()) continue;
      c.error(where, fmt::format("triangle {} of the mesh has vertex {}: there are {} vertices", t, index,
                                 mesh.P.size()));
      return false;
    }
  }
  return true;
}

std::optional<ShapeSource> make_mesh(const Context& c, const MeshLoader& load_mesh) {
  if (c.shape.type == "plymesh") return make_plymesh(c, load_mesh);
  if (c.shape.type == "bilinearmesh") return make_bilinearmesh(c);
  if (c.shape.type == "loopsubdiv") return make_loopsubdiv(c);
  return make_trianglemesh(c);
}

}  // namespace

std::optional<ShapeSource> make_shape_source(const ShapeDescription& shape, const ShapeRow& row,
                                             const MeshLoader& load_mesh, DiagnosticList& diagnostics,
                                             const glm::dvec3& mesh_origin) {
  const ParameterReader reader(shape, row.spec);
  if (row.make) return row.make({reader, diagnostics});
  const Context context{shape, reader, diagnostics, mesh_origin};
  std::optional<ShapeSource> source = make_mesh(context, load_mesh);
  if (!source) return std::nullopt;
  const auto* mesh = std::get_if<TriangleMesh>(&source->geometry);
  if (mesh && !check_mesh(context, *mesh)) return std::nullopt;
  return source;
}

}  // namespace kaustik
