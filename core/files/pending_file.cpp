// Renames or removes a temporary file, and chooses its name.

#include "core/files/pending_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstring>

namespace kaustik {

namespace fs = std::filesystem;

namespace {

// Writes all bytes, in as many calls as the system needs. False on failure, with errno set.
bool write_all(int file, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(file, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) return false;
    bytes.remove_prefix(size_t(written));
  }
  return true;
}

}  // namespace

PendingFile::~PendingFile() {
  std::error_code ignored;
  if (!done_) fs::remove(temporary_, ignored);
}

std::string PendingFile::commit() {
  std::error_code error;
  fs::rename(temporary_, final_, error);
  done_ = !error;
  return error ? "cannot rename the finished file: " + error.message() : std::string();
}

std::string write_in_place(const fs::path& path, std::string_view bytes) {
  const int file = ::open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
  if (file < 0) return std::strerror(errno);
  int error = write_all(file, bytes) ? 0 : errno;
  // Some file systems, NFS among them, report only here that the disk is full.
  if (::close(file) != 0 && error == 0 && errno != EINTR) error = errno;
  return error == 0 ? std::string() : std::strerror(error);
}

std::string write_file(const fs::path& path, std::string_view bytes) {
  PendingFile file(path, unique_temporary_name(path));
  if (std::string error = write_in_place(file.temporary(), bytes); !error.empty()) return error;
  return file.commit();
}

fs::path unique_temporary_name(const fs::path& path) {
  static std::atomic<uint64_t> counter{0};
  const std::string name = fmt::format(".{}.{}-{}.partial{}", path.stem().string(), ::getpid(), counter++,
                                       path.extension().string());
  return path.parent_path() / name;
}

}  // namespace kaustik
