// Implemented with POSIX.

#include "core/files/disk_file.h"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>

namespace kaustik {

namespace {

[[noreturn]] void fail() {
  throw FileError(std::strerror(errno));
}

}  // namespace

DiskFile::DiskFile(const std::string& path) : file_(std::fopen(path.c_str(), "wb")) {
  if (!file_) fail();
}

void DiskFile::put(const void* bytes, size_t size) {
  if (std::fwrite(bytes, 1, size, file_.get()) != size) fail();
}

void DiskFile::finish() {
  if (std::fflush(file_.get()) != 0 || fsync(fileno(file_.get())) != 0) fail();
  // Some file systems, NFS among them, report only here that the disk is full.
  if (std::fclose(file_.release()) != 0) fail();
}

void check_regular(const std::string& path) {
  std::error_code error;
  if (std::filesystem::exists(path, error) && !std::filesystem::is_regular_file(path, error))
    throw FileError("not a regular file");
}

MappedFile::MappedFile(const std::string& path) {
  check_regular(path);
  const int file = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (file < 0) fail();
  struct stat status {};
  void* data = MAP_FAILED;
  if (::fstat(file, &status) == 0 && status.st_size > 0)
    data = ::mmap(nullptr, size_t(status.st_size), PROT_READ, MAP_SHARED, file, 0);
  const int error = errno;
  ::close(file);
  if (status.st_size == 0) return;
  errno = error;
  if (data == MAP_FAILED) fail();
  bytes_ = {static_cast<const std::byte*>(data), size_t(status.st_size)};
}

MappedFile::~MappedFile() {
  if (!bytes_.empty()) ::munmap(const_cast<std::byte*>(bytes_.data()), bytes_.size());
}

}  // namespace kaustik
