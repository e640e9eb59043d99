#pragma once
// A file that appears under its name only when it is complete.

#include <filesystem>
#include <string>

namespace kaustik {

// Whoever writes it does so under temporary(), in the same folder; commit() renames. Without it the temporary
// file is removed, and a previous file of the final name is untouched.
class PendingFile {
 public:
  PendingFile(std::filesystem::path final_name, std::filesystem::path temporary)
      : final_(std::move(final_name)), temporary_(std::move(temporary)) {}
  PendingFile(const PendingFile&) = delete;
  PendingFile& operator=(const PendingFile&) = delete;
  ~PendingFile();

  std::string temporary() const { return temporary_.string(); }
  // Why the file could not be renamed; empty when it was.
  std::string commit();

 private:
  std::filesystem::path final_, temporary_;
  bool done_ = false;
};

// A name in the folder of `path` that keeps its extension (which chooses a picture's format) and that no
// other writer of this machine uses.
std::filesystem::path unique_temporary_name(const std::filesystem::path& path);

}  // namespace kaustik
