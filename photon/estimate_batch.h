#pragma once
// Radiance estimates that wait until there are many: neighbouring searches share their work.

#include <vector>

#include "photon/radiance_estimate.h"

namespace kaustik::photon {

class EstimateBatch {
 public:
  // True when the estimate waits: then flush() adds weight times estimate_radiance() to *radiance, and to
  // *photons how many counted. False, and nothing is done, where it would gain nothing: for BSDFs other than
  // Lambertian, and for searches whose disc depends on the photons. map and settings must live as long.
  bool add(const PhotonMap& map, const SurfaceInteraction& si, const Vector3& wo, const Bsdf& bsdf,
           const EstimateSettings& settings, const Rgb& weight, Rgb* radiance, float* photons);

  // What is added does not depend on what else waits.
  void flush(GatherCounters& counters);

 private:
  struct Waiting {
    const PhotonMap* map;
    const EstimateSettings* settings;
    SurfaceInteraction si;
    Normal3 n;
    uint32_t surface;  // packed, to sort by
    Rgb weight;
    Rgb* radiance;
    float* photons;
  };
  void gather(const Waiting* first, const Waiting* end, GatherCounters& counters);

  std::vector<Waiting> waiting_;
  std::vector<GatherQuery> queries_;
  std::vector<PhotonMap::Gathered> results_;
};

}  // namespace kaustik::photon
