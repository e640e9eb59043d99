#include "apps/import/obj/obj_text.h"

#include <algorithm>
#include <charconv>
#include <cstdlib>
#include <cstring>
#include <limits>

namespace kaustik::obj {
namespace {

// Rare forms that std::from_chars does not read.
std::optional<double> unusual_number(std::string_view word) {
  const std::string text(word);
  if (text.find(".#") != text.npos) return std::numeric_limits<double>::quiet_NaN();
  std::string with_point = text;
  std::replace(with_point.begin(), with_point.end(), ',', '.');
  double value = 0;
  const char* const end = with_point.data() + with_point.size();
  const auto [at, error] = std::from_chars(with_point.data(), end, value);
  if (at != end || at == with_point.data()) return std::nullopt;
  // Beyond the range of double: infinite, or too near to zero.
  return error == std::errc() ? value : std::strtod(with_point.c_str(), nullptr);
}

bool is_continued(std::string_view line) {
  while (!line.empty() && line.back() == '\r') line.remove_suffix(1);
  return !line.empty() && line.back() == '\\';
}

bool has_numbers(std::string_view line) {
  const std::string_view word = Words(line).next();
  return word == "v" || word == "vt" || word == "vn" || word == "f" || word == "l" || word == "p";
}

std::string_view first_line(std::string_view& text) {
  const auto* const end = static_cast<const char*>(std::memchr(text.data(), '\n', text.size()));
  const size_t length = end ? size_t(end - text.data()) : text.size();
  const std::string_view line = text.substr(0, length);
  text.remove_prefix(std::min(length + 1, text.size()));
  return line;
}

}  // namespace

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && is_blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && is_blank(text.back())) text.remove_suffix(1);
  return text;
}

std::optional<double> number_of(std::string_view word) {
  if (word.size() > 1 && word[0] == '+' && word[1] != '-') word.remove_prefix(1);
  double value = 0;
  const char* const end = word.data() + word.size();
  const auto [at, error] = std::from_chars(word.data(), end, value);
  if (error == std::errc() && at == end) return value;
  return unusual_number(word);
}

std::string_view take_line(std::string_view& text, std::string& joined, uint32_t& lines) {
  std::string_view line = first_line(text);
  lines = 1;
  if (!is_continued(line) || !has_numbers(line)) return line;
  joined.clear();
  for (;; line = first_line(text), ++lines) {
    joined += line;
    if (!is_continued(line) || text.empty()) break;
    joined[joined.find_last_of('\\')] = ' ';
    joined += ' ';  // the line end
  }
  return joined;
}

}  // namespace kaustik::obj
