// Describes the effects that a scene does not need.

#include "core/scene/needs.h"

namespace kaustik {

std::vector<std::string> SceneNeeds::left_out() const {
  std::vector<std::string> lines;
  if (!any_light && !emissive_media) lines.emplace_back("no light: every estimator is off");
  if (!specular) lines.emplace_back("no specular surface: no caustic pass");
  if (!diffuse) lines.emplace_back("no diffuse surface: no photon map");
  if (!media) lines.emplace_back("no medium: space is empty");
  if (media && !scattering) lines.emplace_back("no medium that scatters light");
  if (media && !emissive_media) lines.emplace_back("no medium that emits light: only lights do");
  if (specular && !dispersion) lines.emplace_back("no dispersion: all light is RGB");
  if (any_light && !infinite_light) lines.emplace_back("no infinite light: escaped rays carry nothing");
  return lines;
}

}  // namespace kaustik
