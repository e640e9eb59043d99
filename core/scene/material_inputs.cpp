#include "core/scene/material_inputs.h"

#include <algorithm>
#include <stdexcept>

#include "core/scene/schema.h"

namespace kaustik {

namespace {

bool is_colour(const ParameterSpec& spec) {
  return spec.types.front() == ParameterType::kRgb;
}

MaterialInput input_of(const ParameterReader& parameters, const ParameterSpec& spec) {
  MaterialInput input;
  input.name = spec.name;
  input.given = parameters.has(spec.name);
  input.text = parameters.text(spec.name);
  input.numbers = parameters.numbers(spec.name);
  if (is_colour(spec) && (input.given || !spec.defaults.empty())) input.rgb = parameters.rgb(spec.name);
  return input;
}

}  // namespace

const MaterialInput& MaterialInputs::find(std::string_view name) const {
  const auto found =
      std::find_if(inputs_.begin(), inputs_.end(), [&](const MaterialInput& i) { return i.name == name; });
  if (found == inputs_.end()) throw std::logic_error("no such input of a material");
  return *found;
}

std::vector<MaterialInput> material_inputs(const ParameterReader& parameters) {
  std::vector<MaterialInput> inputs;
  for (const ParameterSpec& spec : parameters.spec().parameters) {
    if (spec.state == ParameterState::kUsed) inputs.push_back(input_of(parameters, spec));
  }
  return inputs;
}

}  // namespace kaustik
