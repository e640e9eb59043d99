#pragma once
// The inputs that every part of a render reads.

#include <span>

#include "accel/bvh.h"
#include "core/scene/scene.h"
#include "render/plan/plan.h"

namespace kaustik::render {

// A view: what it refers to must outlive it.
struct RenderInput {
  const Scene& scene;
  const accel::Bvh& bvh;
  const RenderSettings& settings;
  const EstimatorPlan& plan;
  // Cameras for which photons are guided, divided from paths and given radii, such as those of a
  // sequence, all of the same size; empty: the scene's.
  std::span<const Camera> views{};
};

}  // namespace kaustik::render
