#pragma once
// Regular files that are read. Pipes and devices are refused at once: to open a pipe would wait for a
// writer, and to read a device might never end.

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>

#include "core/files/file_error.h"
#include "core/files/read_root.h"

namespace kaustik {

inline constexpr const char* kNotRegular = "not a regular file";

// All functions throw FileError.
class InputFile {
 public:
  explicit InputFile(const std::filesystem::path& path) : InputFile(ReadableFile::trusted(path)) {}
  explicit InputFile(const ReadableFile& file);
  InputFile(const InputFile&) = delete;
  InputFile& operator=(const InputFile&) = delete;
  ~InputFile();

  // Bytes, when the file was opened.
  uint64_t size() const { return size_; }
  int descriptor() const { return file_; }
  // Reads on from the position. Returns fewer than `size` bytes only at the end of the file.
  size_t read(void* bytes, size_t size);
  // The next byte that is read is the first.
  void rewind();

 private:
  int file_ = -1;
  uint64_t size_ = 0;
};

// The bytes of a file. Throws FileError, also for a file of more than most_bytes.
std::string read_file(const ReadableFile& file, uint64_t most_bytes);
inline std::string read_file(const std::filesystem::path& path, uint64_t most_bytes) {
  return read_file(ReadableFile::trusted(path), most_bytes);
}

// The first bytes of a file, at most `size`. Throws FileError.
std::string read_head(const ReadableFile& file, size_t size);

// Throws FileError for what exists and is no regular file, before a library opens it by its name. In the
// header for libraries that programs load, which have none of this folder's code.
inline void check_regular(const std::filesystem::path& path) {
  std::error_code error;
  if (std::filesystem::exists(path, error) && !std::filesystem::is_regular_file(path, error))
    throw FileError(kNotRegular);
}

}  // namespace kaustik
