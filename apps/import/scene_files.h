#pragma once
// Finding and reading scene files.

#include <filesystem>
#include <map>
#include <optional>
#include <string>

#include "core/diagnostics/diagnostics.h"

namespace kaustik::pbrt {

// Where a file that is named in a scene lies: beside the file that names it, else beside the main file
// (pbrt's rule), unless absolute. What does not exist is taken to be beside the file that names it.
std::filesystem::path resolve_path(const std::string& name, const std::filesystem::path& naming_file,
                                   const std::filesystem::path& main_file);

// Reads each file once, however often it is included.
class SceneFiles {
 public:
  explicit SceneFiles(SourceFiles& files) : files_(files) {}

  // The id of the file, or a sentence why it cannot be read in `error`.
  std::optional<uint32_t> open(const std::filesystem::path& path, std::string& error);

 private:
  SourceFiles& files_;
  std::map<std::string, uint32_t> by_canonical_path_;
};

// The bytes of a regular file of at most max_bytes; else why not in `error`.
std::optional<std::string> read_bytes(const std::filesystem::path& path, uint64_t max_bytes,
                                      std::string& error);

}  // namespace kaustik::pbrt
