// Formats the schema as the tables of docs/reference/scene_format.md.

#include <fmt/format.h>

#include "core/scene/schema/schema.h"

namespace kaustik {
namespace {

std::string type_text(const ParameterSpec& p) {
  std::string text;
  for (const ParameterType type : p.types) {
    if (!text.empty()) text += ", ";
    text += parameter_type_name(type);
  }
  if (p.state == ParameterState::kUsed && p.max_items > p.min_items) text += " list";
  if (p.state == ParameterState::kUsed && p.max_items == p.min_items && p.max_items > 1) {
    text += fmt::format(" x {}", p.max_items);
  }
  return text;
}

std::string default_text(const ParameterSpec& p) {
  if (!p.default_text.empty()) return std::string(p.default_text);
  if (p.types.front() == ParameterType::kBool && !p.defaults.empty()) {
    return p.defaults[0] != 0 ? "true" : "false";
  }
  return fmt::format("{}", fmt::join(p.defaults, " "));
}

std::string row(const ParameterSpec& p) {
  std::string meaning(p.doc);
  if (p.state == ParameterState::kIgnored) meaning = "*ignored with a warning:* " + meaning;
  if (p.neutral) meaning += fmt::format(" ({} is accepted without a warning)", *p.neutral);
  return fmt::format("| `{}` | {} | {} | {} | {} | {} |\n", p.name, type_text(p), default_text(p), p.unit,
                     p.range.text(), meaning);
}

std::string description(const TypeSpec& type) {
  if (type.approximated.empty()) return std::string(type.doc);
  return fmt::format("{} *Approximated with a warning:* {}.", type.doc, type.approximated);
}

std::string table(const TypeSpec& type) {
  if (type.parameters.empty()) return "It takes no parameters.\n\n";
  std::string text =
      "| parameter | type | default | unit | range | meaning |\n| --- | --- | --- | --- | --- | --- |\n";
  for (const ParameterSpec& p : type.parameters) text += row(p);
  return text + "\n";
}

}  // namespace

std::string schema_markdown() {
  std::string text;
  for (const Category& c : categories()) {
    text += fmt::format("### {}\n\n", c.directive);
    for (const TypeSpec* type : c.types) {
      text += fmt::format("#### `{} \"{}\"`\n\n{}\n\n{}", c.directive, type->name, description(*type),
                          table(*type));
    }
    if (!c.only_in_pbrt.empty()) {
      text += fmt::format("Types of pbrt that are not supported (an error): `{}`.\n\n",
                          fmt::join(c.only_in_pbrt, "`, `"));
    }
  }
  return text + fmt::format("### Option\n\n{}\n\n{}", option_type().doc, table(option_type()));
}

}  // namespace kaustik
