#pragma once
// A temporary folder for images that a scene file embeds: image readers take file names only.

#include <filesystem>

namespace kaustik {

// Created in the system's folder for temporary files; the destructor removes it with all its contents.
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
