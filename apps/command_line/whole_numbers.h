#pragma once
// The values of options that take one or several positive integers.

#include <cstdint>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

namespace kaustik::app {

// Parses an integer from 1 to `most`; the suffixes of parse_count are allowed. Throws ExitError (bad command
// line), which names the option.
uint64_t whole_number(std::string_view option, const std::string& text, uint64_t most);

// Calls whole_number for each text. Also throws ExitError for a value that is given twice.
std::vector<uint64_t> whole_numbers(std::string_view option, const std::vector<std::string>& texts,
                                    uint64_t most = std::numeric_limits<uint64_t>::max());

}  // namespace kaustik::app
