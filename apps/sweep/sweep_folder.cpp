#include "apps/sweep/sweep_folder.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "apps/bench/bench_json.h"
#include "apps/console/exit_error.h"
#include "apps/session/files/output_files.h"
#include "apps/sweep/sweep_files.h"
#include "core/files/content_hash.h"
#include "core/files/input_file.h"
#include "core/files/pending_file.h"

namespace kaustik::app {

namespace fs = std::filesystem;

namespace {

constexpr const char* kCommonName = "sweep-of.json";

// Creates the folder if it is missing and returns its path. Throws ExitError when it cannot be written.
fs::path made(const fs::path& folder) {
  std::error_code error;
  if (fs::exists(folder, error) && !fs::is_directory(folder, error))
    refuse(fmt::format("cannot write {}: it is not a folder", folder.string()));
  fs::create_directories(folder / "cells", error);
  if (error) refuse(fmt::format("cannot write {}: {}", folder.string(), error.message()));
  if (access(folder.c_str(), W_OK | X_OK) != 0 || access((folder / "cells").c_str(), W_OK | X_OK) != 0)
    refuse(fmt::format("cannot write {}: {}", folder.string(), std::strerror(errno)));
  return folder;
}

// Describes the first value that differs, such as "seed: in the folder 1, now 2".
std::string difference(const Json& there, const Json& here, const std::string& name = {}) {
  if (there.is_object() && here.is_object()) {
    for (const auto& [key, value] : here.items()) {
      const Json other = there.contains(key) ? there[key] : Json(nullptr);
      if (other != value) return difference(other, value, name.empty() ? key : name + " " + key);
    }
    for (const auto& [key, value] : there.items())
      if (!here.contains(key)) return difference(value, nullptr, name.empty() ? key : name + " " + key);
  }
  const auto text = [](const Json& json) {
    return json.dump(-1, ' ', false, Json::error_handler_t::replace);
  };
  return fmt::format("{}: in the folder {}, now {}", name, text(there), text(here));
}

// Lets only one sweep at a time run in a folder.
FileLock locked(const fs::path& folder) {
  try {
    return FileLock(folder / ".lock");
  } catch (const FileBusy&) {
    refuse(fmt::format("{}: another sweep is running in this folder", folder.string()));
  } catch (const FileError& error) {
    refuse(fmt::format("cannot write {}: {}", folder.string(), error.what()));
  }
}

}  // namespace

SweepFolder::SweepFolder(const std::string& path, const Json& common)
    : folder_(made(path)), lock_(locked(folder_)), common_(common.dump(2) + "\n") {
  if (!fs::exists(folder_ / kCommonName)) {
    write_text_file(this->path(kCommonName), common_);
    return;
  }
  const std::optional<Json> there = read(kCommonName);
  if (!there)
    refuse(fmt::format("{} is damaged: remove the folder or choose another", this->path(kCommonName)));
  if (*there != Json::parse(common_))
    refuse(fmt::format("{} holds the results of another sweep: choose another folder. {}", path,
                       difference(*there, Json::parse(common_))));
  // The lock keeps other sweeps out.
  for (const fs::path& each : {folder_, folder_ / "cells"}) remove_all_leftovers(each);
}

std::string SweepFolder::key(const Json& own) const {
  ContentHash hash;
  hash.add(common_);
  hash.add(own.dump());
  return hash.text();
}

std::optional<Json> SweepFolder::read(const std::string& name) const {
  constexpr uint64_t kLargest = uint64_t{1} << 30;  // bytes
  try {
    return parse_json(read_file(path(name), kLargest));
  } catch (const std::runtime_error&) {  // a FileError, too
    return std::nullopt;
  }
}

std::optional<SweepCell> SweepFolder::find(const std::string& key, const Console& console) const {
  const std::string name = "cells/" + key + ".json";
  if (!fs::exists(path(name))) return std::nullopt;
  try {
    const std::optional<Json> json = read(name);
    if (!json) throw std::runtime_error("it is not valid JSON");
    SweepCell cell = cell_from_json(*json);
    check_picture("picture", cell.picture, picture_of(key));
    check_picture("error_map", cell.error_map, error_map_of(key));
    return cell;
  } catch (const std::exception& error) {
    console.warning(fmt::format("{}: {}; the cell is rendered again", path(name), error.what()));
    return std::nullopt;
  }
}

// The report embeds the pictures, and a folder may come from anybody: it must not name or link to other
// files.
void SweepFolder::check_picture(std::string_view field, const std::string& named,
                                const std::string& expected) const {
  if (named != expected)
    throw std::runtime_error(fmt::format("its {} is not the file {} of this folder", field, expected));
  std::error_code ignored;
  const fs::file_status status = fs::symlink_status(path(expected), ignored);
  if (!fs::exists(status)) throw std::runtime_error(expected + " is missing");
  if (!fs::is_regular_file(status)) throw std::runtime_error(expected + " is not a regular file");
}

void SweepFolder::keep(const std::string& key, const SweepCell& cell) const {
  write_text_file(path("cells/" + key + ".json"), cell_json(cell).dump(2) + "\n");
}

}  // namespace kaustik::app
