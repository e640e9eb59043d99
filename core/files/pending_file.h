#pragma once
// A file that appears under its name only when it is complete.

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string_view>
#include <vector>

#include "core/files/file_error.h"

namespace kaustik {

// Is written without a name where the file system allows it (O_TMPFILE): then nothing is left even of a
// process that is killed. Elsewhere, and just before it replaces an existing file, it has a temporary name
// beside the final one, which no other process can know or have planted (O_EXCL). Without commit() the
// destructor removes it, and an existing file of the final name is left untouched. All functions but the
// destructor throw FileError with the system's reason.
class PendingFile {
 public:
  explicit PendingFile(std::filesystem::path final_name);
  PendingFile(PendingFile&&) = delete;
  ~PendingFile();

  void write(const void* bytes, size_t size);
  void write(std::string_view text) { write(text.data(), text.size()); }
  // The next byte is written there; bytes from 0.
  void seek(uint64_t position);
  uint64_t position() const { return position_; }

  // Waits until the file is on the disk, checks its size and closes it. It then waits under its temporary
  // name.
  void finish();
  // Gives the file its final name, after finish() if that was not called. An existing file is replaced.
  void commit();

 private:
  void open();
  void write_through(const char* bytes, size_t size);
  void flush();
  // Waits until all bytes are on the disk.
  void complete();
  void wait_under_temporary_name();
  void close();

  std::filesystem::path final_, temporary_;
  int file_ = -1;
  bool named_ = false;  // the temporary name exists
  std::vector<char> buffer_;
  uint64_t position_ = 0, size_ = 0;
};

// Writes the bytes to a PendingFile and commits it. Throws FileError.
void write_file(const std::filesystem::path& path, std::string_view bytes);

// Removes what processes that were killed have left of files of this name. No other process may be writing
// it.
void remove_leftovers(const std::filesystem::path& path);
// Removes those of all files in the folder, into which no other process may be writing.
void remove_all_leftovers(const std::filesystem::path& folder);

}  // namespace kaustik
