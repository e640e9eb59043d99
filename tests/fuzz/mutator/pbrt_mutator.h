#pragma once
// Changes pbrt scenes in ways that keep their syntax: most mutations of bytes end in the first syntax error,
// and never reach what reads the values.

#include <cstdint>
#include <string>
#include <string_view>

namespace kaustik::fuzz {

// One to four changes: of directives (swap, duplicate, delete, another word, a new one), parameters
// (likewise, by the names and types of the schema) and values (extreme numbers, other counts, names of the
// scene). The result depends on text and seed only, and has at most max_size bytes.
std::string mutate_pbrt(std::string_view text, size_t max_size, uint32_t seed);

// A part of `from` in place of, or between, directives of `into`.
std::string splice_pbrt(std::string_view into, std::string_view from, size_t max_size, uint32_t seed);

}  // namespace kaustik::fuzz
