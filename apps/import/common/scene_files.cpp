#include "apps/import/common/scene_files.h"

#include <fmt/format.h>

#include "apps/import/common/gzip.h"
#include "apps/import/common/no_scene.h"
#include "core/files/input_file.h"

namespace kaustik::pbrt {

namespace fs = std::filesystem;

// Bytes; source locations hold lines and columns as 32-bit numbers.
constexpr uint64_t kLargestSceneFile = 0xffffffffu;

namespace {

bool is_there(const ReadableFile& file) {
  std::error_code ignored;
  return !file.refused() && fs::exists(file.place(), ignored);
}

}  // namespace

ReadableFile find_named_file(const ReadRoot& root, const std::string& name, const fs::path& naming_file,
                             const fs::path& main_file) {
  const ReadableFile beside = root.find(naming_file.parent_path(), name);
  if (is_there(beside) || fs::path(name).is_absolute()) return beside;
  const ReadableFile beside_main = root.find(main_file.parent_path(), name);
  return is_there(beside_main) ? beside_main : beside;
}

std::optional<std::string> read_bytes(const ReadableFile& file, uint64_t max_bytes, std::string& error) {
  if (!file.refused() && !is_there(file)) {
    error = fmt::format("cannot open \"{}\": no such file", file.path().string());
    return std::nullopt;
  }
  try {
    return read_file(file, max_bytes);
  } catch (const FileError& failure) {
    error = fmt::format("cannot read \"{}\": {}", file.path().string(), failure.what());
    return std::nullopt;
  }
}

std::string first_bytes(const ReadableFile& file, size_t size) {
  try {
    return read_head(file, size);
  } catch (const FileError&) {
    return {};
  }
}

OpenedText SceneFiles::open(const ReadableFile& readable) {
  const std::string name = readable.path().string();
  const auto unreadable = [&](const std::string& why) {
    return OpenedText{.error = fmt::format("cannot read \"{}\": {}", name, why)};
  };
  OpenedText opened{.refused = readable.refused()};
  std::error_code ignored;
  const std::string key = opened.refused ? "" : fs::weakly_canonical(readable.place(), ignored).string();
  const auto found = by_canonical_path_.find(key);
  if (found != by_canonical_path_.end()) return {.file = found->second};
  auto text = read_bytes(readable, kLargestSceneFile, opened.error);
  if (!text) return opened;
  if (is_gzip(*text)) {
    text = unpack_gzip(*text, readable.room(), opened.error);
    if (!text) return unreadable(opened.error);
  }
  std::string none = why_no_scene(*text);
  if (none.empty() && is_binary(*text))
    none =
        "it is a binary file, but a .pbrt scene is plain text; the names of other formats end in .gltf, "
        ".glb, .obj, .ply or .stl";
  if (!none.empty()) return unreadable(none);
  opened.file = files_.add(name, std::move(*text));
  by_canonical_path_.emplace(key, *opened.file);
  return opened;
}

}  // namespace kaustik::pbrt
