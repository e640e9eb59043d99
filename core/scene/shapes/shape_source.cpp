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
  auto indices = faces<3>(c, mesh.P.size());
  if (!complete || !indices) return std::nullopt;
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

float turn_of(const Context& c) {
  return static_cast<float>(glm::radians(c.reader.number("phimax")));
}

// As in pbrt, either of the two limits may be the larger one; the caller has sorted them.
bool check_extent(const Context& c, double z_min, double z_max) {
  if (z_min < z_max) return true;
  c.error(
      c.reader.location(c.shape.find("zmin") ? "zmin" : "zmax"),
      fmt::format("no part of the {} lies between `zmin` = {} and `zmax` = {}", c.shape.type, z_min, z_max));
  return false;
}

std::optional<ShapeSource> make_sphere(const Context& c) {
  const double radius = c.reader.number("radius");
  const auto limit = [&](std::string_view name, double whole) {
    return c.reader.has(name) ? std::clamp(c.reader.number(name), -radius, radius) : whole;
  };
  const auto [z_min, z_max] = std::minmax({limit("zmin", -radius), limit("zmax", radius)});
  if (!check_extent(c, z_min, z_max)) return std::nullopt;
  const glm::dmat4 local = glm::scale(glm::dmat4(1), glm::dvec3(radius));
  if (z_min == -radius && z_max == radius && c.reader.number("phimax") == 360)
    return ShapeSource{SphereSource{}, local};
  Quadric q;
  q.z_min = static_cast<float>(z_min / radius);
  q.z_max = static_cast<float>(z_max / radius);
  q.phi_max = turn_of(c);
  return ShapeSource{q, local};
}

std::optional<ShapeSource> make_cylinder(const Context& c) {
  const double radius = c.reader.number("radius");
  const auto [z_min, z_max] = std::minmax({c.reader.number("zmin"), c.reader.number("zmax")});
  if (!check_extent(c, z_min, z_max)) return std::nullopt;
  Quadric q;
  q.kind = QuadricKind::kCylinder;
  q.z_min = static_cast<float>(z_min / radius);
  q.z_max = static_cast<float>(z_max / radius);
  q.phi_max = turn_of(c);
  return ShapeSource{q, glm::scale(glm::dmat4(1), glm::dvec3(radius))};
}

std::optional<ShapeSource> make_disk(const Context& c) {
  const double radius = c.reader.number("radius");
  const double inner = c.reader.number("innerradius");
  if (!(inner < radius)) {
    c.error(c.reader.location("innerradius"),
            fmt::format("`innerradius` = {} leaves nothing of a disk of radius {}", inner, radius));
    return std::nullopt;
  }
  const glm::dmat4 local = glm::scale(
      glm::translate(glm::dmat4(1), glm::dvec3(0, 0, c.reader.number("height"))), glm::dvec3(radius));
  if (c.reader.number("phimax") == 360)
    return ShapeSource{DiskSource{static_cast<float>(inner / radius)}, local};
  Quadric q;
  q.kind = QuadricKind::kDisk;
  q.inner = static_cast<float>(inner / radius);
  q.phi_max = turn_of(c);
  return ShapeSource{q, local};
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

std::optional<ShapeSource> make_geometry(const Context& c, const MeshLoader& load_mesh) {
  if (c.shape.type == "trianglemesh") return make_trianglemesh(c);
  if (c.shape.type == "plymesh") return make_plymesh(c, load_mesh);
  if (c.shape.type == "bilinearmesh") return make_bilinearmesh(c);
  if (c.shape.type == "loopsubdiv") return make_loopsubdiv(c);
  if (c.shape.type == "sphere") return make_sphere(c);
  if (c.shape.type == "cylinder") return make_cylinder(c);
  return make_disk(c);
}

}  // namespace

std::optional<ShapeSource> make_shape_source(const ShapeDescription& shape, const TypeSpec& spec,
                                             const MeshLoader& load_mesh, DiagnosticList& diagnostics,
                                             const glm::dvec3& mesh_origin) {
  const ParameterReader reader(shape, spec);
  const Context context{shape, reader, diagnostics, mesh_origin};
  std::optional<ShapeSource> source = make_geometry(context, load_mesh);
  if (!source) return std::nullopt;
  const auto* mesh = std::get_if<TriangleMesh>(&source->geometry);
  if (mesh && !check_mesh(context, *mesh)) return std::nullopt;
  return source;
}

}  // namespace kaustik
