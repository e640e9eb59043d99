#pragma once
// Predicted error of irradiance from discs of photons.

#include <vector>

#include "photon/sources/irradiance_tree.h"
#include "render/explore/visible_points.h"
#include "render/plan/render_input.h"

namespace kaustik::render {

// Relative squared error of indirect light, its noise and its bias, as a mean over visible places.
class DiscError {
 public:
  // pilot: few indirect photons. photons: how many the map holds if none are left out, and how many that is
  // for each of the pilot.
  DiscError(const RenderInput& input, const std::vector<VisiblePoint>& points,
            const photon::IrradianceTree& pilot, double photons, double each);

  // share: of the photons that are left in the map.
  double of(double share) const;

 private:
  struct Place {
    double density = 0;  // of the pilot, 1/m^2
    double clearance = 0;
  };
  // Mean squared bias of discs of `reach` photons, where there are `each` for each photon of the pilot.
  double bias(double each, double reach) const;

  std::vector<Place> places_;
  double photons_, each_;
};

}  // namespace kaustik::render
