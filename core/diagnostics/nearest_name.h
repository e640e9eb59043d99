#pragma once
// What to say about a name that nobody knows.

#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace kaustik {

// Number of single-character insertions, deletions, substitutions and swaps of neighbours that turn a into b
// (optimal string alignment; Damerau 1964), capital letters counted as equal to small ones.
size_t edit_distance(std::string_view a, std::string_view b);

// The candidate nearest to name, when it is near enough to be what was meant (at most a third of its length
// away, rounded up); the first of equally near ones.
std::optional<std::string_view> nearest_name(std::string_view name,
                                             std::span<const std::string_view> candidates);

// "; did you mean `reflectance`?" when something is near, then "; known: a, b, c" when the list is short
// (eight or fewer). Empty when there is nothing to say. To be appended to a message.
std::string name_hint(std::string_view name, std::span<const std::string_view> candidates);

}  // namespace kaustik
