#pragma once
// Command-line options that take several values, separated by commas.

#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace kaustik::app {

// Adds an option. `texts` holds the default, which is replaced when the option is given; a repeated option
// adds its values.
CLI::Option* add_list_option(CLI::App& parser, const std::string& name, std::vector<std::string>& texts,
                             const std::string& value_name, const std::string& description);

// Notes the values that the option takes, for completions: the parser does not check them. Kept as the type
// name of the option, which the help does not show.
void offer_choices(CLI::Option& option, std::span<const std::string_view> choices);

// The choices that were noted; empty where there are none.
std::vector<std::string> offered_choices(const CLI::Option& option);

// Parses an integer from 1 to `most`; the suffixes of parse_count are allowed. Throws ExitError (bad command
// line), which names the option.
uint64_t whole_number(std::string_view option, const std::string& text, uint64_t most);

// Calls whole_number for each text. Also throws ExitError for a value that is given twice.
std::vector<uint64_t> whole_numbers(std::string_view option, const std::vector<std::string>& texts,
                                    uint64_t most = std::numeric_limits<uint64_t>::max());

}  // namespace kaustik::app
