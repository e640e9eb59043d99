#include "apps/import/obj/obj_importer.h"

#include <assimp/DefaultIOSystem.h>
#include <assimp/MemoryIOWrapper.h>
#include <assimp/config.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <fmt/format.h>

#include <assimp/Importer.hpp>
#include <iterator>
#include <sstream>

#include "apps/import/common/make_parameter.h"
#include "apps/import/common/scene_files.h"
#include "apps/import/obj/obj_materials.h"

namespace kaustik {
namespace {

constexpr uint64_t kLargestFile = uint64_t{1} << 34;

// Gives assimp an OBJ file and its material libraries, rewritten by clean_mtl.
class ObjFiles : public Assimp::DefaultIOSystem {
 public:
  // Reads the OBJ file and its material libraries into diagnostics.files, so that they count in the scene's
  // content hash. A missing library gives a warning. False, with an error, when the OBJ file cannot be read.
  bool read(const std::filesystem::path& path, Diagnostics& diagnostics) {
    std::string error;
    auto text = pbrt::read_bytes(path, kLargestFile, error);
    if (!text) {
      diagnostics.error({}, error);
      return false;
    }
    const uint32_t file = diagnostics.files.add(path.string(), std::move(*text));
    FileWarnings warnings({file, 0, 0}, diagnostics);
    std::istringstream lines{std::string(diagnostics.files.text(file))};
    uint32_t number = 0;
    for (std::string line; std::getline(lines, line);) {
      ++number;
      if (!line.starts_with("mtllib ")) continue;
      const std::string names = line.substr(7, line.find_last_not_of(" \t\r") - 6);
      for (const std::string& name : libraries_of(names, path.parent_path()))
        add_library(path, name, {file, number, 8}, warnings, diagnostics);
    }
    return true;
  }

  // Any file but the OBJ is a material library: assimp gets the text of all libraries whichever it asks for.
  Assimp::IOStream* Open(const char* file, const char* mode) override {
    if (is_obj(file)) return DefaultIOSystem::Open(file, mode);
    return new Assimp::MemoryIOStream(reinterpret_cast<const uint8_t*>(materials_.data()), materials_.size());
  }
  bool Exists(const char* file) const override { return !is_obj(file) || DefaultIOSystem::Exists(file); }
  const MapOptionsOf& options() const { return options_; }

 private:
  // The names after `mtllib`: one name with blanks if such a file exists, else several names.
  static std::vector<std::string> libraries_of(const std::string& names,
                                               const std::filesystem::path& folder) {
    std::error_code ignored;
    if (std::filesystem::exists(folder / names, ignored)) return {names};
    std::istringstream words(names);
    std::vector<std::string> out{std::istream_iterator<std::string>(words), {}};
    const bool any = std::any_of(out.begin(), out.end(), [&](const std::string& name) {
      return std::filesystem::exists(folder / name, ignored);
    });
    return any ? out : std::vector<std::string>{names};
  }

  void add_library(const std::filesystem::path& path, const std::string& name, const SourceLocation& where,
                   FileWarnings& warnings, Diagnostics& diagnostics) {
    std::string error;
    auto text = pbrt::read_bytes(path.parent_path() / name, kLargestFile, error);
    if (!text) return diagnostics.warning(where, fmt::format("{}; its materials become grey", error));
    materials_ += clean_mtl(*text, path.parent_path(), warnings, options_);
    diagnostics.files.add((path.parent_path() / name).string(), std::move(*text));
  }

  std::string materials_;
  MapOptionsOf options_;
};

std::vector<double> triples(const aiVector3D* v, unsigned n) {
  std::vector<double> out;
  out.reserve(3 * size_t(n));
  for (unsigned i = 0; i < n; ++i) out.insert(out.end(), {double(v[i].x), double(v[i].y), double(v[i].z)});
  return out;
}

bool all_finite(const std::vector<double>& values) {
  return std::all_of(values.begin(), values.end(), [](double v) { return std::isfinite(v); });
}

// Takes the IO handler back from the importer, which would otherwise delete it.
struct Borrowed {
  Assimp::Importer& importer;
  ~Borrowed() { importer.SetIOHandler(nullptr); }
};

class ObjScene {
 public:
  ObjScene(const aiScene& in, const MapOptionsOf& options, std::filesystem::path folder, uint32_t file,
           Diagnostics& diagnostics)
      : in_(in),
        options_(options),
        folder_(std::move(folder)),
        warnings_({file, 0, 0}, diagnostics),
        diagnostics_(diagnostics) {
    scene_.location = warnings_.where();
  }

  SceneDescription run() {
    for (unsigned i = 0; i < in_.mNumMaterials; ++i) add_material(i);
    for (unsigned i = 0; i < in_.mNumMeshes; ++i) add_mesh(*in_.mMeshes[i]);
    if (scene_.shapes.empty() && !diagnostics_.has_errors())
      diagnostics_.error(warnings_.where(), "there are no faces in this file");
    return std::move(scene_);
  }

 private:
  void add_material(unsigned index) {
    const aiMaterial& mtl = *in_.mMaterials[index];
    const MtlContext context{options_, folder_, warnings_, scene_};
    MaterialDescription m = material_of_mtl(mtl, context);
    aiString name;
    mtl.Get(AI_MATKEY_NAME, name);
    m.name = fmt::format("{} {}", name.C_Str(), index);
    m.name_location = warnings_.where();
    names_.push_back(m.name);
    scene_.materials.push_back(std::move(m));
    alphas_.push_back(alpha_of_mtl(mtl, context));
    auto light = light_of_mtl(mtl, warnings_.where());
    lights_.push_back(std::nullopt);
    if (!light) return;
    lights_.back() = static_cast<uint32_t>(scene_.area_lights.size());
    scene_.area_lights.push_back(std::move(*light));
  }

  void add_mesh(const aiMesh& mesh) {
    DirectiveMaker<ShapeDescription> shape("trianglemesh", warnings_.where());
    std::vector<double> P = triples(mesh.mVertices, mesh.mNumVertices), corners;
    for (unsigned f = 0; f < mesh.mNumFaces; ++f) {
      const aiFace& face = mesh.mFaces[f];
      for (unsigned k = 0; face.mNumIndices == 3 && k < 3; ++k) corners.push_back(double(face.mIndices[k]));
    }
    if (corners.empty()) return;
    if (!all_finite(P))
      return diagnostics_.error(
          warnings_.where(),
          fmt::format("object `{}` has a position that is not finite", mesh.mName.C_Str()));
    shape.add(ParameterType::kPoint3, "P", std::move(P));
    shape.add(ParameterType::kInteger, "indices", std::move(corners));
    if (mesh.HasNormals()) {
      std::vector<double> N = triples(mesh.mNormals, mesh.mNumVertices);
      if (all_finite(N)) shape.add(ParameterType::kNormal, "N", std::move(N));
    }
    add_uv(mesh, shape);
    if (mesh.mMaterialIndex < names_.size()) {
      const size_t m = mesh.mMaterialIndex;
      shape->material = {std::nullopt, names_[m], warnings_.where()};
      shape->area_light = lights_[m];
      if (alphas_[m]) shape.add(*alphas_[m]);
    }
    scene_.shapes.push_back(std::move(*shape));
  }

  static void add_uv(const aiMesh& mesh, DirectiveMaker<ShapeDescription>& shape) {
    if (!mesh.HasTextureCoords(0)) return;
    std::vector<double> uv;
    for (unsigned i = 0; i < mesh.mNumVertices; ++i) {
      const aiVector3D& t = mesh.mTextureCoords[0][i];
      uv.insert(uv.end(), {double(t.x), double(t.y)});
    }
    if (all_finite(uv)) shape.add(ParameterType::kPoint2, "uv", std::move(uv));
  }

  const aiScene& in_;
  const MapOptionsOf& options_;
  std::filesystem::path folder_;
  SceneDescription scene_;
  FileWarnings warnings_;
  Diagnostics& diagnostics_;
  std::vector<std::string> names_;
  std::vector<std::optional<Parameter>> alphas_;
  std::vector<std::optional<uint32_t>> lights_;
};

}  // namespace

bool is_obj(const std::filesystem::path& path) {
  std::string extension = path.extension().string();
  for (char& c : extension) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return extension == ".obj";
}

std::optional<SceneDescription> import_obj(const std::filesystem::path& path, Diagnostics& diagnostics) {
  const auto file = static_cast<uint32_t>(diagnostics.files.size());
  ObjFiles files;
  if (!files.read(path, diagnostics)) return std::nullopt;
  Assimp::Importer importer;
  importer.SetIOHandler(&files);
  importer.SetPropertyInteger(AI_CONFIG_PP_SBP_REMOVE, aiPrimitiveType_POINT | aiPrimitiveType_LINE);
  const Borrowed borrowed{importer};
  const aiScene* in = importer.ReadFile(
      path.string(), aiProcess_Triangulate | aiProcess_JoinIdenticalVertices | aiProcess_SortByPType);
  if (!in) {
    diagnostics.error({file, 0, 0}, fmt::format("cannot read this file: {}", importer.GetErrorString()));
    return std::nullopt;
  }
  SceneDescription scene = ObjScene(*in, files.options(), path.parent_path(), file, diagnostics).run();
  if (diagnostics.has_errors()) return std::nullopt;
  return scene;
}

}  // namespace kaustik
