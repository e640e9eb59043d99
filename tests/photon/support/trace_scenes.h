#pragma once
// Small scenes made in code for the photon tests, and a sink that keeps everything.

#include <array>
#include <vector>

#include "core/spectrum/refractive_index.h"
#include "photon/trace/tracer.h"
#include "tests/support/density_grids.h"
#include "tests/support/shapes.h"

namespace kaustik::test {

// The inside of the cube [-s, s]^3, each face with its own surface group.
inline void add_box(Scene& scene, float s, uint32_t material = 0) {
  const Vector3 x(2 * s, 0, 0), y(0, 2 * s, 0), z(0, 0, 2 * s);
  const Point3 low(-s), high(s);
  for (Shape face : {parallelogram(low, x, y), parallelogram(low, y, z), parallelogram(low, z, x),
                     parallelogram(high, -y, -x), parallelogram(high, -z, -y), parallelogram(high, -x, -z)}) {
    face.material = material;
    face.surface_group = static_cast<uint32_t>(scene.shapes.size());
    scene.shapes.push_back(std::move(face));
  }
}

// Adds a shape that emits radiance L on its outside.
inline void add_light(Scene& scene, Shape shape, const Rgb& L) {
  make_light(scene, shape, L);
  scene.shapes.push_back(std::move(shape));
}

// A closed diffuse room of half width `s` with a square light under its ceiling, facing down, of power
// pi L s^2 / 4.
inline Scene lit_room(const Rgb& reflectance, const Rgb& L, float s = 1) {
  Scene scene;
  scene.materials = {Lambertian{reflectance}};
  add_box(scene, s);
  add_light(scene, parallelogram({-0.25f * s, 0.9f * s, -0.25f * s}, {0.5f * s, 0, 0}, {0, 0, 0.5f * s}), L);
  finalize_scene(scene);
  return scene;
}

// The room of lit_room with a glass sphere, a mirror sphere and a tilted parallelogram: it gives every kind
// of photon.
inline Scene full_room(float s = 1) {
  Scene scene;
  scene.materials = {Lambertian{Rgb(0.7f, 0.5f, 0.6f)}, Dielectric{1.5f}, Mirror{Rgb(0.9f)},
                     OrenNayar::from_sigma_degrees(Rgb(0.5f), 20)};
  add_box(scene, s);
  scene.shapes.push_back(sphere({-0.4f * s, -0.6f * s, 0.1f * s}, 0.35f * s, 1));
  scene.shapes.push_back(sphere({0.5f * s, -0.3f * s, -0.3f * s}, 0.3f * s, 2));
  scene.shapes.push_back(
      parallelogram({0.1f * s, -0.2f * s, 0.2f * s}, {0.5f * s, 0.1f * s, 0}, {0, 0.2f * s, 0.5f * s}, 3));
  add_light(scene, parallelogram({-0.25f * s, 0.9f * s, -0.25f * s}, {0.5f * s, 0, 0}, {0, 0, 0.5f * s}),
            Rgb(3, 2, 1));
  finalize_scene(scene);
  return scene;
}

// Fills the scene with a medium, which its lights shine in.
inline void fill(Scene& scene, const Medium& medium) {
  scene.media = {Medium{}, medium};
  scene.light_media.assign(scene.lights.size(), 1);
  finalize_scene(scene);
}

// The full room with glass that disperses, in a fog that is denser here than there: every kind of photon of
// all.
inline Scene foggy_room(float s = 1) {
  Scene scene = full_room(s);
  scene.materials[1].disperse(std::make_shared<const Spectrum>(abbe_index(1.5, 20)));
  const auto density = grid_of({5, 9, 20}, glm::dvec3(-1.25 * double(s)), glm::dvec3(1.25 * double(s)),
                               [&](const glm::dvec3& p) { return 1 + std::sin(5 * p.x / double(s)); });
  fill(scene, {Rgb(0.1f, 0.2f, 0) / s, Rgb(0.4f, 0.2f, 0.3f) / s, 0.3f, density});
  return scene;
}

using Photons = std::array<std::vector<photon::Photon>, photon::kPhotonKinds>;

struct Traced {
  Photons photons;
  photon::TraceCounters counters;
  const std::vector<photon::Photon>& operator[](photon::PhotonKind k) const {
    return photons[static_cast<size_t>(k)];
  }
};

inline Traced trace_all(const Scene& scene, const photon::TraceSettings& settings) {
  const accel::Bvh bvh(scene);
  Traced traced;
  const auto sink = [&](photon::PhotonKind k, const photon::Photon& p) {
    traced.photons[static_cast<size_t>(k)].push_back(p);
  };
  for (uint64_t i = 0; i < settings.photons; ++i) {
    photon::trace_photon(scene, bvh, settings, i, sink, traced.counters);
  }
  return traced;
}

inline photon::TraceSettings settings_for(uint64_t photons, const photon::KindMask& kinds) {
  photon::TraceSettings settings;
  settings.seed = 1;
  settings.photons = photons;
  settings.kinds = kinds;
  return settings;
}
inline constexpr photon::KindMask kAllKinds{true, true, true, true, true, true};

inline glm::dvec3 total_flux(const std::vector<photon::Photon>& photons) {
  glm::dvec3 sum(0);
  for (const auto& p : photons) sum += glm::dvec3(p.flux);
  return sum;
}

}  // namespace kaustik::test
