#pragma once
// Rays as a render traces them: camera rays, photons' rays, shadow rays.

#include <vector>

#include "benchmarks/photon_paths.h"
#include "core/sampling/sampler.h"

namespace kaustik::benchmarks {

// One ray in each of 512 x 256 parts of the picture, in tiles of 16 x 16: neighbouring rays are similar.
inline std::vector<Ray> camera_rays(const Scene& scene) {
  constexpr int kColumns = 512, kRows = 256, kTile = 16;
  const Camera& camera = scene.camera;
  std::vector<Ray> rays;
  for (int tile = 0; tile < (kColumns / kTile) * (kRows / kTile); ++tile) {
    for (int i = 0; i < kTile * kTile; ++i) {
      const int x = tile % (kColumns / kTile) * kTile + i % kTile;
      const int y = tile / (kColumns / kTile) * kTile + i / kTile;
      Sampler sampler(1, rays.size());
      const Point2 at = (Point2(x, y) + sampler.next_2d()) / Point2(kColumns, kRows);
      rays.push_back(camera.generate_ray(at * Point2(camera.width, camera.height)));
    }
  }
  return rays;
}

// Rays from the hits of the camera rays to a point of a light, in the same order.
inline std::vector<Ray> shadow_rays(const Scene& scene, const accel::Bvh& bvh,
                                    const std::vector<Ray>& camera_rays) {
  std::vector<Ray> rays;
  for (size_t i = 0; i < camera_rays.size(); ++i) {
    SurfaceInteraction si;
    if (!bvh.intersect(camera_rays[i], &si)) continue;
    Sampler sampler(2, i);
    const Light& light = scene.lights[scene.light_power.sample(sampler.next_1d()).index];
    const Point2 u = sampler.next_2d();
    const auto s = sample_Li(light, {si.p, si.n, true}, u);
    if (!s) continue;
    Ray ray = si.spawn(s->wi, s->infinite ? kInfinity : 1);
    if (!s->infinite) ray.d = s->p_light - ray.o;
    rays.push_back(ray);
  }
  return rays;
}

inline photon::TraceSettings photon_settings(size_t photons) {
  photon::TraceSettings settings;
  settings.kinds = {true, false, true, true};
  settings.photons = photons;
  return settings;
}

// The first `count` rays of photons of all kinds except shadow, path by path: neighbouring rays have
// unrelated directions.
inline std::vector<Ray> photon_rays(const Scene& scene, const accel::Bvh& bvh, size_t count) {
  std::vector<Ray> rays = record_photon_paths(scene, bvh, photon_settings(count)).rays;
  rays.resize(std::min(rays.size(), count));
  return rays;
}

// The same kind of rays in the packets of the tracer.
inline std::vector<Ray> packet_rays(const Scene& scene, const accel::Bvh& bvh, size_t count) {
  return record_photon_packets(scene, bvh, photon_settings(count), count);
}

}  // namespace kaustik::benchmarks
