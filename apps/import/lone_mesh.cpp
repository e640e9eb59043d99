#include "apps/import/lone_mesh.h"

#include <algorithm>

#include "apps/import/common/make_parameter.h"
#include "apps/import/obj/obj_text.h"
#include "apps/import/ply/ply.h"
#include "apps/import/stl/stl.h"
#include "core/text.h"

namespace kaustik {
namespace {

template <class V>
std::vector<double> flat(const std::vector<V>& vectors) {
  std::vector<double> out;
  out.reserve(vectors.size() * size_t(V::length()));
  for (const V& v : vectors)
    for (int k = 0; k < V::length(); ++k) out.push_back(double(v[k]));
  return out;
}

ShapeDescription shape_of(const TriangleMesh& mesh, const SourceLocation& where) {
  DirectiveMaker<ShapeDescription> shape("trianglemesh", where);
  std::vector<double> indices;
  indices.reserve(3 * mesh.indices.size());
  for (const auto& triangle : mesh.indices) indices.insert(indices.end(), triangle.begin(), triangle.end());
  shape.add(ParameterType::kPoint3, "P", flat(mesh.P));
  shape.add(ParameterType::kInteger, "indices", std::move(indices));
  const auto finite = [](const Normal3& n) { return is_finite(n); };
  if (!mesh.N.empty() && std::all_of(mesh.N.begin(), mesh.N.end(), finite))
    shape.add(ParameterType::kNormal, "N", flat(mesh.N));
  if (!mesh.uv.empty()) shape.add(ParameterType::kPoint2, "uv", flat(mesh.uv));
  if (!mesh.colours.empty()) shape.add(ParameterType::kFloat, "Cd", flat(mesh.colours));
  return std::move(*shape);
}

// Gives the only shape a diffuse material of the colours of its vertices.
void show_vertex_colours(SceneDescription& scene) {
  const SourceLocation& where = scene.location;
  DirectiveMaker<TextureDescription> colours("vertexcolor", where);
  colours->name = "colours";
  colours->value_type = "spectrum";
  colours->name_location = colours->value_type_location = where;
  scene.textures.push_back(std::move(*colours));
  DirectiveMaker<MaterialDescription> material("diffuse", where);
  material.add(make_parameter(ParameterType::kTexture, "reflectance", "colours", where));
  material->name = "coloured";
  material->name_location = where;
  scene.materials.push_back(std::move(*material));
  scene.shapes[0].material = {std::nullopt, "coloured", where};
}

}  // namespace

bool is_lone_mesh(const std::filesystem::path& path) {
  const std::string extension = lower_extension(path);
  return extension == ".ply" || extension == ".stl";
}

std::optional<SceneDescription> import_lone_mesh(const ReadableFile& file, Diagnostics& diagnostics) {
  const std::filesystem::path& path = file.path();
  // In place of its bytes the file's hash counts in the hash of the scene.
  std::string content;
  const MeshResult loaded =
      lower_extension(path) == ".stl" ? load_stl(file, &content) : pbrt::load_ply(file, &content, true);
  const SourceLocation where{diagnostics.files.add(path.string(), content), 0, 0};
  if (!loaded.error.empty() || loaded.mesh.indices.empty()) {
    diagnostics.error(where, loaded.error.empty() ? "there are no triangles in this file" : loaded.error);
    return std::nullopt;
  }
  SceneDescription scene;
  scene.location = where;
  scene.shapes.push_back(shape_of(loaded.mesh, where));
  scene.shapes[0].name = path.stem().string();
  if (!loaded.mesh.colours.empty()) show_vertex_colours(scene);
  return scene;
}

}  // namespace kaustik
