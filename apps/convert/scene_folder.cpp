#include "apps/convert/scene_folder.h"

#include <fmt/format.h>

#include <stdexcept>

namespace kaustik::app {

namespace fs = std::filesystem;

namespace {

void write(const fs::path& temporary, const fs::path& path, const std::string& bytes) {
  if (const std::string reason = write_in_place(temporary, bytes); !reason.empty())
    throw std::runtime_error(fmt::format("cannot write {}: {}", path.string(), reason));
}

}  // namespace

SceneFolder::SceneFolder(fs::path scene)
    : scene_(std::move(scene)), folder_(scene_.parent_path() / (scene_.stem().string() + "-files")) {}

SceneFolder::~SceneFolder() {
  files_.clear();
  std::error_code ignored;
  if (made_folder_ && !committed_) fs::remove(folder_, ignored);  // removes it only if it is empty
}

fs::path SceneFolder::new_file(const std::string& name) {
  if (!fs::exists(folder_)) {
    std::error_code error;
    if (!fs::create_directory(folder_, error))
      throw std::runtime_error(
          fmt::format("cannot make the folder {}: {}", folder_.string(), error.message()));
    made_folder_ = true;
  }
  const fs::path path = folder_ / name;
  return files_.emplace_back(path, unique_temporary_name(path)).temporary();
}

std::string SceneFolder::name_in_scene(const std::string& name) const {
  return (folder_.filename() / name).string();
}

std::string SceneFolder::add_mesh(const std::string& bytes) {
  std::string name;
  do name = fmt::format("mesh{}.ply", meshes_++);
  while (!names_.insert(name).second);
  write(new_file(name), folder_ / name, bytes);
  return name_in_scene(name);
}

std::string SceneFolder::copy(const fs::path& file) {
  std::error_code error;
  const std::string key = fs::weakly_canonical(file, error).string();
  if (const auto found = copied_.find(key); found != copied_.end()) return name_in_scene(found->second);
  std::string name = file.filename().string();
  for (int i = 2; !names_.insert(name).second; ++i)
    name = fmt::format("{}-{}{}", file.stem().string(), i, file.extension().string());
  fs::copy_file(file, new_file(name), fs::copy_options::overwrite_existing, error);
  if (error) throw std::runtime_error(fmt::format("cannot copy {}: {}", file.string(), error.message()));
  copied_.emplace(key, name);
  return name_in_scene(name);
}

void SceneFolder::commit(const std::string& text) {
  const fs::path temporary = unique_temporary_name(scene_);
  files_.emplace_back(scene_, temporary);
  write(temporary, scene_, text);
  for (PendingFile& file : files_) {
    if (const std::string trouble = file.commit(); !trouble.empty())
      throw std::runtime_error(fmt::format("{}: {}", scene_.string(), trouble));
  }
  committed_ = true;
}

}  // namespace kaustik::app
