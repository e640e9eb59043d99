#include "apps/import/common/temporary_folder.h"

#include <cerrno>
#include <cstdlib>

namespace kaustik {

TemporaryFolder::TemporaryFolder() {
  std::string name = (std::filesystem::temp_directory_path() / "kaustik-XXXXXX").string();
  if (!mkdtemp(name.data()))
    throw std::filesystem::filesystem_error("cannot make a temporary folder", name,
                                            std::error_code(errno, std::generic_category()));
  path_ = name;
}

TemporaryFolder::~TemporaryFolder() {
  std::error_code ignored;
  std::filesystem::remove_all(path_, ignored);
}

}  // namespace kaustik
