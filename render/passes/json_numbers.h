#pragma once
// Whole numbers in JSON, checked: the JSON library converts fractions, negative and large numbers to whatever
// number of the wanted type results.

#include <fmt/format.h>

#include <concepts>
#include <cstdint>
#include <limits>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string_view>
#include <utility>

namespace kaustik::render {

// The value as a whole number from least to most. Throws std::runtime_error, which names the key, for any
// other value.
template <std::integral Int>
Int whole_number(const nlohmann::ordered_json& value, std::string_view key,
                 Int least = std::numeric_limits<Int>::min(), Int most = std::numeric_limits<Int>::max()) {
  const auto inside = [&](auto number) {
    return std::cmp_less_equal(least, number) && std::cmp_less_equal(number, most);
  };
  // Numbers below zero are kept as int64_t, the others as uint64_t.
  if (value.is_number_unsigned()) {
    if (const auto number = value.get<uint64_t>(); inside(number)) return static_cast<Int>(number);
  } else if (value.is_number_integer()) {
    if (const auto number = value.get<int64_t>(); inside(number)) return static_cast<Int>(number);
  }
  throw std::runtime_error(fmt::format("\"{}\": expected a whole number, {} to {}", key, least, most));
}

// Stores the whole number in the member `key` of an object. Throws std::runtime_error, or an exception of the
// JSON library if there is no such member.
template <std::integral Int>
void take_whole(const nlohmann::ordered_json& object, std::string_view key, Int* out) {
  *out = whole_number<Int>(object.at(std::string(key)), key);
}

}  // namespace kaustik::render
