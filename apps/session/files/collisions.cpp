#include "apps/session/files/collisions.h"

#include <fmt/format.h>

#include <filesystem>

#include "apps/console/exit_error.h"

namespace kaustik::app {

namespace fs = std::filesystem;

bool same_file(const std::string& a, const std::string& b) {
  if (a == b) return true;
  std::error_code error;
  if (fs::equivalent(a, b, error)) return true;
  const auto plain = [&](const std::string& path) {
    return fs::weakly_canonical(fs::absolute(path, error), error);
  };
  const fs::path first = plain(a);
  return !first.empty() && first == plain(b);
}

void check_collisions(const std::vector<NamedFile>& outputs, const std::vector<NamedFile>& inputs) {
  for (size_t i = 0; i < outputs.size(); ++i) {
    const NamedFile& output = outputs[i];
    if (output.path.empty()) continue;
    for (size_t k = 0; k < i; ++k)
      if (!outputs[k].path.empty() && same_file(outputs[k].path, output.path))
        refuse(fmt::format("{} {} and {} {} name the same file: one would replace the other",
                           outputs[k].option, outputs[k].path, output.option, output.path));
    for (const NamedFile& input : inputs)
      if (!input.path.empty() && same_file(input.path, output.path))
        refuse(
            fmt::format("{} {} would replace {} {}", output.option, output.path, input.option, input.path));
  }
}

}  // namespace kaustik::app
