#pragma once
// Points where light is gathered: the first points with diffuse lobes that camera rays meet, or that some
// camera could.

#include <vector>

#include "photon/gather/gather_query.h"
#include "render/plan/render_input.h"

namespace kaustik::render {

struct VisiblePoint {
  photon::GatherQuery query;  // radius unset; n on the viewer's side
  bool both_sides = false;    // the BSDF transmits, so light from the other side is gathered too
  SurfaceInteraction si{};
  MediumIndex medium = kVacuum;  // on the viewer's side
};

// Traces `count` rays of the views and returns the points of those that meet one. With settings.for_camera =
// kAll, the points do not depend on the camera: they lie where light falls. A function of scene and settings.
std::vector<VisiblePoint> visible_points(const RenderInput& input, uint32_t count);

// The same for the points where light is gathered that goes on to visible points: a diffuse reflection from
// each of them leads there.
std::vector<VisiblePoint> points_behind_visible(const RenderInput& input, uint32_t count);

// Number of visible points from which a scene is explored: one for every second pixel, within the
// range that is useful; the most for any camera. Independent of the number of samples, which may be settled
// later.
uint32_t pilot_count(const RenderInput& input);

}  // namespace kaustik::render
