#include "apps/command_line/whole_numbers.h"

#include <fmt/format.h>

#include <set>

#include "apps/command_line/values.h"
#include "apps/console/exit_error.h"

namespace kaustik::app {

uint64_t whole_number(std::string_view option, const std::string& text, uint64_t most) {
  const std::optional<uint64_t> value = parse_count(text);
  if (value && *value >= 1 && *value <= most) return *value;
  throw ExitError(kBadCommandLine,
                  fmt::format("{}: `{}`: expected a whole number, 1 to {} (like 250, 10k, 2.5M, 1G)", option,
                              text, most));
}

std::vector<uint64_t> whole_numbers(std::string_view option, const std::vector<std::string>& texts,
                                    uint64_t most) {
  std::vector<uint64_t> values;
  std::set<uint64_t> seen;
  for (const std::string& text : texts) {
    values.push_back(whole_number(option, text, most));
    if (!seen.insert(values.back()).second)
      throw ExitError(kBadCommandLine, fmt::format("{}: `{}` is given twice", option, text));
  }
  return values;
}

}  // namespace kaustik::app
