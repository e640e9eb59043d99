#pragma once
// Suggestions for misspelt names.

#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace kaustik {

// Number of single-character insertions, deletions, substitutions and swaps of neighbours that turn a into b
// (optimal string alignment; Damerau 1964). Upper and lower case count as equal.
size_t edit_distance(std::string_view a, std::string_view b);

// The candidate with the smallest edit distance to name, if it is at most a third of name's length, rounded
// up; the first one of several.
std::optional<std::string_view> nearest_name(std::string_view name,
                                             std::span<const std::string_view> candidates);

// Text to append to an error message about an unknown name: "; did you mean `reflectance`?" when a candidate
// is near, then "; known: a, b, c" when there are at most eight candidates. Empty otherwise.
std::string name_hint(std::string_view name, std::span<const std::string_view> candidates);

}  // namespace kaustik
