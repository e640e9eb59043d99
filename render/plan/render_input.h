#pragma once
// The inputs that every part of a render reads.

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
};

}  // namespace kaustik::render
