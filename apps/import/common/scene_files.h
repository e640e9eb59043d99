#pragma once
// Finds and reads scene files.

#include <filesystem>
#include <map>
#include <optional>
#include <string>

#include "core/diagnostics/diagnostics.h"

namespace kaustik::pbrt {

// Finds the file that a scene names. An absolute name is taken as it is. A relative one is looked for beside
// the file that names it, then beside the main file (pbrt's rule). If neither exists, the path beside the
// naming file is returned.
std::filesystem::path resolve_path(const std::string& name, const std::filesystem::path& naming_file,
                                   const std::filesystem::path& main_file);

// Reads each scene file once, even if it is included several times.
class SceneFiles {
 public:
  explicit SceneFiles(SourceFiles& files) : files_(files) {}

  // The id of the file; nothing, with a message in `error`, when it cannot be read.
  std::optional<uint32_t> open(const std::filesystem::path& path, std::string& error);

 private:
  SourceFiles& files_;
  std::map<std::string, uint32_t> by_canonical_path_;
};

// The bytes of a regular file of at most max_bytes; nothing, with a message in `error`, when it cannot be
// read.
std::optional<std::string> read_bytes(const std::filesystem::path& path, uint64_t max_bytes,
                                      std::string& error);

}  // namespace kaustik::pbrt
