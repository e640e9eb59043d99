#pragma once
// Suggestions for misspelt names.

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace kaustik {

// Number of single-character insertions, deletions, substitutions and swaps of neighbours that turn a into b
// (optimal string alignment; Damerau 1964). Upper and lower case of A to Z count as equal.
size_t edit_distance(std::string_view a, std::string_view b);

// The candidate with the smallest edit distance to name, if it is at most a third of name's length, rounded
// up; the first one of several.
std::optional<std::string_view> nearest_name(std::string_view name,
                                             std::span<const std::string_view> candidates);

// Text to append to an error message about an unknown name: "; did you mean `reflectance`?" when a candidate
// is near, then "; known: a, b, c" when there are at most eight candidates. Empty otherwise.
std::string name_hint(std::string_view name, std::span<const std::string_view> candidates);

// The keys of a map by name, which stay where they are.
template <class Map>
std::vector<std::string_view> keys_of(const Map& map) {
  std::vector<std::string_view> keys;
  keys.reserve(map.size());
  for (const auto& [key, value] : map) keys.emplace_back(key);
  return keys;
}

}  // namespace kaustik
