#pragma once
// Command-line options that take several values, separated by commas.

#include <cstdint>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

namespace CLI {
class App;
}

namespace kaustik::app {

// Adds an option. `texts` holds the default, which is replaced when the option is given; a repeated option
// adds its values.
void add_list_option(CLI::App& parser, const std::string& name, std::vector<std::string>& texts,
                     const std::string& value_name, const std::string& description);

// Parses an integer from 1 to `most`; the suffixes of parse_count are allowed. Throws ExitError (bad command
// line), which names the option.
uint64_t whole_number(std::string_view option, const std::string& text, uint64_t most);

// Calls whole_number for each text. Also throws ExitError for a value that is given twice.
std::vector<uint64_t> whole_numbers(std::string_view option, const std::vector<std::string>& texts,
                                    uint64_t most = std::numeric_limits<uint64_t>::max());

}  // namespace kaustik::app
