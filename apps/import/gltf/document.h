#pragma once
// Reads a glTF 2.0 file: its JSON and the buffers that it names. All sizes are checked against the files'
// lengths before memory is allocated for them.

#include <filesystem>
#include <memory>
#include <string_view>
#include <vector>

#include "apps/import/gltf/json_view.h"
#include "core/diagnostics/diagnostics.h"

namespace kaustik::gltf {

// The numbers of an accessor, element by element.
struct Elements {
  uint64_t count = 0;
  int components = 0;  // numbers per element; 3 for VEC3
  std::vector<double> values;
};

class Document {
 public:
  // Reads a .gltf or .glb file and the buffers that it names. They are added to `files`, so that they count
  // in the scene's content hash. Throws FormatError.
  Document(const std::filesystem::path& path, SourceFiles& files);

  View root() const { return {*json_, ""}; }
  // An item of a top-level list, such as item("nodes", 3).
  View item(const char* list, uint64_t i) const { return root()[list].at(i); }
  uint64_t size(const char* list) const { return root()[list].size(); }
  uint32_t file() const { return file_; }

  // The numbers of an accessor; normalised integers are scaled to [0, 1] or [-1, 1]. `components`: the
  // expected numbers per element. Throws FormatError, also for numbers that are not finite.
  Elements elements(uint64_t accessor, int components) const;
  std::string_view bytes_of_view(uint64_t buffer_view) const;
  // The decoded data of a `data:` URI; nothing if the URI names a file.
  static std::optional<std::string> data_of_uri(const View& uri);
  // The file name that a URI gives, with escapes such as %20 resolved.
  static std::string file_of_uri(const std::string& uri);

 private:
  void read_json(std::string_view bytes);
  void read_container(std::string_view bytes);
  void read_buffers(const std::filesystem::path& path, SourceFiles& files);
  void apply_sparse(const View& accessor, Elements& out) const;
  void decode(std::string_view bytes, uint64_t offset, uint64_t stride, const View& accessor,
              Elements& out) const;

  std::shared_ptr<const Json> json_;
  uint32_t file_ = 0;
  std::string_view binary_;  // the binary chunk of a .glb
  bool has_binary_ = false;
  std::vector<std::string_view> buffers_;  // views into the files' texts
};

}  // namespace kaustik::gltf
