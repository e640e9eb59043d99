#pragma once
// What a material of pbrt-v3 becomes besides a material of v4.

#include <optional>
#include <vector>

#include "core/scene/description/description.h"

namespace kaustik::pbrt {

struct V3Extras {
  // Materials that the mixture names; they must be defined before it. Their names are unique.
  std::vector<MaterialDescription> parts;
  // `opacity` of v3, which belongs to the shapes: a colour, a spectrum or a texture of colours.
  std::optional<Parameter> opacity;
};

}  // namespace kaustik::pbrt
