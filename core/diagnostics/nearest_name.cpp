// Edit distance, and suggestions made with it.

#include "core/diagnostics/nearest_name.h"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

namespace kaustik {
namespace {

// Longer words are not compared: the time grows with the product of the lengths.
constexpr size_t kLongestName = 64;
constexpr size_t kShortList = 8;

char lower(char c) {
  return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
}

}  // namespace

size_t edit_distance(std::string_view a, std::string_view b) {
  const size_t width = b.size() + 1;
  std::vector<size_t> rows(3 * width);
  size_t *before_last = rows.data(), *last = before_last + width, *row = last + width;
  for (size_t j = 0; j <= b.size(); ++j) last[j] = j;
  for (size_t i = 1; i <= a.size(); ++i) {
    row[0] = i;
    for (size_t j = 1; j <= b.size(); ++j) {
      const bool same = lower(a[i - 1]) == lower(b[j - 1]);
      row[j] = std::min({last[j] + 1, row[j - 1] + 1, last[j - 1] + (same ? 0 : 1)});
      if (i > 1 && j > 1 && lower(a[i - 1]) == lower(b[j - 2]) && lower(a[i - 2]) == lower(b[j - 1])) {
        row[j] = std::min(row[j], before_last[j - 2] + 1);
      }
    }
    std::swap(before_last, last);
    std::swap(last, row);
  }
  return last[b.size()];
}

std::optional<std::string_view> nearest_name(std::string_view name,
                                             std::span<const std::string_view> candidates) {
  if (name.size() > kLongestName) return std::nullopt;
  std::optional<std::string_view> best;
  size_t best_distance = (name.size() + 2) / 3 + 1;
  for (const std::string_view candidate : candidates) {
    if (candidate.size() > kLongestName) continue;
    // Each letter that one name has more than the other is an insertion or a deletion.
    const auto [shorter, longer] = std::minmax({name.size(), candidate.size()});
    if (longer - shorter >= best_distance) continue;
    const size_t distance = edit_distance(name, candidate);
    if (distance < best_distance) {
      best_distance = distance;
      best = candidate;
    }
  }
  return best;
}

std::string name_hint(std::string_view name, std::span<const std::string_view> candidates) {
  std::string hint;
  const auto nearest = nearest_name(name, candidates);
  if (nearest) {
    hint += fmt::format("; did you mean `{}`?", *nearest);
  }
  const size_t said = nearest ? 1 : 0;
  if (candidates.size() > said && candidates.size() <= kShortList) {
    hint += fmt::format("{} known: {}", hint.empty() ? ";" : "", fmt::join(candidates, ", "));
  }
  return hint;
}

}  // namespace kaustik
