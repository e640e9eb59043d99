#pragma once
// Functions that make the entries of the schema's tables.

#include "core/scene/schema/schema.h"

namespace kaustik::spec {

inline constexpr Range kAnyNumber{};
inline constexpr Range kNotNegative{0};
inline constexpr Range kPositive{0, std::numeric_limits<double>::infinity(), true, false};
inline constexpr Range kUnit{0, 1};

inline ParameterSpec of_type(ParameterType type, std::string_view name, std::vector<double> defaults,
                             std::string_view unit, const Range& range, std::string_view doc) {
  ParameterSpec p;
  p.name = name;
  p.types = {type};
  p.defaults = std::move(defaults);
  p.unit = unit;
  p.range = range;
  p.doc = doc;
  return p;
}
inline ParameterSpec number(std::string_view name, double value, std::string_view unit, const Range& range,
                            std::string_view doc) {
  return of_type(ParameterType::kFloat, name, {value}, unit, range, doc);
}
inline ParameterSpec integer(std::string_view name, double value, std::string_view unit, const Range& range,
                             std::string_view doc) {
  return of_type(ParameterType::kInteger, name, {value}, unit, range, doc);
}
inline ParameterSpec rgb(std::string_view name, double value, std::string_view unit, const Range& range,
                         std::string_view doc) {
  return of_type(ParameterType::kRgb, name, {value, value, value}, unit, range, doc);
}
inline ParameterSpec point(std::string_view name, const glm::dvec3& p, std::string_view doc) {
  return of_type(ParameterType::kPoint3, name, {p.x, p.y, p.z}, "m", kAnyNumber, doc);
}
inline ParameterSpec flag(std::string_view name, bool value, std::string_view doc) {
  return of_type(ParameterType::kBool, name, {value ? 1.0 : 0.0}, "", kAnyNumber, doc);
}
inline ParameterSpec text(std::string_view name, std::string_view default_text, std::string_view doc) {
  ParameterSpec p = of_type(ParameterType::kString, name, {}, "", kAnyNumber, doc);
  p.default_text = default_text;
  return p;
}
// A list of items, for example vertices.
inline ParameterSpec list(ParameterType type, std::string_view name, size_t min_items,
                          std::string_view default_text, std::string_view unit, std::string_view doc) {
  ParameterSpec p = of_type(type, name, {}, unit, kAnyNumber, doc);
  p.min_items = min_items;
  p.max_items = std::numeric_limits<size_t>::max();
  p.default_text = default_text;
  return p;
}
// Also accepts "texture name" "of a texture": float textures for numbers, spectrum textures for colours.
inline ParameterSpec textured(ParameterSpec p) {
  p.types.push_back(ParameterType::kTexture);
  return p;
}
// Removes the default and shows this text in its place; the function that makes the object asks whether the
// parameter is given.
inline ParameterSpec without_default(ParameterSpec p, std::string_view default_text) {
  p.defaults.clear();
  p.default_text = default_text;
  return p;
}

// A parameter of pbrt without effect in this program. It accepts every type that pbrt allows, so that all it
// causes is a warning.
inline ParameterSpec ignored(std::string_view name, std::vector<ParameterType> types, std::string_view doc,
                             std::optional<double> neutral = std::nullopt) {
  ParameterSpec p;
  p.name = name;
  p.types = std::move(types);
  p.min_items = 0;
  p.max_items = std::numeric_limits<size_t>::max();
  p.doc = doc;
  p.state = ParameterState::kIgnored;
  p.neutral = neutral;
  return p;
}

}  // namespace kaustik::spec
