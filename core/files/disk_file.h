#pragma once
// Large binary files: written to the disk, and mapped into memory.

#include <cstddef>
#include <cstdio>
#include <memory>
#include <span>
#include <stdexcept>
#include <string>

namespace kaustik {

// what() is the reason alone, without the file's name.
struct FileError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

// A file that is replaced. All functions throw FileError with the system's reason.
class DiskFile {
 public:
  explicit DiskFile(const std::string& path);
  void put(const void* bytes, size_t size);
  // Waits until the file is on the disk.
  void finish();

 private:
  struct Closer {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };
  std::unique_ptr<std::FILE, Closer> file_;
};

// Throws FileError for what exists and is no regular file: to open a pipe would wait for a writer.
void check_regular(const std::string& path);

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
