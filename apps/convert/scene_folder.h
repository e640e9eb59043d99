#pragma once
// Writes a converted scene and its files to disk.

#include <deque>
#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <string_view>

#include "core/files/pending_file.h"
#include "core/files/read_root.h"

namespace kaustik::app {

// Writes NAME.pbrt, and beside it the folder NAME-files for meshes and images. All files get temporary names
// until commit() renames them, the scene last. Without commit() the destructor removes them, and existing
// files stay unchanged. All functions throw std::runtime_error with the path and the system's reason.
class SceneFolder {
 public:
  explicit SceneFolder(std::filesystem::path scene);
  ~SceneFolder();

  // Both return the name to write into the scene. Copying a file again returns the same name.
  std::string copy(const ReadableFile& readable);
  std::string add_mesh(const std::string& bytes);
  void commit(const std::string& text);

  uint64_t copies() const { return copied_.size(); }
  uint64_t meshes() const { return meshes_; }
  const std::filesystem::path& folder() const { return folder_; }

 private:
  void add(const std::filesystem::path& path, std::string_view bytes);
  void add_to_folder(const std::string& name, std::string_view bytes);
  std::string name_in_scene(const std::string& name) const;

  std::filesystem::path scene_, folder_;
  bool made_folder_ = false, committed_ = false;
  std::deque<PendingFile> files_;
  std::set<std::string> names_;
  std::map<std::string, std::string> copied_;  // by path
  uint64_t meshes_ = 0;
};

}  // namespace kaustik::app
