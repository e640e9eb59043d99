// Renames or removes a temporary file, and chooses its name.

#include "core/files/pending_file.h"

#include <fmt/format.h>
#include <unistd.h>

#include <atomic>

namespace kaustik {

namespace fs = std::filesystem;

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

fs::path unique_temporary_name(const fs::path& path) {
  static std::atomic<uint64_t> counter{0};
  const std::string name = fmt::format(".{}.{}-{}.partial{}", path.stem().string(), ::getpid(), counter++,
                                       path.extension().string());
  return path.parent_path() / name;
}

}  // namespace kaustik
