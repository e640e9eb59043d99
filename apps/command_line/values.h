#pragma once
// Parses numbers as users write them on a command line.

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/math/vec.h"

namespace kaustik::app {

// Parses a non-negative integer without rounding: digits with an optional fraction, power of ten and suffix
// k, M, G or T (powers of 1000), such as "10M", "2.5G", "1e6", "250". Nothing for other texts, fractions and
// values that do not fit in 64 bits.
std::optional<uint64_t> parse_count(std::string_view text);

// The inverse, with a suffix if the number is a multiple of its unit: 10000000 as "10M", 1500 as "1500".
std::string count_text(uint64_t n);

// Parses an integer with optional sign and without suffix; nothing for other texts.
std::optional<int64_t> parse_integer(std::string_view text);

// Parses a duration with its unit, such as "90s", "1.5h", "10m" or "250ms", into seconds. Nothing for other
// texts, negative durations and those above 10^9 s.
std::optional<double> parse_duration(std::string_view text);

// Parses a share such as "1%" or "0.01"; nothing for other texts.
std::optional<double> parse_share(std::string_view text);

// The parts between commas; a text without commas is the only part.
std::vector<std::string> split_at_commas(std::string_view text);

// Parses a finite decimal number within the range of a float, including subnormals; nothing for other texts.
std::optional<float> parse_number(std::string_view text);

// Parses a colour in linear Rec. 709: one number for a grey or three between commas, none negative, such as
// "0.5" or "0.2,0.4,1"; "#rrggbb", which is decoded from sRGB; white, grey, gray or black. Nothing for other
// texts.
std::optional<glm::dvec3> parse_colour(std::string_view text);

}  // namespace kaustik::app
