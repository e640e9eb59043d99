#include "apps/import/obj/obj_importer.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "apps/import/common/find_file.h"
#include "apps/import/common/no_scene.h"
#include "apps/import/common/scene_files.h"
#include "apps/import/obj/obj_materials.h"
#include "apps/import/obj/obj_meshes.h"
#include "apps/import/obj/obj_text.h"
#include "apps/import/obj/obj_triangles.h"
#include "core/text.h"

namespace kaustik {
namespace obj {
namespace {

namespace fs = std::filesystem;

constexpr uint64_t kLargestFile = uint64_t{1} << 34;

// Finds and reads the libraries that `mtllib` lines name.
class Libraries {
 public:
  Libraries(const fs::path& path, CountedWarnings& warnings, Diagnostics& diagnostics)
      : path_(path), folder_(path.parent_path()), warnings_(warnings), diagnostics_(diagnostics) {}

  // `names` is one name, perhaps with blanks, or several.
  void read(const std::string& names, const SourceLocation& where) {
    if (!said_.insert(names).second) return;
    if (const auto file = find(names)) return add(*file, where);
    Words words(names);
    size_t missing = 0;
    for (std::string_view name = words.next(); !name.empty(); name = words.next()) {
      const auto file = find(std::string(name));
      file ? add(*file, where) : void(++missing);
    }
    if (missing == 0) return;
    warnings_.say(where,
                  fmt::format("there is no material library \"{}\"{}", names.substr(0, 200), instead(where)));
  }

  std::vector<MtlMaterial> take() { return std::move(materials_); }

 private:
  std::optional<ReadableFile> find(const std::string& name) const {
    return find_file(diagnostics_.files.root(), name, std::array{folder_});
  }

  // What is done without the library: another one that is named as the OBJ file may stand in.
  std::string instead(const SourceLocation& where) {
    const auto file = materials_.empty() ? find(path_.stem().string() + ".mtl") : std::nullopt;
    if (!file || file->refused()) return "; its materials become grey";
    add(*file, where);
    return fmt::format("; \"{}\" is read instead", file->path().filename().string());
  }

  void add(const ReadableFile& file, const SourceLocation& where) {
    std::string error;
    if (file.refused()) {
      pbrt::read_bytes(file, kLargestFile, error);
      return diagnostics_.error(where, error);
    }
    std::error_code ignored;
    if (!read_.insert(fs::weakly_canonical(file.place(), ignored)).second) return;
    auto text = pbrt::read_bytes(file, kLargestFile, error);
    if (!text) return warnings_.say(where, error + "; its materials become grey");
    if (!is_mtl(*text))
      return warnings_.say(where, fmt::format("\"{}\" is not a material library: its materials become grey",
                                              file.path().string()));
    const uint32_t id = diagnostics_.files.add(file.path().string(), std::move(*text));
    const std::array folders{file.path().parent_path(), folder_};
    for (MtlMaterial& mtl : read_mtl(id, folders, warnings_, diagnostics_))
      materials_.push_back(std::move(mtl));
  }

  fs::path path_, folder_;
  CountedWarnings& warnings_;
  Diagnostics& diagnostics_;
  std::set<std::string> said_;
  std::set<fs::path> read_;
  std::vector<MtlMaterial> materials_;
};

// Builds the scene of an OBJ file that was read.
class ObjScene {
 public:
  ObjScene(ObjText& text, const std::vector<MtlMaterial>& library, const SourceLocation& file,
           CountedWarnings& warnings, Diagnostics& diagnostics)
      : text_(text),
        file_(file),
        warnings_(warnings),
        materials_(warnings, diagnostics.files, scene_, !text.colours.empty()) {
    scene_.location = file;
    for (const MtlMaterial& mtl : library) library_.try_emplace(mtl.name, &mtl);
  }

  SceneDescription run() {
    const std::vector<ObjMesh> meshes = meshes_of(text_, file_);
    add_smooth_normals(text_, meshes);
    MeshMaker maker(text_);
    for (const ObjMesh& mesh : meshes) {
      ShapeDescription shape = maker.make(mesh, warnings_);
      shape.name = mesh.name;
      const MtlLook& look = look_of(mesh);
      shape.material = {std::nullopt, look.material, mesh.material_where};
      shape.area_light = look.area_light;
      if (look.alpha) shape.parameters.push_back(*look.alpha);
      scene_.shapes.push_back(std::move(shape));
    }
    return std::move(scene_);
  }

 private:
  // The look of the mesh's material, made when it is first used: what no face uses is left out.
  const MtlLook& look_of(const ObjMesh& mesh) {
    const auto [at, is_new] = looks_.try_emplace(mesh.material);
    if (!is_new) return at->second;
    const auto found = library_.find(mesh.material);
    if (found == library_.end() && !mesh.material.empty())
      warnings_.say_one_of("unknown material", mesh.material_where, unknown(mesh.material));
    MtlMaterial grey;
    grey.name = mesh.material.empty() ? "default" : mesh.material;
    grey.where = mesh.material_where;
    return at->second = materials_.add(found == library_.end() ? grey : *found->second);
  }

  std::string unknown(const std::string& name) const {
    if (library_.empty()) return "no material library was read: all materials are grey";
    return fmt::format("no library has a material `{}`: grey is used", name.substr(0, 100));
  }

  ObjText& text_;
  SourceLocation file_;
  CountedWarnings& warnings_;
  SceneDescription scene_;
  MtlMaterials materials_;
  std::map<std::string, const MtlMaterial*> library_;
  std::map<std::string, MtlLook> looks_;
};

// Reads the text into triangles. Nothing, with an error, when that fails.
std::optional<ObjText> read_triangles(uint32_t file, CountedWarnings& warnings, Diagnostics& diagnostics) {
  auto text = read_obj(diagnostics.files.text(file), file, diagnostics);
  if (!text) return std::nullopt;
  cut_into_triangles(*text, {file, 0, 0});
  bool any = false;
  for (const ObjPart& part : text->parts) {
    any = any || part.corners.size() > 0;
    warnings.append(part.warnings);
  }
  if (any) return text;
  diagnostics.error({file, 0, 0}, "there are no faces in this file");
  return std::nullopt;
}

}  // namespace
}  // namespace obj

bool is_obj(const std::filesystem::path& path) {
  return lower_extension(path) == ".obj";
}

std::optional<SceneDescription> import_obj(const ReadableFile& readable, Diagnostics& diagnostics) {
  const std::filesystem::path& path = readable.path();
  std::string error;
  auto bytes = pbrt::read_bytes(readable, obj::kLargestFile, error);
  if (!bytes) {
    diagnostics.error({}, error);
    return std::nullopt;
  }
  if (is_binary(*bytes)) {
    diagnostics.error({}, fmt::format("cannot read \"{}\": it is a binary file, but OBJ files are plain text",
                                      path.string()));
    return std::nullopt;
  }
  // Line ends of the old Macintosh.
  if (bytes->find('\n') == bytes->npos) std::replace(bytes->begin(), bytes->end(), '\r', '\n');
  const SourceLocation file{diagnostics.files.add(path.string(), std::move(*bytes)), 0, 0};
  CountedWarnings warnings;
  auto text = obj::read_triangles(file.file, warnings, diagnostics);
  if (!text) {
    warnings.report(diagnostics);
    return std::nullopt;
  }
  obj::Libraries libraries(path, warnings, diagnostics);
  for (const obj::ObjPart& part : text->parts)
    for (const obj::StateChange& change : part.changes)
      if (change.kind == obj::StateChange::Kind::kLibrary) libraries.read(change.name, change.where);
  const std::vector<obj::MtlMaterial> library = libraries.take();
  SceneDescription scene = obj::ObjScene(*text, library, file, warnings, diagnostics).run();
  warnings.report(diagnostics);
  return scene;
}

}  // namespace kaustik
