#pragma once
// Numbers as people write them on a command line.

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace kaustik::app {

// A whole number, exactly: digits with an optional fraction, power of ten and suffix k, M, G or T (powers of
// 1000), e.g. "10M", "2.5G", "1e6", "250". Nothing when it is not one, is no whole number or does not fit in
// 64 bits.
std::optional<uint64_t> parse_count(std::string_view text);

// The other way, as short as it is exact: 10000000 as "10M", 1500 as "1500".
std::string count_text(uint64_t n);

// A whole number with sign, no suffix.
std::optional<int64_t> parse_integer(std::string_view text);

// Seconds of a time with its unit: "90s", "1.5h", "10m", "250ms". Nothing when it is none, negative or above
// 10^9 seconds.
std::optional<double> parse_duration(std::string_view text);

// A part of one: "1%" or "0.01". Nothing when it is neither.
std::optional<double> parse_share(std::string_view text);

// A finite decimal number within float's range (subnormals included).
std::optional<float> parse_number(std::string_view text);

}  // namespace kaustik::app
