// Checks parameters against the schema. Every error says what was expected.

#include <fmt/format.h>

#include <algorithm>

#include "core/diagnostics/nearest_name.h"
#include "core/scene/schema/schema.h"

namespace kaustik {
namespace {

struct Context {
  std::string_view noun;
  const TypeSpec& spec;
  WarnedOnce& warned;
  DiagnosticList& diagnostics;

  // For example `material "diffuse"`; options have no type.
  std::string owner() const {
    return spec.name.empty() ? std::string(noun) : fmt::format("{} \"{}\"", noun, spec.name);
  }
};

std::string declaration(std::string_view type, std::string_view name) {
  return fmt::format("\"{} {}\"", type, name);
}

// For example `"rgb reflectance"`, or `"rgb eta" or "float eta"`.
std::string expected_declaration(const ParameterSpec& spec) {
  std::string text;
  for (const ParameterType type : spec.types) {
    if (!text.empty()) text += " or ";
    text += declaration(parameter_type_name(type), spec.name);
  }
  return text;
}

void report_unknown(const Context& c, const Parameter& p) {
  std::vector<std::string_view> names;
  for (const ParameterSpec& spec : c.spec.parameters) {
    if (spec.state == ParameterState::kUsed) names.push_back(spec.name);
  }
  c.diagnostics.error(p.location,
                      fmt::format("{} has no parameter `{}`{}", c.owner(), p.name, name_hint(p.name, names)));
}

bool check_type(const Context& c, const ParameterSpec& spec, const Parameter& p) {
  if (std::find(spec.types.begin(), spec.types.end(), p.type) != spec.types.end()) return true;
  if (spec.state == ParameterState::kIgnored) return true;
  const std::string given = declaration(parameter_type_name(p.type), p.name);
  const std::string expected = expected_declaration(spec);
  switch (p.type) {
    case ParameterType::kTexture:
    case ParameterType::kSpectrum:
    case ParameterType::kBlackbody:
      c.diagnostics.error(p.location,
                          fmt::format("{} is not supported: {} takes only {}", given, c.owner(), expected));
      break;
    default:
      c.diagnostics.error(p.location,
                          fmt::format("{} has the wrong type: {} takes {}", given, c.owner(), expected));
  }
  return false;
}

std::string expected_count(const ParameterSpec& spec, ParameterType type) {
  const size_t n = numbers_per_item(type);
  if (spec.max_items == spec.min_items) {
    const size_t count = n * spec.min_items;
    return fmt::format("{} value{}", count, count == 1 ? "" : "s");
  }
  if (n == 1 && spec.max_items < std::numeric_limits<size_t>::max())
    return fmt::format("{} to {} values", spec.min_items, spec.max_items);
  if (n == 1) return fmt::format("{} values or more", spec.min_items);
  return fmt::format("{} values or more, in groups of {}", n * spec.min_items, n);
}

bool check_count(const Context& c, const ParameterSpec& spec, const Parameter& p) {
  // One or three floats may replace an rgb.
  const bool floats_for_rgb = p.type == ParameterType::kFloat && spec.types.front() == ParameterType::kRgb;
  if (floats_for_rgb && (p.count() == 1 || p.count() == 3)) return true;
  const size_t n = numbers_per_item(p.type);
  if (!floats_for_rgb && p.count() % n == 0 && p.count() / n >= spec.min_items &&
      p.count() / n <= spec.max_items) {
    return true;
  }
  const std::string expected = floats_for_rgb ? "1 or 3 values" : expected_count(spec, p.type);
  c.diagnostics.error(p.location,
                      fmt::format("`{}` of {} takes {}, not {}", p.name, c.owner(), expected, p.count()));
  return false;
}

bool check_range(const Context& c, const ParameterSpec& spec, const Parameter& p) {
  for (size_t i = 0; i < p.numbers.size(); ++i) {
    if (spec.range.contains(p.numbers[i]) || (p.may_have_holes() && std::isnan(p.numbers[i]))) continue;
    c.diagnostics.error(p.value_location(i), fmt::format("`{}` of {} must be {}, not {}", p.name, c.owner(),
                                                         spec.range.text(), p.numbers[i]));
    return false;
  }
  return true;
}

bool is_neutral(const ParameterSpec& spec, const Parameter& p) {
  return spec.neutral && p.strings.empty() &&
         std::all_of(p.numbers.begin(), p.numbers.end(), [&](double v) { return v == *spec.neutral; });
}

void warn_of_unused(const Context& c, const ParameterSpec& spec, const Parameter& p) {
  if (is_neutral(spec, p)) return;
  if (c.warned.insert(fmt::format("{}/{}/{}", c.noun, c.spec.name, p.name)).second) {
    c.diagnostics.warning(p.location, fmt::format("`{}` of {} is ignored: {}", p.name, c.owner(), spec.doc));
  }
}

void warn_of_approximation(const Context& c, const Directive& directive) {
  if (c.spec.approximated.empty()) return;
  if (c.warned.insert(fmt::format("{}/{}", c.noun, c.spec.name)).second)
    c.diagnostics.warning(directive.type_location,
                          fmt::format("{} is approximated: {}", c.owner(), c.spec.approximated));
}

bool check_one(const Context& c, const Parameter& p) {
  const ParameterSpec* spec = c.spec.find(p.name);
  if (!spec) {
    if (p.inherited) return true;  // a default from an enclosing block, meant for other types
    report_unknown(c, p);
    return false;
  }
  if (!check_type(c, *spec, p)) return false;
  if (spec->state != ParameterState::kUsed) {
    warn_of_unused(c, *spec, p);
    return true;
  }
  return check_count(c, *spec, p) && check_range(c, *spec, p);
}

bool check_duplicates(const Context& c, const Directive& directive) {
  bool ok = true;
  for (size_t i = 1; i < directive.parameters.size(); ++i) {
    for (size_t j = 0; j < i; ++j) {
      const Parameter& first = directive.parameters[j];
      const Parameter& second = directive.parameters[i];
      if (first.name != second.name) continue;
      c.diagnostics.error(second.location, fmt::format("`{}` of {} is given twice", second.name, c.owner()),
                          {{first.location, "first given here"}});
      ok = false;
      break;
    }
  }
  return ok;
}

}  // namespace

std::string Range::text() const {
  const bool has_low = std::isfinite(low);
  const bool has_high = std::isfinite(high);
  std::string out = has_low ? fmt::format("{} {}", low_open ? ">" : ">=", low) : "";
  if (has_high) out += fmt::format("{}{} {}", has_low ? " and " : "", high_open ? "<" : "<=", high);
  return out;
}

const TypeSpec* find_type(const Category& category, const Directive& directive, DiagnosticList& diagnostics) {
  std::vector<std::string_view> names;
  for (const TypeSpec* spec : category.types) {
    if (spec->name == directive.type) return spec;
    names.push_back(spec->name);
  }
  const auto& pbrt = category.only_in_pbrt;
  if (std::find(pbrt.begin(), pbrt.end(), directive.type) != pbrt.end()) {
    diagnostics.error(directive.type_location,
                      fmt::format("pbrt's {} \"{}\" is not supported; known: {}", category.noun,
                                  directive.type, fmt::join(names, ", ")));
  } else {
    diagnostics.error(directive.type_location,
                      fmt::format("unknown {} \"{}\"{}", category.noun, directive.type.substr(0, 60),
                                  name_hint(directive.type, names)));
  }
  return nullptr;
}

bool check_parameters(std::string_view noun, const TypeSpec& spec, const Directive& directive,
                      WarnedOnce& warned, DiagnosticList& diagnostics) {
  const Context context{noun, spec, warned, diagnostics};
  warn_of_approximation(context, directive);
  bool ok = check_duplicates(context, directive);
  for (const Parameter& p : directive.parameters) ok = check_one(context, p) && ok;
  return ok;
}

}  // namespace kaustik
