#pragma once
// Files with the inputs of fuzz targets, for parsers that read files.

#include <filesystem>
#include <fstream>
#include <map>
#include <string>
#include <string_view>

#include "core/files/temporary_folder.h"
#include "tests/fuzz/targets.h"

namespace kaustik::fuzz {

// A temporary folder that lives as long as the process.
inline const std::filesystem::path& input_folder() {
  static const TemporaryFolder folder;
  return folder.path();
}

// Writes the input to the file of this name in the folder, in place of an earlier one.
inline std::filesystem::path input_file(const std::string& name, std::string_view bytes) {
  const std::filesystem::path path = input_folder() / name;
  std::ofstream(path, std::ios::binary | std::ios::trunc)
      .write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  return path;
}

inline std::string_view as_text(Bytes input) {
  return {reinterpret_cast<const char*>(input.data()), input.size()};
}

}  // namespace kaustik::fuzz
