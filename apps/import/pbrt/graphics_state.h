#pragma once
// The state that directives set for the shapes and lights after them (Pharr 2023, appendix C.2).

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "core/scene/description/description.h"
#include "core/spectrum/colour_space.h"

namespace kaustik::pbrt {

// Default parameters that `Attribute` sets for one target. Shared between the states of the stack, so that a
// push copies only a pointer.
using Defaults = std::shared_ptr<const std::vector<Parameter>>;

// Maps a name that was defined again to the unique name of its later definition. In pbrt-v3 a definition ends
// with its block, so files may define a name several times; here all definitions persist.
using LaterNames = std::map<std::string, std::string, std::less<>>;

struct GraphicsState {
  // The current transformation matrix at the time when the shutter opens: object to world; before WorldBegin,
  // world to camera.
  glm::dmat4 ctm{1};
  // After `ActiveTransform EndTime`: transforms apply to the closing shutter only, so they are ignored.
  bool at_end_time = false;
  MaterialReference material;
  std::optional<uint32_t> area_light;
  bool reverse_orientation = false;
  MediaReference media;
  const ColourSpace* colour_space = find_colour_space("srgb");  // of rgb parameters
  std::map<std::string, Defaults, std::less<>>
      defaults;  // by target: "shape", "light", "material", "texture"
  LaterNames float_textures, spectrum_textures, materials;
};

}  // namespace kaustik::pbrt
