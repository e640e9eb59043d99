#pragma once
// The values of a material's parameters at one point, from which its BSDF is made.

#include <string>
#include <string_view>
#include <vector>

#include "core/texture/texture.h"

namespace kaustik {

// One parameter of a material, with its value from the directive or else the schema's default.
struct MaterialInput {
  std::string_view name;  // the schema's name of the parameter
  bool given = false;     // whether the directive gives it
  std::vector<double> numbers;
  Rgb rgb{0};  // for colours
  std::string text;
  // A texture that gives the value instead. Its values are clamped to the parameter's range [low, high];
  // where a value is NaN, or at an end that is not part of the range, the default is used.
  uint32_t texture = kNoIndex;
  float low = -kInfinity, high = kInfinity;
  bool low_open = false, high_open = false;

  // The value of one component, clamped to the range, or `otherwise` (the default) if it has none.
  float in_range(float value, float otherwise) const;
};

// The inputs of a material, by name. Names must be those of the schema's row.
class MaterialInputs {
 public:
  // x: where textures are looked up. Without textures and x, inputs with textures have their default.
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

}  // namespace kaustik
