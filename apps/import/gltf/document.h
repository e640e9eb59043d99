#pragma once
// A glTF 2.0 file: its JSON, and the bytes that it names. Everything is checked against what the files hold
// before memory is taken for it.

#include <filesystem>
#include <string_view>
#include <vector>

#include "apps/import/gltf/json_view.h"
#include "core/diagnostics/diagnostics.h"

namespace kaustik::gltf {

// One element after the other: VEC3 is three numbers an element.
struct Elements {
  uint64_t count = 0;
  int components = 0;
  std::vector<double> values;
};

class Document {
 public:
  // A .gltf or .glb file and the buffers that it names; they are added to `files`, so that they are part of
  // the scene's hash. Throws FormatError.
  Document(const std::filesystem::path& path, SourceFiles& files);

  View root() const { return {json_, ""}; }
  // An item of a top-level list: list("nodes", 3).
  View item(const char* list, uint64_t i) const { return root()[list].at(i); }
  uint64_t size(const char* list) const { return root()[list].size(); }
  uint32_t file() const { return file_; }

  // Numbers of an accessor; normalised integers become [0, 1] or [-1, 1]. components: what it must have.
  // Floats that are not finite are an error.
  Elements elements(uint64_t accessor, int components) const;
  std::string_view bytes_of_view(uint64_t buffer_view) const;
  // What a URI holds: data in the URI itself, or nothing for the name of a file.
  static std::optional<std::string> data_of_uri(const View& uri);
  // The name of a file that a URI gives, %20 and the like resolved.
  static std::string file_of_uri(const std::string& uri);

 private:
  void read_json(std::string_view bytes);
  void read_container(std::string_view bytes);
  void read_buffers(const std::filesystem::path& path, SourceFiles& files);
  void apply_sparse(const View& accessor, Elements& out) const;
  void decode(std::string_view bytes, uint64_t offset, uint64_t stride, const View& accessor,
              Elements& out) const;

  Json json_;
  uint32_t file_ = 0;
  std::string_view binary_;  // of a .glb
  bool has_binary_ = false;
  std::vector<std::string_view> buffers_;  // views into the files' texts
};

}  // namespace kaustik::gltf
