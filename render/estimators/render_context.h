#pragma once
// What every estimator reads (const, shared by all threads), and what it counts (one object per tile).

#include "photon/visibility/visibility_tree.h"
#include "render/camera/ray_cone.h"
#include "render/explore/sky_guide.h"
#include "render/maps/photon_maps.h"
#include "render/plan/pass_share.h"
#include "render/plan/render_input.h"
#include "render/statistics/statistics.h"

namespace kaustik::render {

struct RenderContext : RenderInput {
  const PhotonMaps& maps;
  const photon::VisibilityTree* visibility = nullptr;  // null: shadow rays are not predicted
  const SkyGuide* sky = nullptr;                       // null: light samples of skies are not guided
  PassShare pass{};
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
