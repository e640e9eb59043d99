#pragma once
// How near other surfaces are to the points that the camera sees.

#include <array>
#include <unordered_map>

#include "render/maps/place_grid.h"

namespace kaustik::render {

// The clearance of a place: the harmonic mean of the distances that light travels to it from the other
// surfaces, in metres, weighted by the cosine at the place; infinite in the open. The irradiance of a place
// varies over distances of about its clearance (Ward, Rubinstein and Clear 1988, "A Ray Tracing Solution for
// Diffuse Interreflection"). Sampled at points that the camera sees and averaged in cells of space. A function
// of scene and settings, which scales exactly with the scene for powers of two. Immutable; thread-safe.
class Surroundings {
 public:
  explicit Surroundings(const RenderInput& input);

  // Clearance of the surface at p whose lit side has the normal n; 0 where nothing is known, since the camera
  // hardly sees this place.
  float clearance(const Point3& p, const Normal3& n) const;

 private:
  // Sum over the points of a cell.
  struct Cell {
    float inverse = 0;  // of 1 / clearance
    uint32_t points = 0;
  };
  using Cells = std::unordered_map<uint64_t, Cell>;
  // Grids from fine to coarse. A place is looked up in the finest grid that has enough points there.
  static constexpr std::array<float, 3> kResolution = {64, 32, 16};
  static constexpr std::array<uint32_t, 3> kEnough = {4, 2, 1};

  void add(const Point3& p, const Normal3& n, float inverse);

  std::array<PlaceGrid, kResolution.size()> grids_;
  std::array<Cells, kResolution.size()> cells_;
};

}  // namespace kaustik::render
