#pragma once
// A temporary folder, for libraries that take file names only.

#include <filesystem>

namespace kaustik {

// Created in the folder that the variable TMPDIR names, or else in /tmp. The destructor removes it with all
// its contents.
class TemporaryFolder {
 public:
  TemporaryFolder();  // throws std::runtime_error
  ~TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

}  // namespace kaustik
