#pragma once
// What directives set for the shapes and lights that follow (pharr 2023, appendix C.2).

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "core/scene/description/description.h"
#include "core/spectrum/colour_space.h"

namespace kaustik::pbrt {

// Defaults set by Attribute, by target. Shared between the states of the stack: a push copies a pointer.
using Defaults = std::shared_ptr<const std::vector<Parameter>>;

// Names that were defined again, and what the later definition is called instead. pbrt-v3 forgets definitions
// at the end of the block that they stand in, so that its files use names twice; here all live on.
using LaterNames = std::map<std::string, std::string, std::less<>>;

struct GraphicsState {
  glm::dmat4 ctm{1};  // when the shutter opens: from the current space to the world; before WorldBegin: from
                      // the world to the camera
  bool at_end_time =
      false;  // what follows transforms things as they are when the shutter closes, which is nothing
  MaterialReference material;
  std::optional<uint32_t> area_light;
  bool reverse_orientation = false;
  const ColourSpace* colour_space = find_colour_space("srgb");  // of rgb parameters
  std::map<std::string, Defaults, std::less<>> defaults;        // "shape", "light", "material", "texture"
  LaterNames float_textures, spectrum_textures, materials;
};

}  // namespace kaustik::pbrt
