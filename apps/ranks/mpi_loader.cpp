// open_rank_link(): loads the module, which lies where images/loaded.cpp finds that of the images.

#include <dlfcn.h>
#include <fmt/format.h>

#include <stdexcept>

#include "apps/ranks/rank_link.h"

namespace kaustik::app {

std::unique_ptr<RankLink> open_rank_link() {
  using Open = RankLink* (*)(std::string&);
  const auto fail = [] {
    return std::runtime_error(
        fmt::format("started as several ranks by an MPI launcher, but cannot load {}: {}. It is built where "
                    "CMake finds Open MPI "
                    "(Debian: libopenmpi-dev)",
                    KAUSTIK_MPI_MODULE, dlerror()));
  };
  // Never closed: Open MPI leaves handlers behind.
  void* const library = dlopen(KAUSTIK_MPI_MODULE, RTLD_NOW | RTLD_LOCAL);
  if (!library) throw fail();
  void* const entry = dlsym(library, "kaustik_open_rank_link");
  if (!entry) throw fail();
  std::string error;
  RankLink* const link = reinterpret_cast<Open>(entry)(error);
  if (!link) throw std::runtime_error(error);
  return std::unique_ptr<RankLink>(link);
}

}  // namespace kaustik::app
