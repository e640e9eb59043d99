#include "apps/convert/scene_folder.h"

#include <fmt/format.h>

#include <stdexcept>

#include "core/files/input_file.h"

namespace kaustik::app {

namespace fs = std::filesystem;

namespace {

constexpr uint64_t kLargestCopy = uint64_t{1} << 36;  // bytes

std::string bytes_of(const ReadableFile& file) {
  try {
    return read_file(file, kLargestCopy);
  } catch (const FileError& error) {
    throw std::runtime_error(fmt::format("cannot copy {}: {}", file.path().string(), error.what()));
  }
}

}  // namespace

SceneFolder::SceneFolder(fs::path scene)
    : scene_(std::move(scene)), folder_(scene_.parent_path() / (scene_.stem().string() + "-files")) {}

SceneFolder::~SceneFolder() {
  files_.clear();
  std::error_code ignored;
  if (made_folder_ && !committed_) fs::remove(folder_, ignored);  // removes it only if it is empty
}

void SceneFolder::add(const fs::path& path, std::string_view bytes) {
  try {
    PendingFile& file = files_.emplace_back(path);
    file.write(bytes);
    file.finish();
  } catch (const FileError& error) {
    throw std::runtime_error(fmt::format("cannot write {}: {}", path.string(), error.what()));
  }
}

void SceneFolder::add_to_folder(const std::string& name, std::string_view bytes) {
  if (!fs::exists(folder_)) {
    std::error_code error;
    if (!fs::create_directory(folder_, error))
      throw std::runtime_error(
          fmt::format("cannot make the folder {}: {}", folder_.string(), error.message()));
    made_folder_ = true;
  }
  add(folder_ / name, bytes);
}

std::string SceneFolder::name_in_scene(const std::string& name) const {
  return (folder_.filename() / name).string();
}

std::string SceneFolder::add_mesh(const std::string& bytes) {
  std::string name;
  do name = fmt::format("mesh{}.ply", meshes_++);
  while (!names_.insert(name).second);
  add_to_folder(name, bytes);
  return name_in_scene(name);
}

std::string SceneFolder::copy(const ReadableFile& readable) {
  const fs::path& file = readable.path();
  std::error_code error;
  const std::string key = fs::weakly_canonical(readable.place(), error).string();
  if (const auto found = copied_.find(key); found != copied_.end()) return name_in_scene(found->second);
  std::string name = file.filename().string();
  for (int i = 2; !names_.insert(name).second; ++i)
    name = fmt::format("{}-{}{}", file.stem().string(), i, file.extension().string());
  add_to_folder(name, bytes_of(readable));
  copied_.emplace(key, name);
  return name_in_scene(name);
}

void SceneFolder::commit(const std::string& text) {
  add(scene_, text);
  try {
    for (PendingFile& file : files_) file.commit();
  } catch (const FileError& error) {
    throw std::runtime_error(fmt::format("{}: {}", scene_.string(), error.what()));
  }
  committed_ = true;
}

}  // namespace kaustik::app
