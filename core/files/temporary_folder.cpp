#include "core/files/temporary_folder.h"

#include <fmt/format.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <stdexcept>
#include <string>

namespace kaustik {

TemporaryFolder::TemporaryFolder() {
  const char* const chosen = std::getenv("TMPDIR");
  const std::string parent = chosen && *chosen != '\0' ? chosen : "/tmp";
  std::string name = parent + "/kaustik-XXXXXX";
  if (!mkdtemp(name.data()))
    throw std::runtime_error(
        fmt::format("cannot make a temporary folder in {}: {}; the variable TMPDIR can name another place",
                    parent, std::strerror(errno)));
  path_ = name;
}

TemporaryFolder::~TemporaryFolder() {
  std::error_code ignored;
  std::filesystem::remove_all(path_, ignored);
}

}  // namespace kaustik
