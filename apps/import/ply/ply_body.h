#pragma once
// Reads the elements of a PLY file in two steps: walk_ply finds where blocks of elements begin, then
// read_ply_block reads the blocks, which may happen in parallel.

#include <functional>

#include "apps/import/ply/ply_header.h"

namespace kaustik::pbrt {

// Elements [first, end), which begin at byte `begin`.
struct PlyBlock {
  uint64_t first = 0, end = 0;
  size_t begin = 0;
  uint64_t triangles = 0;  // that the faces before this block yield
};

struct PlyExtent {
  std::vector<PlyBlock> blocks;
  uint64_t triangles = 0;  // that all faces yield: corners - 2 each
  size_t end = 0;          // the byte after the last element
};

// Finds the blocks of an element that begins at byte `begin`. Nothing, with a message in `error`, when the
// file ends early, a list has a negative length or a face has fewer than three corners.
std::optional<PlyExtent> walk_ply(std::string_view bytes, const PlyHeader& header, size_t element,
                                  size_t begin, std::string& error);

// The values of one element; reused from element to element.
struct PlyValues {
  std::vector<double> scalars;   // by property; list properties leave theirs unset
  std::vector<int64_t> indices;  // entries of the requested list
  size_t position = 0;           // byte where the element begins
  uint64_t number = 0;           // 0-based
};
// Reads a block that walk_ply found and calls take(values) for each element, until it returns an error.
// `list`: index of the list property whose entries are wanted, or nothing. Returns an error message, empty on
// success.
std::string read_ply_block(std::string_view bytes, const PlyHeader& header, size_t element,
                           const PlyBlock& block, std::optional<size_t> list,
                           const std::function<std::string(const PlyValues&)>& take);

}  // namespace kaustik::pbrt
