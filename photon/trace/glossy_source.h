#pragma once
// Glossy surfaces as sources of the light that point, spot and distant lights send them.

#include "core/light/light.h"
#include "core/scene/scene.h"

namespace kaustik::photon {

// A glossy surface that a light meets first. Both directions are local and point away from the surface.
struct GlossyVertex {
  const SurfaceInteraction& si;
  Vector3 to_light;        // world
  Vector3 to_light_local;  // of the light that arrives
  Vector3 onward_local;    // of the light that goes on
};

// Radiance, W/(m^2 sr), that the glossy lobe sends on if nothing hides the light: what the light samples of
// paths find there. Infinite where they find nothing, because rays can hit the light or because the shading
// normal and the surface disagree about the side of the light.
template <class B>
float radiance_of_glossy(const Scene& scene, uint32_t light, const B& bsdf, const GlossyVertex& v) {
  if constexpr (!HasGlossyValue<B>) {
    return kInfinity;
  } else {
    const Light& from = scene.lights[light];
    if (!is_delta(from) || !(glm::dot(v.to_light, v.si.n) * v.to_light_local.z > 0)) return kInfinity;
    const auto s = sample_Li(from, {v.si.p, v.si.n}, {});
    if (!s) return kInfinity;
    const float cos = std::abs(v.to_light_local.z);
    return luminance(bsdf.f_glossy(v.onward_local, v.to_light_local) * s->Li * cos);
  }
}

}  // namespace kaustik::photon
