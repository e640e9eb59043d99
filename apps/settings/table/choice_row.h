#pragma once
// Rows of the settings table for one of several names.

#include <fmt/ranges.h>

#include <array>

#include "apps/settings/table/rows.h"
#include "core/diagnostics/nearest_name.h"
#include "render/settings/names.h"

namespace kaustik::app {

template <size_t N>
Complaint not_a_choice(const std::string& text, const std::array<std::string_view, N>& names) {
  return fmt::format("`{}` is not a valid value{}", text, name_hint(text, names));
}

// `field` returns a reference to the field of the settings that it gets, const or not: an enum, or an
// optional enum, which the method sets if it is unset.
template <class Enum, class Field, size_t N>
Setting choice_row(std::string_view name, CommandSet commands, Field field,
                   const std::array<std::string_view, N>& names, std::string default_text,
                   std::string_view doc) {
  Setting s{.name = name, .commands = commands, .kind = ValueKind::kChoice, .value_name = "NAME", .doc = doc};
  s.choices.assign(names.begin(), names.end());
  s.range = fmt::format("{}", fmt::join(names, ", "));
  s.default_text = std::move(default_text);
  s.assign = [field, names](Settings& settings, ValueTexts texts) -> Complaint {
    const std::optional<Enum> value = render::from_name<Enum>(names, texts[0]);
    if (!value) return not_a_choice(texts[0], names);
    field(settings) = *value;
    return std::nullopt;
  };
  s.show = [field, names](const Settings& settings) -> std::vector<std::string> {
    const std::optional<Enum> value = field(settings);
    if (!value) return {};
    return as_texts(names[static_cast<size_t>(*value)]);
  };
  return s;
}

// The same for an enum; its default is that of the settings.
template <class Enum, class Field, size_t N>
Setting choice_row(std::string_view name, CommandSet commands, Field field,
                   const std::array<std::string_view, N>& names, std::string_view doc) {
  const Settings defaults;
  return choice_row<Enum>(name, commands, field, names,
                          std::string(names[static_cast<size_t>(field(defaults))]), doc);
}

}  // namespace kaustik::app
