#include "core/files/read_root.h"

#include <algorithm>

namespace kaustik {

namespace fs = std::filesystem;

namespace {

constexpr int kMostLinks = 40;  // as in Linux

// The parts of a path, the leading "/" included, without those that lead nowhere.
std::vector<std::string> parts_of(const fs::path& path) {
  std::vector<std::string> parts;
  for (const fs::path& part : path)
    if (!part.empty() && part != ".") parts.push_back(part.string());
  return parts;
}

fs::path without_links(const fs::path& path) {
  std::error_code error;
  return fs::weakly_canonical(fs::absolute(path, error), error);
}

}  // namespace

ReadableFile ReadableFile::trusted(fs::path path) {
  ReadableFile file;
  file.path_ = file.place_ = std::move(path);
  return file;
}

const fs::path& ReadableFile::place() const {
  if (refused()) throw FileError(refusal_);
  return place_;
}

bool ReadableFile::exists() const {
  std::error_code ignored;
  return !refused() && fs::is_regular_file(place_, ignored);
}

ReadRoot::ReadRoot(const fs::path& folder, std::string refusal) : refusal_(std::move(refusal)) {
  std::error_code error;
  root_ = fs::canonical(folder, error);
  if (error) throw FileError(error.message());
  if (!fs::is_directory(root_, error)) throw FileError("it is not a folder");
  root_parts_ = parts_of(root_);
  given_parts_ = parts_of(fs::absolute(folder, error));
}

void ReadRoot::add_own(const fs::path& folder) {
  own_.push_back(without_links(folder));
}

bool ReadRoot::is_below(const fs::path& place) const {
  Parts parts = parts_of(place);
  return parts.size() >= root_parts_.size() &&
         std::equal(root_parts_.begin(), root_parts_.end(), parts.begin());
}

bool ReadRoot::take_root(Parts* parts) const {
  for (const Parts* root : {&root_parts_, &given_parts_}) {
    if (parts->size() < root->size() || !std::equal(root->begin(), root->end(), parts->begin())) continue;
    parts->erase(parts->begin(), parts->begin() + static_cast<std::ptrdiff_t>(root->size()));
    return true;
  }
  return false;
}

// Follows `rest` from `at`, a place below the root without links, one part after the other. Nothing if that
// leaves the root.
std::optional<fs::path> ReadRoot::follow(fs::path at, Parts rest) const {
  std::reverse(rest.begin(), rest.end());
  for (int links = 0; !rest.empty();) {
    const std::string part = std::move(rest.back());
    rest.pop_back();
    if (part == "..") {
      if (at == root_) return std::nullopt;
      at = at.parent_path();
      continue;
    }
    std::error_code error;
    const fs::path next = at / part, target = fs::read_symlink(next, error);
    if (error) {
      at = next;  // it is no link, or is not there
      continue;
    }
    Parts parts = parts_of(target);
    if (++links > kMostLinks || (target.is_absolute() && !take_root(&parts))) return std::nullopt;
    if (target.is_absolute()) at = root_;
    rest.insert(rest.end(), parts.rbegin(), parts.rend());
  }
  return at;
}

std::optional<fs::path> ReadRoot::place_of(const fs::path& folder, const fs::path& name) const {
  if (name.native().find('\0') != std::string::npos) return std::nullopt;  // the system would cut it there
  Parts parts = parts_of(name);
  if (name.is_absolute()) {
    if (!take_root(&parts)) return std::nullopt;
    return follow(root_, std::move(parts));
  }
  const fs::path start = without_links(folder.empty() ? "." : folder);
  const bool own = std::find(own_.begin(), own_.end(), start) != own_.end();
  if (own && parts.size() == 1 && parts[0] != "..") return start / parts[0];
  if (!is_below(start)) return std::nullopt;
  return follow(start, std::move(parts));
}

ReadableFile ReadRoot::find(const fs::path& folder, const fs::path& name) const {
  ReadableFile file = ReadableFile::trusted(folder / name);
  file.room_ = room_;
  if (root_.empty()) return file;
  auto place = place_of(folder, name);
  if (!place) {
    file.refusal_ = refusal_;
    return file;
  }
  file.place_ = std::move(*place);
  file.without_links_ = true;
  return file;
}

ReadableFile ReadRoot::find(const fs::path& path) const {
  return find(path.parent_path(), path.filename());
}

}  // namespace kaustik
