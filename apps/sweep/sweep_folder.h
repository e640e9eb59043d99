#pragma once
// The folder of a sweep, which holds what the sweep belongs to and its finished cells. Each file appears only
// when it is complete, so killing the program loses at most the cell that is being rendered.
//
//   sweep-of.json   what all cells have in common: scene, build, settings, reference
//   reference.exr, reference.json; reference.kpart while it is rendered
//   cells/KEY.json, KEY.png, KEY-error.png; KEY hashes sweep-of.json, the reference and the cell's settings
//   sweep.json, sweep.csv, report.html   once every cell is finished
//   .lock           held by the running sweep

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "apps/console/console.h"
#include "apps/sweep/sweep_result.h"
#include "core/files/file_lock.h"

namespace kaustik::app {

class SweepFolder {
 public:
  // Creates the folder if it is missing. Throws ExitError (bad command line) when the folder cannot be
  // written, another sweep is running in it, or it belongs to a sweep with another scene, build, settings or
  // reference; the message names the difference.
  SweepFolder(const std::string& path, const Json& common);

  std::string path(const std::string& name) const { return (folder_ / name).string(); }
  // The key of a cell with these settings, and the names of its pictures.
  std::string key(const Json& own) const;
  static std::string picture_of(const std::string& key) { return "cells/" + key + ".png"; }
  static std::string error_map_of(const std::string& key) { return "cells/" + key + "-error.png"; }
  // The finished cell of this key; nothing when it does not exist or, with a warning, when it is unusable.
  std::optional<SweepCell> find(const std::string& key, const Console& console) const;
  void keep(const std::string& key, const SweepCell& cell) const;

  // The JSON file of this name; nothing when it does not exist or is damaged.
  std::optional<Json> read(const std::string& name) const;

 private:
  void check_picture(std::string_view field, const std::string& named, const std::string& expected) const;

  std::filesystem::path folder_;
  FileLock lock_;
  std::string common_;
};

}  // namespace kaustik::app
