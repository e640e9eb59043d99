#pragma once
// Files that an importer makes for a scene, such as images that were embedded in its file.

#include <memory>
#include <utility>

#include "core/diagnostics/diagnostics.h"
#include "core/files/temporary_folder.h"
#include "core/scene/description/description.h"

namespace kaustik {

// A temporary folder that lives as long as the scene does. Its files may be read whatever the root is.
class MadeFiles {
 public:
  // Throws std::runtime_error if there can be no folder.
  MadeFiles(SourceFiles& files, SceneDescription& scene) {
    const auto folder = std::make_shared<const TemporaryFolder>();
    using Owner = std::shared_ptr<const void>;
    scene.keeps = std::make_shared<const std::pair<Owner, Owner>>(scene.keeps, folder);
    path_ = folder->path();
    files.root().add_own(path_);
    where_ = {files.add((path_ / "made").string(), ""), 0, 0};
  }

  std::filesystem::path path(const std::string& name) const { return path_ / name; }
  // The location of parameters that name the files: names are relative to it.
  const SourceLocation& where() const { return where_; }

 private:
  std::filesystem::path path_;
  SourceLocation where_;
};

}  // namespace kaustik
