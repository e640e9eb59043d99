#pragma once
// Finds and reads the files of scenes. Importers open none in any other way (scripts/check-architecture).

#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <string>

#include "core/diagnostics/diagnostics.h"
#include "core/files/read_root.h"

namespace kaustik::pbrt {

// Finds the file that a scene names. An absolute name is taken as it is. A relative one is looked for beside
// the file that names it, then beside the main file (pbrt's rule). If neither is there, the one beside the
// naming file is returned. Reading it fails if it is not there or may not be read.
ReadableFile find_named_file(const ReadRoot& root, const std::string& name,
                             const std::filesystem::path& naming_file,
                             const std::filesystem::path& main_file);

// A text file that was read.
struct OpenedText {
  std::optional<uint32_t> file{};  // its id; nothing when it cannot be read
  std::string error{};             // why it cannot
  bool refused = false;            // because it may not be read
};

// Opens the text file that a scene calls `name`.
using TextOpener = std::function<OpenedText(const std::string& name)>;

// Reads each scene file once, even if it is included several times.
class SceneFiles {
 public:
  explicit SceneFiles(SourceFiles& files) : files_(files) {}

  OpenedText open(const ReadableFile& readable);

 private:
  SourceFiles& files_;
  std::map<std::string, uint32_t> by_canonical_path_;
};

// The bytes of a regular file of at most max_bytes; nothing, with a message in `error`, when it cannot be
// read.
std::optional<std::string> read_bytes(const ReadableFile& file, uint64_t max_bytes, std::string& error);

// The first bytes of a file, at most `size`; none when it cannot be read.
std::string first_bytes(const ReadableFile& file, size_t size);

}  // namespace kaustik::pbrt
