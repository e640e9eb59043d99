#pragma once
// Density of visible points.

#include <unordered_map>

#include "photon/record/photon.h"
#include "render/explore/place_grid.h"

namespace kaustik::render {

// Number of visible points in a cell of space, for each side of the surfaces in it: photons in cells with few
// points matter to few pixels, those in empty cells to hardly any. A cell is a 32nd as wide as the box of all
// points.
class VisibleDensity {
 public:
  explicit VisibleDensity(const std::vector<VisiblePoint>& points) : grid_(points, 32) {
    for (const VisiblePoint& point : points) {
      ++counts_[grid_.key(point.query.p, point.query.n)];
      if (point.both_sides) ++counts_[grid_.key(point.query.p, -point.query.n)];
    }
  }
  // Count of the cell that the photon lies in, for normals similar to its own. Thread-safe.
  float at(const photon::Photon& photon) const { return at(photon.p, photon.n); }
  float at(const Point3& p, const Normal3& n) const {
    const auto found = counts_.find(grid_.key(p, n));
    return found == counts_.end() ? 0 : found->second;
  }

 private:
  PlaceGrid grid_;
  std::unordered_map<uint64_t, float> counts_;
};

}  // namespace kaustik::render
