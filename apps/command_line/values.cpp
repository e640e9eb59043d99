#include "apps/command_line/values.h"
#include "core/spectrum/srgb.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>

namespace kaustik::app {

namespace {

// A decimal number: its digits times 10^exponent.
struct Decimal {
  std::string digits;
  int exponent = 0;
};

bool is_digit(char c) {
  return c >= '0' && c <= '9';
}

// The power of ten of a suffix; zero for any other character.
int suffix_exponent(char c) {
  switch (c) {
    case 'k':
    case 'K':
      return 3;
    case 'M':
      return 6;
    case 'G':
      return 9;
    case 'T':
      return 12;
    default:
      return 0;
  }
}

// Parses `digits [. digits] [e exponent]`; nothing unless this is all of `text`.
std::optional<Decimal> parse_decimal(std::string_view text) {
  Decimal decimal;
  size_t i = 0;
  for (; i < text.size() && is_digit(text[i]); ++i) decimal.digits += text[i];
  if (i < text.size() && text[i] == '.') {
    for (++i; i < text.size() && is_digit(text[i]); ++i, --decimal.exponent) decimal.digits += text[i];
  }
  if (decimal.digits.empty()) return std::nullopt;
  if (i < text.size() && (text[i] == 'e' || text[i] == 'E')) {
    const std::optional<int64_t> power = parse_integer(text.substr(i + 1));
    if (!power || std::abs(*power) > 1000) return std::nullopt;
    decimal.exponent += static_cast<int>(*power);
    i = text.size();
  }
  if (i != text.size()) return std::nullopt;
  return decimal;
}

// Parses a finite number; nothing for other texts.
std::optional<double> parse_double(std::string_view text) {
  double value = 0;
  const char* end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, value);
  if (error != std::errc() || stop != end || text.empty() || !std::isfinite(value)) return std::nullopt;
  return value;
}

constexpr double kMostSeconds = 1e9;  // about thirty years

}  // namespace

std::optional<uint64_t> parse_count(std::string_view text) {
  if (text.empty()) return std::nullopt;
  const int suffix = suffix_exponent(text.back());
  if (suffix > 0) text.remove_suffix(1);
  std::optional<Decimal> decimal = parse_decimal(text);
  if (!decimal) return std::nullopt;
  decimal->exponent += suffix;
  std::string& digits = decimal->digits;
  for (; decimal->exponent < 0 && !digits.empty() && digits.back() == '0'; ++decimal->exponent)
    digits.pop_back();
  if (digits.empty()) return 0;
  if (decimal->exponent < 0) return std::nullopt;
  uint64_t value = 0;
  const auto push = [&value](uint64_t digit) {
    if (value > (std::numeric_limits<uint64_t>::max() - digit) / 10) return false;
    value = 10 * value + digit;
    return true;
  };
  for (const char c : digits) {
    if (!push(static_cast<uint64_t>(c - '0'))) return std::nullopt;
  }
  for (int i = 0; i < decimal->exponent && value != 0; ++i) {
    if (!push(0)) return std::nullopt;
  }
  return value;
}

std::string count_text(uint64_t n) {
  constexpr std::pair<uint64_t, char> kSuffixes[] = {{1000000000, 'G'}, {1000000, 'M'}, {1000, 'k'}};
  for (const auto& [unit, suffix] : kSuffixes) {
    if (n >= unit && n % unit == 0) return fmt::format("{}{}", n / unit, suffix);
  }
  return fmt::format("{}", n);
}

std::optional<int64_t> parse_integer(std::string_view text) {
  if (!text.empty() && text.front() == '+') {
    text.remove_prefix(1);
    if (text.empty() || !is_digit(text.front())) return std::nullopt;
  }
  int64_t value = 0;
  const char* end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, value);
  if (error != std::errc() || stop != end || text.empty()) return std::nullopt;
  return value;
}

std::optional<double> parse_duration(std::string_view text) {
  constexpr std::pair<std::string_view, double> kUnits[] = {{"ms", 1e-3}, {"s", 1}, {"m", 60}, {"h", 3600}};
  for (const auto& [unit, seconds] : kUnits) {
    if (!text.ends_with(unit)) continue;
    const std::optional<double> number = parse_double(text.substr(0, text.size() - unit.size()));
    if (!number || *number < 0 || *number * seconds > kMostSeconds) return std::nullopt;
    return seconds * *number;
  }
  return std::nullopt;
}

std::optional<double> parse_share(std::string_view text) {
  const bool percent = text.ends_with('%');
  if (percent) text.remove_suffix(1);
  const std::optional<double> value = parse_double(text);
  return value && percent ? std::optional(*value / 100) : value;
}

std::vector<std::string> split_at_commas(std::string_view text) {
  std::vector<std::string> parts;
  for (size_t begin = 0; begin <= text.size();) {
    const size_t end = std::min(text.find(',', begin), text.size());
    parts.emplace_back(text.substr(begin, end - begin));
    begin = end + 1;
  }
  return parts;
}

std::optional<float> parse_number(std::string_view text) {
  if (!text.empty() && text.front() == '+') text.remove_prefix(1);
  float value = 0;
  const char* end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, value);
  if (error != std::errc() || stop != end || text.empty() || !std::isfinite(value)) return std::nullopt;
  return value;
}

namespace {

// From "#rrggbb".
std::optional<glm::dvec3> decode_hexadecimal(std::string_view text) {
  uint32_t bits = 0;
  const char* const end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data() + 1, end, bits, 16);
  if (text.size() != 7 || error != std::errc() || stop != end) return std::nullopt;
  glm::dvec3 colour;
  for (int c = 0; c < 3; ++c) colour[c] = linear_from_srgb(((bits >> (16 - 8 * c)) & 255) / 255.0);
  return colour;
}

}  // namespace

std::optional<glm::dvec3> parse_colour(std::string_view text) {
  if (text == "white") return glm::dvec3(1);
  if (text == "grey" || text == "gray") return glm::dvec3(0.5);
  if (text == "black") return glm::dvec3(0);
  if (text.starts_with('#')) return decode_hexadecimal(text);
  const std::vector<std::string> parts = split_at_commas(text);
  if (parts.size() != 1 && parts.size() != 3) return std::nullopt;
  glm::dvec3 colour;
  for (size_t c = 0; c < 3; ++c) {
    const std::optional<float> value = parse_number(parts[parts.size() == 1 ? 0 : c]);
    if (!value || *value < 0) return std::nullopt;
    colour[static_cast<int>(c)] = double(*value);
  }
  return colour;
}

}  // namespace kaustik::app
