#pragma once
// A file that appears under its name only when it is complete.

#include <filesystem>
#include <string>

namespace kaustik {

// The file is written under temporary(), in the folder of the final name; commit() renames it. Without
// commit() the temporary file is removed, and an existing file of the final name is left untouched.
class PendingFile {
 public:
  PendingFile(std::filesystem::path final_name, std::filesystem::path temporary)
      : final_(std::move(final_name)), temporary_(std::move(temporary)) {}
  PendingFile(const PendingFile&) = delete;
  PendingFile& operator=(const PendingFile&) = delete;
  ~PendingFile();

  std::string temporary() const { return temporary_.string(); }
  // Returns why the file could not be renamed, or an empty string on success.
  std::string commit();

 private:
  std::filesystem::path final_, temporary_;
  bool done_ = false;
};

// A name in the folder of `path` that keeps its extension (which chooses an image's format) and that no other
// process on this machine uses.
std::filesystem::path unique_temporary_name(const std::filesystem::path& path);

}  // namespace kaustik
