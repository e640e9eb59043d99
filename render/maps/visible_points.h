#pragma once
// Where light is gathered: the first points with broad lobes that camera rays meet, and how densely they lie.

#include <unordered_map>
#include <vector>

#include "accel/bvh.h"
#include "photon/gather/gather.h"
#include "photon/record/photon.h"
#include "render/settings.h"

namespace kaustik::render {

struct VisiblePoint {
  photon::GatherQuery query;  // without radius, on the viewer's side
  bool both_sides = false;    // what comes through is gathered, too
};

// Those of `count` camera rays that meet one. A function of scene and settings.
std::vector<VisiblePoint> visible_points(const Scene& scene, const accel::Bvh& bvh,
                                         const RenderSettings& settings, uint32_t count);

// How many visible points lie in a cell of space, on one side of what is there. Where few lie, a photon is
// seen in few pixels, where none lies, in hardly any. Cells are a 32nd as wide as all points together.
class VisibleDensity {
 public:
  explicit VisibleDensity(const std::vector<VisiblePoint>& points);
  // Of the points that a photon may be gathered from: those of the cell whose normals are like its own.
  // Thread-safe.
  float at(const photon::Photon& photon) const;

 private:
  uint64_t key(const Point3& p, const Normal3& n) const;

  Point3 low_{0};
  float per_cell_ = 0;  // cells a metre
  std::unordered_map<uint64_t, float> counts_;
};

}  // namespace kaustik::render
