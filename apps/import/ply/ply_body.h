#pragma once
// The elements of a PLY file. First a walk that stores where blocks of elements begin, so that then the
// blocks can be read in parallel.

#include <functional>

#include "apps/import/ply/ply_header.h"

namespace kaustik::pbrt {

// Elements [first, end), which begin at byte `begin`.
struct PlyBlock {
  uint64_t first = 0, end = 0;
  size_t begin = 0;
  uint64_t triangles = 0;  // of faces before the block
};

struct PlyExtent {
  std::vector<PlyBlock> blocks;
  uint64_t triangles = 0;  // of faces: corners less two
  size_t end = 0;          // byte behind the last element
};

// Finds the blocks of an element that begins at byte `begin`. Nothing, with an error, when the file ends
// early, a list has a negative length or a face fewer than three corners.
std::optional<PlyExtent> walk_ply(std::string_view bytes, const PlyHeader& header, size_t element,
                                  size_t begin, std::string& error);

// The values of one element after the other; lists hold theirs.
struct PlyValues {
  std::vector<double> scalars;   // by property; unused for lists
  std::vector<int64_t> indices;  // of the list that was asked for
  size_t position = 0;           // where the element begins
  uint64_t number = 0;
};
// Reads a block that walk_ply found and calls take(values) for each element, until it returns an error.
// list: index of the property whose entries are wanted, or nothing. Empty on success.
std::string read_ply_block(std::string_view bytes, const PlyHeader& header, size_t element,
                           const PlyBlock& block, std::optional<size_t> list,
                           const std::function<std::string(const PlyValues&)>& take);

}  // namespace kaustik::pbrt
