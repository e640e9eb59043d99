#include "core/files/hidden_name.h"

#include <algorithm>

namespace kaustik {

std::string hidden_name_beginning(const std::filesystem::path& path) {
  constexpr size_t kMostBytes = 200;
  const std::string name = path.filename().string();
  size_t size = std::min(name.size(), kMostBytes);
  // A character of UTF-8 is not cut: some file systems refuse such names.
  while (size > 0 && size < name.size() && (static_cast<unsigned char>(name[size]) & 0xc0) == 0x80) --size;
  return "." + name.substr(0, size) + ".";
}

}  // namespace kaustik
