#include "apps/session/files/output_files.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>

#include "apps/console/exit_error.h"
#include "apps/settings/table/import_options.h"
#include "core/files/input_file.h"
#include "core/files/pending_file.h"
#include "core/files/read_root.h"
#include "render/map_files/map_file.h"
#include "render/picture/image_io.h"

namespace kaustik::app {

namespace fs = std::filesystem;

namespace {

fs::path folder_of(const std::string& path) {
  const fs::path folder = fs::path(path).parent_path();
  return folder.empty() ? fs::path(".") : folder;
}

[[noreturn]] void refuse(const std::string& path, const std::string& reason) {
  throw ExitError(kBadCommandLine, fmt::format("cannot write {}: {}", path, reason));
}

}  // namespace

void check_writable(const std::string& path) {
  std::error_code ignored;
  const fs::path folder = folder_of(path);
  if (path.empty() || !fs::path(path).has_filename()) refuse(path, "expected a file name");
  if (!fs::exists(folder, ignored)) refuse(path, fmt::format("there is no folder {}", folder.string()));
  if (!fs::is_directory(folder, ignored)) refuse(path, fmt::format("{} is not a folder", folder.string()));
  if (access(folder.c_str(), W_OK | X_OK) != 0) refuse(path, std::strerror(errno));
  const std::string name = fs::path(path).filename().string();
  if (const long most = pathconf(folder.c_str(), _PC_NAME_MAX); most > 0 && name.size() > size_t(most))
    refuse(path, std::strerror(ENAMETOOLONG));
  if (fs::is_directory(path, ignored)) refuse(path, "it is a folder");
  // A finished file takes the place of the old one, which must not be a device such as /dev/null.
  if (fs::exists(path, ignored) && !fs::is_regular_file(path, ignored))
    refuse(path, "it is not a regular file");
}

void check_image_output(const std::string& path) {
  try {
    render::check_output_name(path);
  } catch (const std::invalid_argument& error) {
    throw ExitError(kBadCommandLine, error.what());
  }
  check_writable(path);
  if (!render::is_exr(path)) render::image_formats();
}

void check_below_root(const std::string& root, const std::string& named_by, const std::string& output) {
  if (root.empty()) return;
  std::error_code error;
  try {
    if (!ReadRoot(root, {"outside"}).find(fs::absolute(output, error)).refused()) return;
  } catch (const FileError&) {
    // Without its folder, nothing lies below the root.
  }
  throw ExitError(kBadScene, fmt::format("{} names the output \"{}\": {}; -o names another one", named_by,
                                         output, lies_outside(root)));
}

void check_map_output(const std::string& path) {
  if (!render::is_map_name(path)) refuse(path, "a file of photon maps must end in .kmap");
  check_writable(path);
}

std::string text_of_file(const std::string& path) {
  constexpr uint64_t kLargestText = uint64_t{1} << 30;  // bytes
  try {
    return read_file(path, kLargestText);
  } catch (const FileError& error) {
    throw ExitError(kBadCommandLine, fmt::format("{}: {}", path, error.what()));
  }
}

void write_text_file(const std::string& path, const std::string& text) {
  try {
    write_file(path, text);
  } catch (const FileError& error) {
    throw std::runtime_error(fmt::format("{}: {}", path, error.what()));
  }
}

}  // namespace kaustik::app
