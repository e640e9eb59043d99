#pragma once
// Reads the header of a PLY file (Turk 1994) and checks that it describes a mesh.

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
  PlyType type = PlyType::kFloat;  // for lists: the type of the entries
  std::optional<PlyType> count;    // for lists: the type of the length; scalars have none
};

struct PlyElement {
  std::string name;
  uint64_t count = 0;
  std::vector<PlyProperty> properties;

  // Index of a scalar property; nothing when absent.
  std::optional<size_t> find(std::string_view property) const;
  bool has_lists() const;
  // Index of the property that lists a face's vertices; nothing when absent.
  std::optional<size_t> find_indices() const;
  // Size in bytes of a binary element whose lists are empty.
  uint64_t least_size() const;
};

struct PlyHeader {
  PlyFormat format = PlyFormat::kAscii;
  std::vector<PlyElement> elements;
  size_t vertex = 0, face = 0;  // indices of these elements
  size_t body = 0;              // byte where the elements begin
};

// Formats an error as "byte N: message".
std::string ply_error(size_t position, std::string_view message);

// Reads the header. Nothing, with a message in `error`, unless it declares vertices with x, y, z and faces
// with indices, and no more elements than a file of this size can hold.
std::optional<PlyHeader> read_ply_header(std::string_view bytes, std::string& error);

}  // namespace kaustik::pbrt
