#pragma once
// What every estimator reads (const, shared by all threads), and what it counts (one object per tile).

#include "render/camera/ray_cone.h"
#include "render/maps/photon_maps.h"
#include "render/passes/passes.h"
#include "render/renderer.h"

namespace kaustik::render {

struct RenderContext {
  const Scene& scene;
  const accel::Bvh& bvh;
  const RenderSettings& settings;
  const EstimatorPlan& plan;
  const PhotonMaps& maps;
  PassShare pass;
  PassSamples samples{};
  RayCone cone{};  // cone of a camera ray
};

// Exact counters of one tile; merging them adds integers.
struct TileCounters {
  RayCounters rays;
  LectureCounters lecture;
  photon::GatherCounters gather;
};

}  // namespace kaustik::render
