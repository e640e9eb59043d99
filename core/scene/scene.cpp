// Computes the derived members of a scene.

#include "core/scene/scene.h"

namespace kaustik {
namespace {

// Sets the bounding sphere of the scene on lights outside it. The sphere is slightly larger than the box
// requires, so that rounding leaves nothing outside.
void set_scene_sphere(std::vector<Light>& lights, const Bounds3& bounds) {
  if (bounds.empty()) return;
  const Point3 center = bounds.center();
  const float radius = bounds.radius() * (1 + gamma_bound(16)) + gamma_bound(16) * max_abs_component(center);
  for (Light& light : lights) {
    std::visit(
        [&](auto& l) {
          if constexpr (requires { l.scene_radius; }) {
            l.scene_center = center;
            l.scene_radius = radius;
          }
        },
        light);
  }
}

// Whether surfaces of this material scatter nothing at all, like the body of a lamp.
bool scatters_nothing(const Material& material) {
  if (!material.constant()) return false;
  const auto* diffuse = std::get_if<Lambertian>(&material.typical());
  return diffuse && is_black(diffuse->reflectance);
}

SceneNeeds needs_of(const Scene& scene) {
  SceneNeeds needs;
  for (const Shape& shape : scene.shapes) {
    const Material& material = scene.materials[shape.material];
    if (scatters_nothing(material)) continue;
    const Lobes parts = material.lobes();
    needs.specular |= parts.specular;
    needs.delta |= parts.specular && !parts.glossy;
    needs.glossy |= parts.glossy && !parts.diffuse && !transmits(material.typical());
    needs.diffuse |= parts.diffuse;
  }
  needs.media = scene.camera_medium != kVacuum || !scene.light_media.empty() ||
                std::any_of(scene.shapes.begin(), scene.shapes.end(),
                            [](const Shape& s) { return s.media.is_transition(); });
  needs.any_light = !scene.lights.empty();
  needs.infinite_light = !scene.infinite_lights.empty();
  needs.sky_alone = needs.any_light && scene.infinite_lights.size() == scene.lights.size();
  needs.only_delta_lights =
      needs.any_light && std::all_of(scene.lights.begin(), scene.lights.end(), is_delta);
  return needs;
}

}  // namespace

void finalize_scene(Scene& scene) {
  scene.bounds = Bounds3();
  for (const Shape& shape : scene.shapes) scene.bounds.add(bounds_of(shape));
  set_scene_sphere(scene.lights, scene.bounds);
  scene.light_power = light_power_distribution(scene.lights);
  scene.light_sampler = LightSampler(scene.lights);
  const auto in_vacuum = [](MediumIndex medium) { return medium == kVacuum; };
  if (std::all_of(scene.light_media.begin(), scene.light_media.end(), in_vacuum)) scene.light_media.clear();
  scene.infinite_lights.clear();
  for (size_t i = 0; i < scene.lights.size(); ++i) {
    if (is_infinite(scene.lights[i])) scene.infinite_lights.push_back(static_cast<uint32_t>(i));
  }
  scene.needs = needs_of(scene);
}

}  // namespace kaustik
