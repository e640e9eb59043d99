// Values of material parameters: from a directive, the schema's default, or a texture.

#include "core/scene/material_inputs.h"

#include <algorithm>
#include <stdexcept>

namespace kaustik {

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

}  // namespace kaustik
