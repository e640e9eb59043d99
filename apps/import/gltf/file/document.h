#pragma once
// Reads a glTF 2.0 file: its JSON and the buffers that it names. All sizes are checked against the files'
// lengths before memory is allocated for them.

#include <filesystem>
#include <map>
#include <memory>
#include <string_view>
#include <vector>

#include "apps/import/gltf/file/compression.h"
#include "core/diagnostics/diagnostics.h"

namespace kaustik::gltf {

class Document {
 public:
  // Reads a .gltf or .glb file and the buffers that it names. They are added to `files`, so that they count
  // in the scene's content hash. Throws FormatError.
  Document(const ReadableFile& file, SourceFiles& files);

  View root() const { return {*json_, ""}; }
  // An item of a top-level list, such as item("nodes", 3).
  View item(const char* list, uint64_t i) const { return root()[list].at(i); }
  uint64_t size(const char* list) const { return root()[list].size(); }
  uint32_t file() const { return file_; }

  // The numbers of an accessor; normalised integers are scaled to [0, 1] or [-1, 1]. `components`: the
  // expected numbers per element. Throws FormatError, also for numbers that are not finite, unless `any` is
  // set.
  Elements elements(uint64_t accessor, int components, bool any = false) const;
  // The number of elements, and of numbers per element.
  uint64_t count(uint64_t accessor) const;
  int components(uint64_t accessor) const;
  // Decodes the primitive if it is compressed by KHR_draco_mesh_compression: from then on its accessors have
  // the decoded numbers. Throws FormatError.
  void decompress(const View& primitive);
  // The bytes of a view, decoded if EXT_meshopt_compression compresses it.
  std::string_view bytes_of_view(uint64_t buffer_view) const;
  // The decoded data of a `data:` URI; nothing if the URI names a file.
  static std::optional<std::string> data_of_uri(const View& uri);
  // The file name that a URI gives, with escapes such as %20 resolved.
  static std::string file_of_uri(const std::string& uri);

 private:
  void read_json(std::string_view bytes);
  void read_container(std::string_view bytes);
  void read_buffers(const std::filesystem::path& path, SourceFiles& files);
  Elements read(uint64_t index, const View& accessor, int components) const;
  std::string_view bytes_in_buffer(const View& place) const;
  void apply_sparse(const View& accessor, Elements& out) const;
  void decode(std::string_view bytes, uint64_t offset, uint64_t stride, const View& accessor,
              Elements& out) const;

  std::shared_ptr<const Json> json_;
  uint32_t file_ = 0;
  std::string_view binary_;  // the binary chunk of a .glb
  bool has_binary_ = false;
  std::vector<std::string_view> buffers_;             // views into the files' texts
  std::map<uint64_t, Elements> decoded_;              // by accessor, from Draco
  mutable std::map<uint64_t, std::string> unpacked_;  // by buffer view, from meshopt
};

}  // namespace kaustik::gltf
