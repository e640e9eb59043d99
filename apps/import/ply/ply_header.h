#pragma once
// The header of a PLY file (Turk 1994), and what of it a mesh needs.

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace kaustik::pbrt {

enum class PlyFormat { kAscii, kLittle, kBig };
enum class PlyType : uint8_t { kInt8, kUint8, kInt16, kUint16, kInt32, kUint32, kFloat, kDouble };
uint32_t size_of(PlyType type);
bool is_integer(PlyType type);

struct PlyProperty {
  std::string name;
  PlyType type = PlyType::kFloat;  // of the entries, for lists
  std::optional<PlyType> count;    // of lists
};

struct PlyElement {
  std::string name;
  uint64_t count = 0;
  std::vector<PlyProperty> properties;

  // Index of a property that is no list; nothing when absent.
  std::optional<size_t> find(std::string_view property) const;
  bool has_lists() const;
  // Index of the list of a face's vertices.
  std::optional<size_t> find_indices() const;
  // Bytes of an element whose lists are empty.
  uint64_t least_size() const;
};

struct PlyHeader {
  PlyFormat format = PlyFormat::kAscii;
  std::vector<PlyElement> elements;
  size_t vertex = 0, face = 0;  // indices of these elements
  size_t body = 0;              // where the elements begin
};

// "byte N: message".
std::string ply_error(size_t position, std::string_view message);

// Nothing, with an error, unless there are vertices with x, y, z and faces with indices, and no more of
// either than the file's size can hold.
std::optional<PlyHeader> read_ply_header(std::string_view bytes, std::string& error);

}  // namespace kaustik::pbrt
