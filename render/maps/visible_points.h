#pragma once
// Points where light is gathered: the first points with diffuse lobes that camera rays meet, and their
// density.

#include <unordered_map>
#include <vector>

#include "photon/gather/gather_query.h"
#include "photon/record/photon.h"
#include "render/plan/render_input.h"

namespace kaustik::render {

struct VisiblePoint {
  photon::GatherQuery query;  // radius unset; n on the viewer's side
  bool both_sides = false;    // the BSDF transmits, so light from the other side is gathered too
};

// Traces `count` camera rays and returns the points of those that meet one. A function of scene and settings.
std::vector<VisiblePoint> visible_points(const RenderInput& input, uint32_t count);

// Number of visible points in a cell of space, for each side of the surfaces in it: photons in cells with few
// points matter to few pixels, those in empty cells to hardly any. A cell is a 32nd as wide as the box of all
// points.
class VisibleDensity {
 public:
  explicit VisibleDensity(const std::vector<VisiblePoint>& points);
  // Count of the cell that the photon lies in, for normals similar to its own. Thread-safe.
  float at(const photon::Photon& photon) const;

 private:
  uint64_t key(const Point3& p, const Normal3& n) const;

  Point3 low_{0};
  float per_cell_ = 0;  // cells per metre
  std::unordered_map<uint64_t, float> counts_;
};

}  // namespace kaustik::render
