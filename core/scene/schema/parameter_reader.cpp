// Reads the values of checked parameters.

#include <algorithm>

#include "core/scene/schema/schema.h"

namespace kaustik {

namespace {

MaterialInput input_of(const ParameterReader& parameters, const ParameterSpec& spec) {
  MaterialInput input;
  input.name = spec.name;
  input.given = parameters.has(spec.name);
  const Parameter* given = parameters.directive().find(spec.name);
  const bool textured = given && given->type == ParameterType::kTexture;
  input.text = parameters.text(spec.name);
  input.numbers = textured ? spec.defaults : parameters.numbers(spec.name);
  if (textured && input.numbers.empty()) input.numbers = {0, 0, 0};
  if (spec.types.front() == ParameterType::kRgb && !input.numbers.empty()) {
    input.rgb =
        textured ? Rgb(input.numbers[0], input.numbers[1], input.numbers[2]) : parameters.rgb(spec.name);
  }
  input.low = static_cast<float>(spec.range.low);
  input.high = static_cast<float>(spec.range.high);
  input.low_open = spec.range.low_open;
  input.high_open = spec.range.high_open;
  return input;
}

}  // namespace

size_t numbers_per_item(ParameterType type) {
  switch (type) {
    case ParameterType::kPoint2:
    case ParameterType::kVector2:
      return 2;
    case ParameterType::kPoint3:
    case ParameterType::kVector3:
    case ParameterType::kNormal:
    case ParameterType::kRgb:
      return 3;
    default:
      return 1;
  }
}

const ParameterSpec* TypeSpec::find(std::string_view parameter_name) const {
  const auto found = std::find_if(parameters.begin(), parameters.end(),
                                  [&](const ParameterSpec& p) { return p.name == parameter_name; });
  return found == parameters.end() ? nullptr : &*found;
}

const std::vector<double>& ParameterReader::numbers(std::string_view name) const {
  const Parameter* parameter = directive_.find(name);
  return parameter ? parameter->numbers : spec_.find(name)->defaults;
}

double ParameterReader::number(std::string_view name) const {
  return numbers(name).at(0);
}

glm::dvec3 ParameterReader::vec3(std::string_view name, size_t item) const {
  const std::vector<double>& v = numbers(name);
  return v.size() == 1 ? glm::dvec3(v[0])
                       : glm::dvec3(v.at(3 * item), v.at(3 * item + 1), v.at(3 * item + 2));
}

std::string ParameterReader::text(std::string_view name) const {
  const Parameter* parameter = directive_.find(name);
  return parameter && !parameter->strings.empty() ? parameter->strings[0] : std::string();
}

SourceLocation ParameterReader::location(std::string_view name) const {
  const Parameter* parameter = directive_.find(name);
  return parameter ? parameter->value_location(0) : directive_.type_location;
}

std::vector<MaterialInput> material_inputs(const ParameterReader& parameters) {
  std::vector<MaterialInput> inputs;
  for (const ParameterSpec& spec : parameters.spec().parameters) {
    if (spec.state == ParameterState::kUsed) inputs.push_back(input_of(parameters, spec));
  }
  return inputs;
}

}  // namespace kaustik
