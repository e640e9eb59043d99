#include "apps/import/common/find_file.h"
#include "core/text.h"

#include <algorithm>
#include <vector>

namespace kaustik {
namespace {

namespace fs = std::filesystem;

bool is_file(const fs::path& path) {
  std::error_code ignored;
  return fs::is_regular_file(path, ignored);
}

// The entry of a folder with this name in any letter case; of several, the first in alphabetical order.
std::optional<fs::path> entry_of(const fs::path& folder, const std::string& name) {
  std::error_code error;
  if (name == ".." || fs::exists(folder / name, error)) return folder / name;
  std::optional<fs::path> found;
  for (fs::directory_iterator i(folder.empty() ? "." : folder, error), end; !error && i != end;
       i.increment(error)) {
    const fs::path entry = i->path().filename();
    if (lower_case(entry.string()) == lower_case(name) && (!found || folder / entry < *found))
      found = folder / entry;
  }
  return found;
}

std::optional<fs::path> in_any_case(fs::path folder, std::span<const std::string> parts) {
  for (const std::string& part : parts) {
    auto entry = entry_of(folder, part);
    if (!entry) return std::nullopt;
    folder = std::move(*entry);
  }
  return is_file(folder) ? std::optional(folder) : std::nullopt;
}

}  // namespace

std::optional<fs::path> find_file(const std::string& name, std::span<const fs::path> folders) {
  if (name.empty() || name.find('\0') != name.npos) return std::nullopt;
  for (const fs::path& folder : folders)
    if (is_file(folder / name)) return folder / name;
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
      if (auto found = in_any_case(folder, std::span(parts).subspan(first))) return found;
  }
  return std::nullopt;
}

}  // namespace kaustik
