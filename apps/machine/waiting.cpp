#include "apps/machine/waiting.h"

#include <filesystem>
#include <fstream>

namespace kaustik::app {

std::optional<double> waiting_seconds(const std::string& root) {
  std::error_code error;
  double nanoseconds = 0;
  bool any = false;
  for (const auto& thread : std::filesystem::directory_iterator(root + "/proc/self/task", error)) {
    std::ifstream file(thread.path() / "schedstat");
    double ran = 0, waited = 0;
    if (file >> ran >> waited) nanoseconds += waited, any = true;
  }
  return any ? std::optional(1e-9 * nanoseconds) : std::nullopt;
}

}  // namespace kaustik::app
