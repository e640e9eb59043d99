#pragma once
// Options that take several values, separated by commas.

#include <cstdint>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

namespace CLI {
class App;
}

namespace kaustik::app {

// texts: the default, replaced when the option is given; repeated options collect.
void add_list_option(CLI::App& parser, const std::string& name, std::vector<std::string>& texts,
                     const std::string& value_name, const std::string& description);

// 1 to most, suffixes allowed. Throws ExitError (bad command line) naming the option.
uint64_t whole_number(std::string_view option, const std::string& text, uint64_t most);

// The same for each text; one that is given twice is refused too.
std::vector<uint64_t> whole_numbers(std::string_view option, const std::vector<std::string>& texts,
                                    uint64_t most = std::numeric_limits<uint64_t>::max());

}  // namespace kaustik::app
