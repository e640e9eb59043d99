#include "core/files/file_lock.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>

#include "core/files/system_calls.h"

namespace kaustik {

namespace {

// Whether the open file still has this name: whoever held the lock before may just have removed it.
bool is_named(int file, const std::filesystem::path& path) {
  struct stat opened {
  }, named{};
  return ::fstat(file, &opened) == 0 && ::stat(path.c_str(), &named) == 0 && opened.st_ino == named.st_ino &&
         opened.st_dev == named.st_dev;
}

}  // namespace

FileLock::FileLock(std::filesystem::path path) : path_(std::move(path)) {
  do {
    if (file_ >= 0) close_file(file_);
    file_ = open_file(path_.c_str(), O_RDWR | O_CREAT | O_NOFOLLOW, 0600);
    if (file_ < 0) throw_file_error(errno);
    if (::flock(file_, LOCK_EX | LOCK_NB) == 0) continue;
    if (errno != EWOULDBLOCK) return;  // the file system has no locks
    close_file(file_);
    throw FileBusy();
  } while (!is_named(file_, path_));
}

FileLock::~FileLock() {
  ::unlink(path_.c_str());
  close_file(file_);
}

}  // namespace kaustik
