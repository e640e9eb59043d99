#pragma once
// Where a value was written. Kept with every value of a scene description, so that any later stage can point
// at it.

#include <cstdint>

namespace kaustik {

inline constexpr uint32_t kNoFile = 0xffffffffu;

// Both count from one; a column counts bytes. Zero: the whole file.
struct LineColumn {
  uint32_t line = 0, column = 0;
};

// file: id given by SourceFiles::add. kNoFile: no place (a default, the command line).
struct SourceLocation {
  uint32_t file = kNoFile;
  uint32_t line = 0, column = 0;

  bool valid() const { return file != kNoFile; }
};

}  // namespace kaustik
