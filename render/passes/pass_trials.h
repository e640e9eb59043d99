#pragma once
// What a pass takes on this machine, found by trying: with few photons, and with few samples of windows that
// lie all over the picture. All functions within the render's task arena.

#include "accel/bvh.h"
#include "render/maps/photon_maps.h"
#include "render/renderer.h"

namespace kaustik::render {

// Photons of the first pass, shot beforehand, and how they are read.
struct FirstPhotons {
  PhotonMaps maps;
  std::optional<GatherRadii> radii;
  RenderStatistics statistics;
};

// Wall seconds of the photons of a pass.
struct PhotonCost {
  double fixed = 0, each = 0;  // each above 0
};

// Of the samples of every pixel: of so many, and of further ones that take `adaptive` times their work
// (RenderSettings).
struct SampleCost {
  double fixed = 0, each = 0, further = 0;
  double of(double spp, double adaptive) const { return fixed + spp * (each + adaptive * further); }
};

// A line through the seconds of 2^14 and of 2^16 photons, or of one sample with further ones of this much
// work, of four without, and of four with them. Flatter than half of what the larger trial took for each, it
// is noise.
PhotonCost photon_cost(double few, double more);
SampleCost sample_cost(double one, double four, double four_further, double adaptive);

struct PhotonTrial {
  PhotonCost cost;
  FirstPhotons photons;
};

// Shoots few, and more where few took less than `most` seconds.
PhotonTrial try_photons(const Scene& scene, const accel::Bvh& bvh, const RenderSettings& settings,
                        const EstimatorPlan& plan, double most, const ProgressCallback& progress);

// Those of the only pass of these settings. What is not there when progress cancels is empty.
FirstPhotons shoot_first(const Scene& scene, const accel::Bvh& bvh, const RenderSettings& settings,
                         const EstimatorPlan& plan, const ProgressCallback& progress);

// One sample with these photons, and four where one took less than `most` seconds. Says nothing where the
// photons are not there.
SampleCost try_samples(const Scene& scene, const accel::Bvh& bvh, const RenderSettings& settings,
                       const EstimatorPlan& plan, double most, FirstPhotons* photons);

}  // namespace kaustik::render
