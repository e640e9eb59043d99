#include "apps/import/pbrt_importer.h"

#include "apps/import/ply.h"
#include "apps/import/scene_parser.h"
#include "core/scene/builder.h"

namespace kaustik::pbrt {

std::optional<SceneDescription> import_scene(const std::filesystem::path& path, Diagnostics& diagnostics) {
  SceneFiles files(diagnostics.files);
  std::string error;
  const auto file = files.open(path, error);
  if (!file) {
    diagnostics.error({}, error);
    return std::nullopt;
  }
  return SceneParser(path, files, diagnostics).parse(*file);
}

std::optional<LoadedScene> load_scene(const std::filesystem::path& path, Diagnostics& diagnostics) {
  auto description = import_scene(path, diagnostics);
  if (!description) return std::nullopt;
  const MeshLoader load_mesh = [&](const std::string& name, const SourceLocation& where) {
    const std::filesystem::path naming(where.valid() ? diagnostics.files.name(where.file) : path.string());
    return load_ply(resolve_path(name, naming, path));
  };
  auto scene = build_scene(*description, load_mesh, diagnostics);
  diagnostics.sort_by_location();
  if (!scene || diagnostics.has_errors()) return std::nullopt;
  return LoadedScene{std::move(*scene), std::move(*description)};
}

}  // namespace kaustik::pbrt
