#pragma once
// Which files may be read: all, or only those below one folder, and only as large as memory allows.

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/files/file_error.h"
#include "core/memory/memory_room.h"

namespace kaustik {

// A file that may be read, or one that may not, of which nothing but its name is known. There is no
// conversion from paths: whoever reads a file says who has named it.
class ReadableFile {
 public:
  // A file that the user or the program itself names.
  static ReadableFile trusted(std::filesystem::path path);

  // The file as it was named, for messages and for what it names itself.
  const std::filesystem::path& path() const { return path_; }
  // What to open. Throws FileError if the file may not be read.
  const std::filesystem::path& place() const;
  bool refused() const { return !refusal_.empty(); }
  // Whether place() is free of symbolic links and is to be opened only while it is.
  bool without_links() const { return without_links_; }
  // Whether there is such a regular file that may be read. Of files that may not, the answer is always no.
  bool exists() const;
  // The memory for the file and what is made of it.
  const MemoryRoom& room() const { return room_; }

 private:
  friend class ReadRoot;
  std::filesystem::path path_, place_;
  MemoryRoom room_;
  std::string refusal_;
  bool without_links_ = false;
};

// All files, or those below one folder. A value; const functions are thread-safe.
class ReadRoot {
 public:
  // All files.
  ReadRoot() = default;
  // Only files below `folder`. `refusal`: why others cannot be read. Throws FileError if there is no such
  // folder.
  ReadRoot(const std::filesystem::path& folder, std::string refusal);

  // The file that a file in `folder` calls `name`. Below a root, every step of the name must stay there, as
  // with RESOLVE_BENEATH of Linux: `..` and links that lead out of it are refused, even if they come back,
  // and so are absolute names that do not begin with the root. Nothing outside is asked for, so that the
  // answer does not depend on what is there.
  ReadableFile find(const std::filesystem::path& folder, const std::filesystem::path& name) const;
  // A file by its path.
  ReadableFile find(const std::filesystem::path& path) const;

  // Files of this folder may be read, too, by their names alone: the program has made them.
  void add_own(const std::filesystem::path& folder);

  // Limits the memory for files that are found from now on.
  void set_room(MemoryRoom room) { room_ = std::move(room); }
  const MemoryRoom& room() const { return room_; }

 private:
  using Parts = std::vector<std::string>;

  std::optional<std::filesystem::path> place_of(const std::filesystem::path& folder,
                                                const std::filesystem::path& name) const;
  std::optional<std::filesystem::path> follow(std::filesystem::path at, Parts rest) const;
  bool is_below(const std::filesystem::path& place) const;
  // Removes the root from the front of the parts of an absolute path. False if it is not there.
  bool take_root(Parts* parts) const;

  std::filesystem::path root_;      // without links; empty: all files may be read
  Parts root_parts_, given_parts_;  // of the root, and of its absolute path as it was given
  std::string refusal_;
  std::vector<std::filesystem::path> own_;  // without links
  MemoryRoom room_;
};

}  // namespace kaustik
