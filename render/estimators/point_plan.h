#pragma once
// What estimates the light that the diffuse lobes of a point scatter.

#include "photon/estimate/estimate_batch.h"
#include "render/estimators/disc_pilots.h"
#include "render/estimators/path_integrator.h"

namespace kaustik::render {

// How the light that the diffuse lobes of a point scatter is estimated.
struct PointPlan {
  bool indirect_disc = false;  // gather the indirect map at the point itself
  PathReach path = PathReach::kNone;
};

// Whether the indirect map's disc is taken at x. The points that share a disc share the answer. blurred: x is
// seen through a glossy lobe that is wider than the disc.
bool takes_disc(const RenderContext& ctx, const ShadingPoint& x, bool blurred, photon::EstimateBatch* batch);

// What the settings and the place of x ask for.
inline PointPlan plan_point(const RenderContext& ctx, const ShadingPoint& x, bool blurred,
                            photon::EstimateBatch* batch) {
  const EstimatorPlan& plan = ctx.plan;
  PointPlan point;
  if (samples_lights(plan.direct) && direct_needs_bsdf_sample(ctx.scene, x)) point.path = PathReach::kLights;
  if (plan.caustics == CausticEstimator::kPaths) point.path = PathReach::kSpecular;
  if (plan.indirect == IndirectEstimator::kPaths) point.path = PathReach::kRoulette;
  if (plan.indirect == IndirectEstimator::kPhotons) point.indirect_disc = true;
  if (plan.indirect != IndirectEstimator::kFinalGather) return point;
  if ((blurred || !lobes(*x.bsdf).rough) && takes_disc(ctx, x, blurred, batch))
    point.indirect_disc = true;
  else
    point.path = final_gather_reach(ctx);
  return point;
}

}  // namespace kaustik::render
