#include "apps/import/common/scene_files.h"

#include <fmt/format.h>

#include "apps/import/common/gzip.h"
#include "apps/import/common/no_scene.h"
#include "core/files/input_file.h"

namespace kaustik::pbrt {

namespace fs = std::filesystem;

// Bytes; source locations hold lines and columns as 32-bit numbers.
constexpr uint64_t kLargestSceneFile = 0xffffffffu;

fs::path resolve_path(const std::string& name, const fs::path& naming_file, const fs::path& main_file) {
  const fs::path path(name);
  if (path.is_absolute()) return path;
  const fs::path beside = naming_file.parent_path() / path;
  std::error_code ignored;
  if (fs::exists(beside, ignored)) return beside;
  const fs::path beside_main = main_file.parent_path() / path;
  return fs::exists(beside_main, ignored) ? beside_main : beside;
}

std::optional<std::string> read_bytes(const fs::path& path, uint64_t max_bytes, std::string& error) {
  std::error_code ignored;
  if (!fs::exists(path, ignored)) {
    error = fmt::format("cannot open \"{}\": no such file", path.string());
    return std::nullopt;
  }
  try {
    return read_file(path, max_bytes);
  } catch (const FileError& failure) {
    error = fmt::format("cannot read \"{}\": {}", path.string(), failure.what());
    return std::nullopt;
  }
}

std::optional<uint32_t> SceneFiles::open(const fs::path& path, std::string& error) {
  std::error_code ignored;
  const std::string key = fs::weakly_canonical(path, ignored).string();
  const auto found = by_canonical_path_.find(key);
  if (found != by_canonical_path_.end()) return found->second;
  auto text = read_bytes(path, kLargestSceneFile, error);
  if (!text) return std::nullopt;
  if (is_gzip(*text)) {
    text = unpack_gzip(*text, error);
    if (!text) {
      error = fmt::format("cannot read \"{}\": {}", path.string(), error);
      return std::nullopt;
    }
  }
  std::string none = why_no_scene(*text);
  if (none.empty() && is_binary(*text))
    none =
        "it is a binary file, but a .pbrt scene is plain text; the names of other formats end in .gltf, "
        ".glb, .obj, .ply or .stl";
  if (!none.empty()) {
    error = fmt::format("cannot read \"{}\": {}", path.string(), none);
    return std::nullopt;
  }
  const uint32_t file = files_.add(path.string(), std::move(*text));
  by_canonical_path_.emplace(key, file);
  return file;
}

}  // namespace kaustik::pbrt
