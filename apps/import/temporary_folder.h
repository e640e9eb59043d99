#pragma once
// A folder for what a scene file holds within itself and only files can hand over.

#include <filesystem>

namespace kaustik {

// Made below the system's folder for temporary files, and removed with all that is in it.
class TemporaryFolder {
 public:
  TemporaryFolder();  // throws std::filesystem::filesystem_error
  ~TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

}  // namespace kaustik
