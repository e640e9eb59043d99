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

// Whether this holds for a medium that a path may be in: on a side of a surface that separates two, around
// the camera or around a light.
template <class Holds>
bool any_medium(const Scene& scene, const Holds& holds) {
  const auto in_use = [&](MediumIndex m) { return m != kVacuum && holds(scene.media[m]); };
  const auto borders = [&](const Shape& s) {
    return s.media.is_transition() && (in_use(s.media.inside) || in_use(s.media.outside));
  };
  const auto any_of = [](const auto& all, const auto& is) { return std::any_of(all.begin(), all.end(), is); };
  return in_use(scene.camera_medium) || any_of(scene.light_media, in_use) || any_of(scene.shapes, borders) ||
         (scene.interfaces && any_of(scene.interfaces->shapes, borders));
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
    needs.dispersion |= material.is_dispersive();
  }
  needs.media = any_medium(scene, [](const Medium&) { return true; });
  needs.scattering = any_medium(scene, [](const Medium& m) { return m.scatters(); });
  needs.emissive_media = any_medium(scene, [](const Medium& m) { return m.emits(); });
  needs.any_light = !scene.lights.empty();
  needs.infinite_light = !scene.infinite_lights.empty();
  needs.sky_alone = needs.any_light && scene.infinite_lights.size() == scene.lights.size();
  needs.only_delta_lights =
      needs.any_light && std::all_of(scene.lights.begin(), scene.lights.end(), is_delta);
  return needs;
}

std::vector<uint32_t> strongest_lights(const Scene& scene) {
  std::vector<std::pair<float, uint32_t>> by_power;
  for (uint32_t i = 0; i < scene.lights.size(); ++i)
    if (const auto bounds = bounds_of(scene.lights[i]); bounds && bounds->phi > 0)
      by_power.emplace_back(-bounds->phi, i);
  std::sort(by_power.begin(), by_power.end());
  std::vector<uint32_t> strongest;
  for (size_t k = 0; k < std::min(by_power.size(), kMostStrongLights); ++k)
    strongest.push_back(by_power[k].second);
  return strongest;
}

// Only bodies that interfaces bound can be seen straight from outside.
EmissiveBodies emissive_bodies(const Scene& scene) {
  EmissiveBodies bodies;
  if (!scene.interfaces || !scene.needs.emissive_media) return bodies;
  for (const Shape& shape : scene.interfaces->shapes)
    if (const Medium& medium = scene.media[shape.media.inside]; medium.emits())
      bodies.add(bounds_of(shape), medium);
  return bodies;
}

}  // namespace

void finalize_scene(Scene& scene) {
  scene.bounds = Bounds3();
  for (const Shape& shape : scene.shapes) scene.bounds.add(bounds_of(shape));
  if (scene.interfaces) scene.bounds.add(scene.interfaces->bounds);
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
  scene.strongest_lights.clear();
  if (scene.needs.scattering) scene.strongest_lights = strongest_lights(scene);
  scene.emissive_bodies = emissive_bodies(scene);
}

}  // namespace kaustik
