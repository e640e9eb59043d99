#include "apps/settings/list_options.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <set>

#include "apps/console/exit_error.h"
#include "apps/settings/values.h"

namespace kaustik::app {

CLI::Option* add_list_option(CLI::App& parser, const std::string& name, std::vector<std::string>& texts,
                             const std::string& value_name, const std::string& description) {
  return parser.add_option(name, texts, description)
      ->option_text(value_name)
      ->delimiter(',')
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
}

void offer_choices(CLI::Option& option, std::span<const std::string_view> choices) {
  option.type_name(fmt::format("{{{}}}", fmt::join(choices, ",")));
}

std::vector<std::string> offered_choices(const CLI::Option& option) {
  const std::string text = option.get_type_name();
  if (!text.starts_with('{') || !text.ends_with('}')) return {};
  return CLI::detail::split(text.substr(1, text.size() - 2), ',');
}

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
