#include "apps/import/ply.h"

#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <fmt/format.h>

#include <assimp/Importer.hpp>

#include "apps/import/ply_structure.h"
#include "apps/import/scene_files.h"
#include "core/content_hash.h"

namespace kaustik::pbrt {
namespace {

constexpr uint64_t kLargestMeshFile = uint64_t{1} << 38;

// Before triangulation, which looks the vertices up.
std::string check_faces(const aiMesh& mesh) {
  for (unsigned f = 0; f < mesh.mNumFaces; ++f) {
    const aiFace& face = mesh.mFaces[f];
    for (unsigned k = 0; k < face.mNumIndices; ++k) {
      if (face.mIndices[k] >= mesh.mNumVertices) {
        return fmt::format("face {} has vertex {}: there are {} vertices", f,
                           static_cast<int32_t>(face.mIndices[k]), mesh.mNumVertices);
      }
    }
  }
  for (unsigned i = 0; i < mesh.mNumVertices; ++i) {
    const aiVector3D& p = mesh.mVertices[i];
    if (!is_finite(Point3(p.x, p.y, p.z))) return fmt::format("the position of vertex {} is not finite", i);
  }
  return {};
}

TriangleMesh converted(const aiMesh& in) {
  TriangleMesh out;
  out.P.reserve(in.mNumVertices);
  for (unsigned i = 0; i < in.mNumVertices; ++i) {
    out.P.emplace_back(in.mVertices[i].x, in.mVertices[i].y, in.mVertices[i].z);
  }
  if (in.HasNormals()) {
    for (unsigned i = 0; i < in.mNumVertices; ++i) {
      out.N.emplace_back(in.mNormals[i].x, in.mNormals[i].y, in.mNormals[i].z);
    }
  }
  if (in.HasTextureCoords(0)) {
    for (unsigned i = 0; i < in.mNumVertices; ++i) {
      out.uv.emplace_back(in.mTextureCoords[0][i].x, in.mTextureCoords[0][i].y);
    }
  }
  out.indices.reserve(in.mNumFaces);
  for (unsigned f = 0; f < in.mNumFaces; ++f) {
    const aiFace& face = in.mFaces[f];
    if (face.mNumIndices == 3) out.indices.push_back({face.mIndices[0], face.mIndices[1], face.mIndices[2]});
  }
  return out;
}

// assimp reads what check_ply found sound, as one mesh, without any of its clean-up steps.
MeshResult import(const std::string& bytes, const PlyStructure& structure) {
  Assimp::Importer importer;
  const aiScene* scene = importer.ReadFileFromMemory(bytes.data(), bytes.size(), 0, "ply");
  if (!scene) return {{}, importer.GetErrorString()};
  if (scene->mNumMeshes != 1 || scene->mMeshes[0]->mNumVertices != structure.vertices ||
      scene->mMeshes[0]->mNumFaces != structure.faces) {
    return {{}, "it holds more than one mesh, or elements that cannot be read"};
  }
  std::string error = check_faces(*scene->mMeshes[0]);
  if (!error.empty()) return {{}, std::move(error)};
  if (structure.polygons) scene = importer.ApplyPostProcessing(aiProcess_Triangulate);
  if (!scene) return {{}, importer.GetErrorString()};
  return {converted(*scene->mMeshes[0]), {}};
}

}  // namespace

MeshResult load_ply(const std::filesystem::path& path, std::string* content) {
  std::string error;
  const auto bytes = read_bytes(path, kLargestMeshFile, error);
  if (!bytes) return {{}, std::move(error)};
  if (content) {
    ContentHash hash;
    hash.add(*bytes);
    *content = hash.text();
  }
  const auto structure = check_ply(*bytes, error);
  MeshResult result = structure ? import(*bytes, *structure) : MeshResult{{}, std::move(error)};
  if (!result.error.empty())
    result.error = fmt::format("cannot read \"{}\": {}", path.string(), result.error);
  return result;
}

}  // namespace kaustik::pbrt
