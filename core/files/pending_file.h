#pragma once
// A file that appears under its name only when it is complete.

#include <filesystem>
#include <string>
#include <string_view>

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

// Writes `bytes` under a temporary name beside `path` and renames it. Returns the system's reason if that
// fails, or an empty string; then the temporary file is removed, and a previous file is left untouched.
std::string write_file(const std::filesystem::path& path, std::string_view bytes);

// Writes `bytes` to `path` itself, for a file that is renamed later or is temporary. Returns the system's
// reason if that fails, or an empty string. Any file of that name is replaced.
std::string write_in_place(const std::filesystem::path& path, std::string_view bytes);

// A name in the folder of `path` that keeps its extension (which chooses an image's format) and that no other
// process on this machine uses.
std::filesystem::path unique_temporary_name(const std::filesystem::path& path);

}  // namespace kaustik
