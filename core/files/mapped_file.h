#pragma once
// Files that are mapped into memory.

#include <cstddef>
#include <span>
#include <string>

#include "core/files/file_error.h"

namespace kaustik {

// The contents of a file as they lie on the disk: pages are read when they are touched, and processes that
// map the same file share them. A file must not be changed in place while it is mapped; one that takes its
// name does no harm.
class MappedFile {
 public:
  // Throws FileError.
  explicit MappedFile(const std::string& path);
  ~MappedFile();
  MappedFile(const MappedFile&) = delete;
  MappedFile& operator=(const MappedFile&) = delete;

  std::span<const std::byte> bytes() const { return bytes_; }

 private:
  std::span<const std::byte> bytes_;
};

}  // namespace kaustik
