#pragma once
#include <filesystem>

#include "core/files/file_error.h"

namespace kaustik {

struct FileBusy : FileError {
  FileBusy() : FileError("another process is writing it") {}
};

// A lock that only one process at a time holds. It is made of a file, which stands beside what is locked and
// which the destructor removes: files that are replaced by each write cannot be locked themselves. A process
// that is killed holds no lock. Where the file system has no locks, this has no effect.
class FileLock {
 public:
  // Makes the lock's file. Throws FileBusy if another process holds the lock, and other FileErrors if
  // the file cannot be made.
  explicit FileLock(std::filesystem::path path);
  FileLock(const FileLock&) = delete;
  FileLock& operator=(const FileLock&) = delete;
  ~FileLock();

 private:
  std::filesystem::path path_;
  int file_ = -1;
};

}  // namespace kaustik
