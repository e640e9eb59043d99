#pragma once
// What the maker of a BSDF reads: a material's parameters at one point.

#include <string>
#include <string_view>
#include <vector>

#include "core/geometry/shape.h"
#include "core/math/vec.h"

namespace kaustik {

class ParameterReader;

// One parameter of a material, as its directive or the schema's defaults say.
struct MaterialInput {
  std::string_view name;  // of the schema
  bool given = false;     // by the directive
  std::vector<double> numbers;
  Rgb rgb{0};  // of colours
  std::string text;
};

// The inputs of a material, by name. Names must be of the schema's row.
class MaterialInputs {
 public:
  explicit MaterialInputs(const std::vector<MaterialInput>& inputs) : inputs_(inputs) {}

  bool has(std::string_view name) const { return find(name).given; }
  double number(std::string_view name) const { return find(name).numbers.at(0); }
  bool flag(std::string_view name) const { return number(name) != 0; }
  Rgb rgb(std::string_view name) const { return find(name).rgb; }
  const std::string& text(std::string_view name) const { return find(name).text; }  // empty when absent

 private:
  const MaterialInput& find(std::string_view name) const;

  const std::vector<MaterialInput>& inputs_;
};

// Every parameter of the row that has an effect. The directive must have passed check_parameters.
std::vector<MaterialInput> material_inputs(const ParameterReader& parameters);

}  // namespace kaustik
