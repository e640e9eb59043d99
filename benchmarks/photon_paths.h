#pragma once
// Records the rays of photons, so that others can walk or replay them.

#include <vector>

#include "photon/shoot/shoot.h"

namespace kaustik::benchmarks {

// The rays of all photons in order; first[i] is the first of photon i, with one more entry at the end.
struct PhotonPaths {
  std::vector<Ray> rays;
  std::vector<size_t> first;

  size_t size() const { return first.size() - 1; }
};

// The rays of photons 0 ... settings.photons - 1, traced one after the other.
inline PhotonPaths record_photon_paths(const Scene& scene, const accel::Bvh& bvh,
                                       const photon::TraceSettings& settings) {
  // Passes rays on to the BVH and records them.
  struct Recorder {
    const accel::Bvh& bvh;
    PhotonPaths& paths;
    Hit intersect(const Ray& ray) const {
      paths.rays.push_back(ray);
      return bvh.intersect(ray);
    }
    bool occluded(const Ray& ray) const { return bvh.occluded(ray); }
  };
  PhotonPaths paths;
  photon::TraceCounters counters;
  const auto nothing = [](photon::PhotonKind, const photon::Photon&) {};
  for (uint64_t i = 0; i < settings.photons; ++i) {
    paths.first.push_back(paths.rays.size());
    photon::trace_photon(scene, Recorder{bvh, paths}, settings, i, nothing, counters);
  }
  paths.first.push_back(paths.rays.size());
  return paths;
}

// The first `count` rays of the full packets of 16 that the tracer asks for when it traces many photons, in
// its order.
inline std::vector<Ray> record_photon_packets(const Scene& scene, const accel::Bvh& bvh,
                                              const photon::TraceSettings& settings, size_t count) {
  struct Recorder {
    const accel::Bvh& bvh;
    std::vector<Ray>& rays;
    void intersect(const accel::RayLanes& lanes, size_t asked, accel::HitLanes* hits) const {
      for (size_t k = 0; k < asked / 16 * 16; ++k) rays.push_back(lanes.get(k));
      bvh.intersect(lanes, asked, hits);
    }
    Hit intersect(const Ray& ray) const { return bvh.intersect(ray); }
    bool occluded(const Ray& ray) const { return bvh.occluded(ray); }
  };
  std::vector<Ray> rays;
  photon::TraceCounters counters;
  const auto nothing = [](photon::PhotonKind, const photon::Photon&) {};
  const uint64_t block = photon::kShootBlock;
  for (uint64_t first = 0; first < settings.photons && rays.size() < count; first += block) {
    photon::trace_photons(scene, Recorder{bvh, rays}, settings, first,
                          std::min(first + block, settings.photons), nothing, counters);
  }
  rays.resize(std::min(rays.size(), count));
  return rays;
}

}  // namespace kaustik::benchmarks
