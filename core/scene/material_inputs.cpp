// Values of material parameters: from a directive, the schema's default, or a texture.

#include "core/scene/material_inputs.h"

#include <algorithm>
#include <stdexcept>

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

float MaterialInput::in_range(float value, float otherwise) const {
  if (!(value >= low)) value = value < low ? low : otherwise;
  value = std::min(value, high);
  return (low_open && value == low) || (high_open && value == high) ? otherwise : value;
}

const MaterialInput& MaterialInputs::find(std::string_view name) const {
  const auto found =
      std::find_if(inputs_.begin(), inputs_.end(), [&](const MaterialInput& i) { return i.name == name; });
  if (found == inputs_.end()) throw std::logic_error("no such input of a material");
  return *found;
}

double MaterialInputs::number(std::string_view name) const {
  const MaterialInput& input = find(name);
  if (!from_texture(input)) return input.numbers.at(0);
  const auto otherwise = static_cast<float>(input.numbers.at(0));
  return static_cast<double>(input.in_range(textures_->evaluate_float(input.texture, *x_), otherwise));
}

Rgb MaterialInputs::rgb(std::string_view name) const {
  const MaterialInput& input = find(name);
  if (!from_texture(input)) return input.rgb;
  Rgb value = textures_->evaluate(input.texture, *x_);
  for (int c = 0; c < 3; ++c) value[c] = input.in_range(value[c], input.rgb[c]);
  return value;
}

std::vector<MaterialInput> material_inputs(const ParameterReader& parameters) {
  std::vector<MaterialInput> inputs;
  for (const ParameterSpec& spec : parameters.spec().parameters) {
    if (spec.state == ParameterState::kUsed) inputs.push_back(input_of(parameters, spec));
  }
  return inputs;
}

}  // namespace kaustik
