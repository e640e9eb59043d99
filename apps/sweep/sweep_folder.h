#pragma once
// The folder of a sweep: what it belongs to, and the cells that are finished. Each file appears when it is
// complete, so a kill costs the cell at work, not those before.
//
//   sweep-of.json   what all cells have in common: scene, build, settings, reference
//   reference.exr, reference.json, reference.kpart (while it is rendered)
//   cells/KEY.json, KEY.png, KEY-error.png; KEY hashes the common part, the reference's picture and the
//   cell's
//     own settings
//   sweep.json, sweep.csv, report.html   once every cell is finished
//   .lock           of the sweep at work

#include <filesystem>
#include <optional>
#include <string>

#include "apps/console/console.h"
#include "apps/sweep/sweep_result.h"

namespace kaustik::app {

// One process at a time in a folder. Ends with the process, however that ends; file systems without locks
// hold nobody off.
class FolderLock {
 public:
  // Throws ExitError (bad command line) when another sweep holds it.
  explicit FolderLock(const std::filesystem::path& folder);
  ~FolderLock();
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;

 private:
  int file_;
};

class SweepFolder {
 public:
  // Makes the folder where it is missing. Throws ExitError (bad command line) when it cannot be written,
  // another sweep is at work in it, or it belongs to a sweep of another scene, build, settings or reference:
  // says which.
  SweepFolder(const std::string& path, const Json& common);

  std::string path(const std::string& name) const { return (folder_ / name).string(); }
  // Of a cell with these settings of its own.
  std::string key(const Json& own) const;
  // The finished cell of this key; nothing when it is not there or, after a warning, unusable.
  std::optional<SweepCell> find(const std::string& key, const Console& console) const;
  void keep(const std::string& key, const SweepCell& cell) const;

  // The JSON file of this name; nothing when there is none or it is damaged.
  std::optional<Json> read(const std::string& name) const;

 private:
  std::filesystem::path folder_;
  FolderLock lock_;
  std::string common_;
};

}  // namespace kaustik::app
