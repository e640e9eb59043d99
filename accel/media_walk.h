#pragma once
// The media along a ray. Surfaces that only separate media, those of material "interface", are not there for
// rays (Scene::interfaces); here they are found.

#include "accel/bvh.h"
#include "core/scene/media.h"

namespace kaustik::accel {

// Accelerators of tests need not know interfaces.
template <class Accel>
const Bvh* interfaces_of(const Accel& accel) {
  if constexpr (requires { accel.interfaces(); }) return accel.interfaces();
  return nullptr;
}

// A ray passes at most this many interfaces, far more than a real scene has in a row.
inline constexpr int kMostInterfaces = 1 << 12;
// Interfaces this near to an end of a ray, as a share of its coordinates, are part of the surface there.
inline constexpr float kSlack = 0x1p-18f;

// Calls part(medium, begin, end) for one part of the ray after the other, in metres from its start to
// `distance`, which may be infinite. Each lies in one medium; those in the vacuum are left out. Stops where
// it returns false. ray: of unit direction; medium: where it starts. Returns the medium in which it ends.
template <class Fn>
MediumIndex walk_media(const Bvh* interfaces, const Ray& ray, float distance, MediumIndex medium,
                       const Fn& part) {
  float begin = 0;
  const auto go_on = [&](float end) { return medium == kVacuum || part(medium, begin, end); };
  if (interfaces) {
    Ray rest{ray.o, ray.d, distance};
    for (int i = 0; i < kMostInterfaces; ++i) {
      const Hit hit = interfaces->intersect(rest);
      if (!hit.valid()) break;
      const SurfaceInteraction si = make_interaction(interfaces->scene().shapes, rest, hit);
      const float end = std::min(begin + hit.t, distance);
      // Where an interface lies in the surface that the ray leaves or meets, such as the bottom of smoke that
      // stands on a floor, rounding would decide about it.
      const float slack = kSlack * (max_abs_component(ray.o) + end);
      if (distance - end <= slack) break;
      rest = si.spawn(ray.d, distance - end);
      if (end <= slack) continue;
      if (!go_on(end)) return medium;
      const MediumInterface& media = interfaces->scene().shapes[si.shape].media;
      medium = glm::dot(ray.d, si.n) > 0 ? media.outside : media.inside;
      begin = end;
    }
  }
  go_on(distance);
  return medium;
}

// The medium in which a photon of this light starts, along its ray. A light that is infinitely far shines in
// the medium on the near side of the first interface that its ray meets, whatever medium it is declared in,
// since light samples walk from the other end and end there, too. Where no interface is met, or a surface
// comes before it, the light is in its own medium.
template <class Accel>
MediumIndex medium_at_start(const Scene& scene, const Accel& accel, uint32_t light, const Ray& ray) {
  const MediumIndex declared = medium_of_light(scene, light);
  const Bvh* const interfaces = interfaces_of(accel);
  if (!interfaces || bounds_of(scene.lights[light])) return declared;
  const Hit hit = interfaces->intersect(ray);
  if (!hit.valid() || accel.occluded(Ray{ray.o, ray.d, hit.t})) return declared;
  const SurfaceInteraction si = make_interaction(interfaces->scene().shapes, ray, hit);
  const MediumInterface& media = interfaces->scene().shapes[si.shape].media;
  return glm::dot(ray.d, si.n) > 0 ? media.inside : media.outside;
}

// The share of light that gets from the ray's start to `distance`. medium: in, out: where it starts and ends.
inline Rgb transmittance(const Scene& scene, const Bvh* interfaces, const Ray& ray, float distance,
                         MediumIndex* medium) {
  Rgb left(1);
  *medium = walk_media(interfaces, ray, distance, *medium, [&](MediumIndex m, float begin, float end) {
    left *= kaustik::transmittance(scene.media[m], ray, begin, end);
    return true;
  });
  return left;
}

// The radiance that media emit towards the ray's start, from all its parts up to `distance`. medium: where it
// starts.
inline Rgb emitted_radiance(const Scene& scene, const Bvh* interfaces, const Ray& ray, float distance,
                            MediumIndex medium) {
  Rgb sum(0), left(1);
  walk_media(interfaces, ray, distance, medium, [&](MediumIndex m, float begin, float end) {
    const float column = column_of(scene.media[m], ray, begin, end);
    sum += left * kaustik::emitted_radiance(scene.media[m], column);
    left *= kaustik::transmittance(scene.media[m], column);
    return true;
  });
  return sum;
}

}  // namespace kaustik::accel
