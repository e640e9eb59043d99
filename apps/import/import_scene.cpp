#include "apps/import/import_scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <mutex>
#include <set>

#include "apps/import/common/image_files.h"
#include "apps/import/common/no_scene.h"
#include "apps/import/gltf/importer.h"
#include "apps/import/lone_mesh.h"
#include "apps/import/obj/obj_importer.h"
#include "apps/import/pbrt/scene_parser.h"
#include "apps/import/ply/ply.h"
#include "apps/import/view/camera_choice.h"
#include "apps/import/view/view.h"
#include "core/files/content_hash.h"
#include "core/scene/build/builder.h"
#include "core/texture/texture.h"

namespace kaustik::pbrt {

namespace {

// Content hashes of the meshes and images that a scene names, by name, and their paths. add() is thread-safe.
class NamedContents {
 public:
  void add(const std::string& name, std::string content, const std::filesystem::path& path) {
    const std::lock_guard lock(mutex_);
    contents_.emplace(name, std::move(content));
    paths_.insert(path.string());
  }
  const std::set<std::pair<std::string, std::string>>& all() const { return contents_; }
  const std::set<std::string>& paths() const { return paths_; }

 private:
  std::mutex mutex_;
  std::set<std::pair<std::string, std::string>> contents_;
  std::set<std::string> paths_;
};

// Hashes the scene texts in the order in which they were opened, then the other files in the order of their
// names.
std::string content_hash(const SourceFiles& files, const NamedContents& named) {
  ContentHash hash;
  const auto add = [&hash](std::string_view text) {
    const uint64_t size = text.size();
    hash.add(&size, sizeof size);  // separates the texts: moving bytes from one to the next changes the hash
    hash.add(text);
  };
  for (uint32_t i = 0; i < files.size(); ++i) add(files.text(i));
  for (const auto& [name, content] : named.all()) add(name), add(content);
  return hash.text();
}

// Colours of meshes take memory, so they are read only if a texture shows them.
bool shows_vertex_colours(const SceneDescription& scene) {
  return std::any_of(scene.textures.begin(), scene.textures.end(),
                     [](const TextureDescription& t) { return t.type == VertexColourTexture::kName; });
}

std::vector<std::string> files_read(const SourceFiles& files, const NamedContents& named) {
  std::vector<std::string> paths(named.paths().begin(), named.paths().end());
  for (uint32_t i = 0; i < files.size(); ++i) paths.emplace_back(files.name(i));
  return paths;
}

std::optional<SceneDescription> import_pbrt(const ReadableFile& readable, Diagnostics& diagnostics) {
  SceneFiles files(diagnostics.files);
  const OpenedText opened = files.open(readable);
  if (!opened.file) {
    diagnostics.error({}, opened.error);
    return std::nullopt;
  }
  return SceneParser(readable.path(), files, diagnostics).parse(*opened.file);
}

// Files of other formats than glTF have at most one camera, without a name.
void check_only_camera(const SceneDescription& scene, const std::string& asked, DiagnosticList& diagnostics) {
  std::string error;
  if (!find_camera(std::vector<std::string>(scene.camera ? 1 : 0), asked, error))
    diagnostics.error({}, error);
}

std::optional<SceneDescription> import_format(const ReadableFile& file, Diagnostics& diagnostics,
                                              const ImportOptions& options) {
  const std::filesystem::path& path = file.path();
  if (const std::string none = why_no_scene_in(file); !none.empty()) {
    diagnostics.error({}, fmt::format("cannot read \"{}\": {}", path.string(), none));
    return std::nullopt;
  }
  if (gltf::is_gltf(path)) return gltf::import_gltf(file, diagnostics, options);
  auto scene = is_obj(path)         ? import_obj(file, diagnostics)
               : is_lone_mesh(path) ? import_lone_mesh(file, diagnostics)
                                    : import_pbrt(file, diagnostics);
  if (scene && !options.view.camera.empty()) check_only_camera(*scene, options.view.camera, diagnostics);
  return scene;
}

// Limits the files that are read to those of --root. False, with an error, if there is no such folder.
bool set_root(const std::string& folder, Diagnostics& diagnostics) {
  if (folder.empty()) return true;
  try {
    diagnostics.files.root() = ReadRoot(folder, lies_outside(folder));
    return true;
  } catch (const FileError& error) {
    diagnostics.error({}, fmt::format("--root: cannot read the folder \"{}\": {}", folder, error.what()));
    return false;
  }
}

Convention convention_of(const std::filesystem::path& path) {
  const bool is_pbrt = !gltf::is_gltf(path) && !is_obj(path) && !is_lone_mesh(path);
  return is_pbrt ? Convention::kPbrt : Convention::kRightHanded;
}

}  // namespace

std::optional<SceneDescription> import_scene(const std::filesystem::path& path, Diagnostics& diagnostics,
                                             const ImportOptions& options) {
  if (!set_root(options.root, diagnostics)) return std::nullopt;
  diagnostics.files.root().set_room(options.room);
  auto scene = import_format(diagnostics.files.root().find(path), diagnostics, options);
  if (!scene) return std::nullopt;
  apply_view(*scene, options.view, convention_of(path), diagnostics);
  return scene;
}

void place_camera(const std::filesystem::path& path, const ViewOptions& options, SceneDescription* scene,
                  Diagnostics& diagnostics) {
  apply_camera(*scene, options, convention_of(path), diagnostics);
}

std::optional<LoadedScene> load_scene(const std::filesystem::path& path, Diagnostics& diagnostics,
                                      const ImportOptions& options) {
  auto description = import_scene(path, diagnostics, options);
  if (!description) return std::nullopt;
  NamedContents named;
  const auto load_with = [&](auto load) {
    return [&, load](const std::string& name, const SourceLocation& where) {
      const std::filesystem::path naming(where.valid() ? diagnostics.files.name(where.file) : path.string());
      const ReadableFile file = find_named_file(diagnostics.files.root(), name, naming, path);
      std::string content;
      auto result = load(file, &content);
      named.add(name, std::move(content), file.path());
      return result;
    };
  };
  const auto load_mesh = [colours = shows_vertex_colours(*description)](const ReadableFile& file,
                                                                        std::string* content) {
    return load_ply(file, content, colours);
  };
  SceneTextures textures(options.texture_pixels);
  const auto load_texture = [&](const std::string& name, const SourceLocation& where,
                                const ImageEncoding& encoding) {
    const auto load = [&](const ReadableFile& file, std::string* content) {
      return textures.load(file, encoding, content);
    };
    return load_with(load)(name, where);
  };
  auto scene = build_scene(*description, load_with(load_mesh), diagnostics, load_with(load_light_image),
                           {load_texture, [&] { return textures.library(); }});
  diagnostics.sort_by_location();
  if (!scene || diagnostics.has_errors()) return std::nullopt;
  scene->keeps = description->keeps;
  return LoadedScene{std::move(*scene), std::move(*description), content_hash(diagnostics.files, named),
                     files_read(diagnostics.files, named)};
}

}  // namespace kaustik::pbrt
