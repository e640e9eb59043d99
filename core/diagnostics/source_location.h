#pragma once
// Where a value was written. A location is kept with every value of a scene description, so that any later
// stage can point to it.

#include <cstdint>

namespace kaustik {

inline constexpr uint32_t kNoFile = 0xffffffffu;

// Line and column, counted from one; a column counts bytes. Line zero means the whole file.
struct LineColumn {
  uint32_t line = 0, column = 0;
};

// file: id returned by SourceFiles::add; kNoFile if there is no file (a default value, the command line).
struct SourceLocation {
  uint32_t file = kNoFile;
  uint32_t line = 0, column = 0;

  bool valid() const { return file != kNoFile; }
};

}  // namespace kaustik
