#pragma once
// A converted scene on its way to the disk.

#include <deque>
#include <filesystem>
#include <map>
#include <set>
#include <string>

#include "core/files/pending_file.h"

namespace kaustik::app {

// NAME.pbrt, and the folder NAME-files beside it for meshes and images. Everything is written to temporary
// names; commit() renames, the scene last. Without it nothing is left, and what was there is as it was. All
// functions throw std::runtime_error with the path and the system's reason.
class SceneFolder {
 public:
  explicit SceneFolder(std::filesystem::path scene);
  ~SceneFolder();

  // Both give the name to write into the scene. A file that was copied before has the same name.
  std::string copy(const std::filesystem::path& file);
  std::string add_mesh(const std::string& bytes);
  void commit(const std::string& text);

  uint64_t copies() const { return copied_.size(); }
  uint64_t meshes() const { return meshes_; }
  const std::filesystem::path& folder() const { return folder_; }

 private:
  std::filesystem::path new_file(const std::string& name);
  std::string name_in_scene(const std::string& name) const;

  std::filesystem::path scene_, folder_;
  bool made_folder_ = false, committed_ = false;
  std::deque<PendingFile> files_;
  std::set<std::string> names_;
  std::map<std::string, std::string> copied_;  // by path
  uint64_t meshes_ = 0;
};

}  // namespace kaustik::app
