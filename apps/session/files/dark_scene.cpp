#include "apps/session/files/dark_scene.h"

#include <algorithm>

namespace kaustik::app {

std::string why_black(const Scene& scene, const SceneDescription& description) {
  const std::string black = "the picture is black: ";
  const double size = scene.bounds.empty() ? 1 : double(scene.bounds.radius());
  const bool shines = std::any_of(scene.lights.begin(), scene.lights.end(),
                                  [&](const Light& light) { return brightness(light, size) > 0; });
  if (shines || scene.needs.emissive_media) return "";
  if (!scene.lights.empty()) return black + "all lights of the scene emit zero";
  if (!description.area_lights.empty())
    return black + "the scene has no light, since no visible shape follows its `AreaLightSource`";
  if (scene.shapes.empty()) return black + "the scene has neither a shape nor a light";
  return black + "the scene has no light and no surface that emits";
}

}  // namespace kaustik::app
