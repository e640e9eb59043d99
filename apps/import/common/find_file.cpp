#include "apps/import/common/find_file.h"
#include "core/text.h"

#include <algorithm>
#include <vector>

namespace kaustik {
namespace {

namespace fs = std::filesystem;

// The entry of a folder with this name in any letter case; of several, the first in alphabetical order.
std::optional<fs::path> entry_of(const ReadRoot& root, const fs::path& folder, const std::string& name) {
  std::error_code error;
  const ReadableFile exact = root.find(folder, name), inside = root.find(folder, ".");
  if (exact.refused() || inside.refused()) return std::nullopt;
  if (name == ".." || fs::exists(exact.place(), error)) return folder / name;
  std::optional<fs::path> found;
  for (fs::directory_iterator i(inside.place(), error), end; !error && i != end; i.increment(error)) {
    const fs::path entry = i->path().filename();
    if (lower_case(entry.string()) == lower_case(name) && (!found || folder / entry < *found))
      found = folder / entry;
  }
  return found;
}

std::optional<ReadableFile> in_any_case(const ReadRoot& root, fs::path folder,
                                        std::span<const std::string> parts) {
  for (const std::string& part : parts) {
    auto entry = entry_of(root, folder, part);
    if (!entry) return std::nullopt;
    folder = std::move(*entry);
  }
  ReadableFile file = root.find(folder);
  return file.exists() ? std::optional(std::move(file)) : std::nullopt;
}

}  // namespace

std::optional<ReadableFile> find_file(const ReadRoot& root, const std::string& name,
                                      std::span<const fs::path> folders) {
  if (name.empty() || name.find('\0') != name.npos) return std::nullopt;
  std::optional<ReadableFile> refused;
  for (const fs::path& folder : folders) {
    ReadableFile file = root.find(folder, name);
    if (file.exists()) return file;
    if (file.refused()) refused = std::move(file);
  }
  std::vector<std::string> parts{""};
  for (const char c : name) {
    if (c != '/' && c != '\\')
      parts.back() += c;
    else if (!parts.back().empty())
      parts.emplace_back();
  }
  std::erase_if(parts, [](const std::string& part) { return part.empty() || part == "."; });
  for (size_t first = 0; first < parts.size(); ++first) {
    for (const fs::path& folder : folders)
      if (auto found = in_any_case(root, folder, std::span(parts).subspan(first))) return found;
  }
  return refused;
}

}  // namespace kaustik
