#pragma once
// The media along a path: as in pbrt, a path stays in one until it crosses a surface that separates two.

#include "core/scene/scene.h"

namespace kaustik {

// The medium in which a light shines.
inline MediumIndex medium_of_light(const Scene& scene, uint32_t light) {
  return scene.light_media.empty() ? kVacuum : scene.light_media[light];
}

// The medium of a ray that leaves si in direction w. `current`: that of the ray which has led to si from wo's
// side. What is reflected stays in its medium, whichever way round the surface is.
inline MediumIndex medium_beyond(const Scene& scene, const SurfaceInteraction& si, const Vector3& wo,
                                 const Vector3& w, MediumIndex current) {
  if (!scene.needs.media) return current;
  const MediumInterface& media = scene.shapes[si.shape].media;
  if (!media.is_transition() || glm::dot(wo, si.n) * glm::dot(w, si.n) > 0) return current;
  return glm::dot(w, si.n) > 0 ? media.outside : media.inside;
}

}  // namespace kaustik
