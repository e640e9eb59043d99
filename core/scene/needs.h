#pragma once
// The effects that a scene needs to be rendered.

#include <string>
#include <vector>

namespace kaustik {

// The effects that this scene requires. All others are left out, and the log says so.
struct SceneNeeds {
  bool specular = false;  // some surface has a specular part: caustics are possible
  bool delta = false;     // some specular part is a delta lobe: lights cannot be sampled there
  bool glossy = false;    // some surface has only a glossy lobe, which reflects
  bool diffuse = false;   // some surface that is not black has a diffuse part: photon maps are useful
  bool only_delta_lights = false;  // no ray can hit a light: caustics need photons
  bool infinite_light = false;
  bool sky_alone = false;  // all lights are infinite: visibility is hard to predict
  bool any_light = false;
  bool media = false;           // some space is filled by more than vacuum
  bool scattering = false;      // some of the media scatter light
  bool emissive_media = false;  // some of the media emit light
  bool dispersion = false;      // some surface refracts light by its wavelength

  // One sentence for each effect left out, for example "no specular surface: no caustic pass".
  std::vector<std::string> left_out() const;
};

}  // namespace kaustik
