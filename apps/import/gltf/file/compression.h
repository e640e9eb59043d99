#pragma once
// Decodes the compressed meshes of glTF files: EXT_meshopt_compression by meshoptimizer,
// KHR_draco_mesh_compression by Draco.

#include <memory>
#include <string>
#include <string_view>

#include "apps/import/gltf/file/json_view.h"

namespace kaustik::gltf {

// The numbers of an accessor, element by element.
struct Elements {
  uint64_t count = 0;
  int components = 0;  // numbers per element; 3 for VEC3
  std::vector<double> values;
};

// The bytes of a buffer view from those that EXT_meshopt_compression stores. `extension`: the extension's
// object, with `byteStride`, `count`, `mode` and `filter`. Throws FormatError.
std::string decode_meshopt(const View& extension, std::string_view bytes);

// A primitive of KHR_draco_mesh_compression.
class DracoMesh {
 public:
  // Throws FormatError, at `extension`.
  DracoMesh(const View& extension, std::string_view bytes);
  ~DracoMesh();
  DracoMesh(const DracoMesh&) = delete;
  DracoMesh& operator=(const DracoMesh&) = delete;

  Elements indices() const;
  // The values of the attribute of this id as they are stored: integers are not normalised. Throws
  // FormatError, at `attribute`, when there is no such attribute.
  Elements values(const View& attribute, uint64_t id) const;

 private:
  struct Decoded;
  std::unique_ptr<Decoded> decoded_;
};

}  // namespace kaustik::gltf
