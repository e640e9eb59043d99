#include "apps/machine/launched.h"

#include <algorithm>
#include <charconv>
#include <cstdlib>
#include <string_view>

namespace kaustik::app {

namespace {

// A positive number of the environment; 0 if there is none.
int number_in(const char* name) {
  const char* const text = std::getenv(name);
  if (!text) return 0;
  const std::string_view view(text);
  int number = 0;
  const auto [end, error] = std::from_chars(view.data(), view.data() + view.size(), number);
  return error == std::errc() && end == view.data() + view.size() ? std::max(number, 0) : 0;
}

}  // namespace

Launched launched() {
  Launched launched{number_in("OMPI_COMM_WORLD_SIZE")};
  // What else sets these starts single processes, too, which have nothing to do with MPI.
  const int by_srun = std::getenv("PMIX_RANK") ? number_in("SLURM_STEP_NUM_TASKS") : 0;
  for (const int ranks : {number_in("PMI_SIZE"), by_srun})
    if (ranks > 1) launched.ranks = std::max(launched.ranks, ranks);
  for (const char* const name : {"OMPI_COMM_WORLD_LOCAL_SIZE", "MPI_LOCALNRANKS"})
    launched.on_machine = std::max(launched.on_machine, number_in(name));
  return launched;
}

}  // namespace kaustik::app
