#pragma once
#include <string>
#include <vector>

namespace kaustik {

// What must be modelled for this scene; everything else is left out, and the log says so.
struct SceneNeeds {
  bool specular = false;           // some surface has a part that is followed: caustics exist
  bool delta = false;              // some of them by a delta lobe: lights cannot be sampled there
  bool diffuse = false;            // some surface has a broad part: photon maps are of use
  bool only_delta_lights = false;  // paths cannot hit a light: caustics need photons
  bool infinite_light = false;
  bool sky_alone = false;  // every light is infinite: little can be predicted of what is seen
  bool any_light = false;

  // One sentence per thing left out, e.g. "no specular surface: no caustic pass".
  std::vector<std::string> left_out() const;
};

}  // namespace kaustik
