// open_rank_link(): loads the module of MPI.

#include <stdexcept>

#include "apps/ranks/rank_link.h"
#include "core/files/module_entry.h"

namespace kaustik::app {

std::unique_ptr<RankLink> open_rank_link() {
  const auto open =
      module_entry<RankLink*(std::string&)>(KAUSTIK_MPI_MODULE, "kaustik_open_rank_link",
                                            "which ranks need that an MPI launcher has started (it is built "
                                            "where CMake finds Open MPI, Debian's libopenmpi-dev)");
  std::string error;
  std::unique_ptr<RankLink> link(open(error));
  if (!link) throw std::runtime_error(error);
  return link;
}

}  // namespace kaustik::app
