#pragma once
// What the maker of a BSDF reads: a material's parameters at one point.

#include <string>
#include <string_view>
#include <vector>

#include "core/texture/texture.h"

namespace kaustik {

class ParameterReader;

// One parameter of a material, as its directive or the schema's defaults say.
struct MaterialInput {
  std::string_view name;  // of the schema
  bool given = false;     // by the directive
  std::vector<double> numbers;
  Rgb rgb{0};  // of colours
  std::string text;
  // What gives the value instead, clamped to the parameter's range [low, high]; where it is none (NaN, or at
  // an end that does not belong to the range) the value is the default.
  uint32_t texture = kNoIndex;
  float low = -kInfinity, high = kInfinity;
  bool low_open = false, high_open = false;

  // Of one component, whose default is `otherwise`.
  float in_range(float value, float otherwise) const;
};

// The inputs of a material, by name. Names must be of the schema's row.
class MaterialInputs {
 public:
  // x: where textures are looked up; without them inputs with textures have their default.
  explicit MaterialInputs(const std::vector<MaterialInput>& inputs, const TextureSet* textures = nullptr,
                          const TexturePoint* x = nullptr)
      : inputs_(inputs), textures_(textures), x_(x) {}

  bool has(std::string_view name) const { return find(name).given; }
  double number(std::string_view name) const;
  bool flag(std::string_view name) const { return number(name) != 0; }
  Rgb rgb(std::string_view name) const;
  const std::string& text(std::string_view name) const { return find(name).text; }  // empty when absent

 private:
  const MaterialInput& find(std::string_view name) const;
  bool from_texture(const MaterialInput& input) const { return input.texture != kNoIndex && x_; }

  const std::vector<MaterialInput>& inputs_;
  const TextureSet* textures_;
  const TexturePoint* x_;
};

// Every parameter of the row that has an effect, without their textures. The directive must have passed
// check_parameters.
std::vector<MaterialInput> material_inputs(const ParameterReader& parameters);

}  // namespace kaustik
