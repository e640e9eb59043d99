#pragma once
// What estimates the light that the diffuse lobes of a point scatter.

#include "render/estimators/path_integrator.h"

namespace kaustik::render {

// How the light that the diffuse lobes of a point scatter is estimated.
struct PointPlan {
  bool indirect_disc = false;  // gather the indirect map at the point itself
  PathReach path = PathReach::kNone;
};

// What the settings ask for.
inline PointPlan plan_point(const RenderContext& ctx, const ShadingPoint& x) {
  const EstimatorPlan& plan = ctx.plan;
  PointPlan point;
  if (samples_lights(plan.direct) && direct_needs_bsdf_sample(ctx.scene, x)) point.path = PathReach::kLights;
  const bool split_caustics = plan.caustics == CausticEstimator::kSplit && paths_share(ctx);
  if (plan.caustics == CausticEstimator::kPaths || split_caustics) point.path = PathReach::kSpecular;
  const bool split = plan.indirect == IndirectEstimator::kSplit;
  if (plan.indirect == IndirectEstimator::kPaths || (split && paths_share(ctx)))
    point.path = PathReach::kRoulette;
  point.indirect_disc = reads_indirect_photons(plan);
  return point;
}

}  // namespace kaustik::render
