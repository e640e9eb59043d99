#pragma once
// What is around the points that the camera sees: how near other surfaces are, and how unevenly they shine.

#include <array>
#include <functional>
#include <unordered_map>

#include "core/sampling/sampler.h"
#include "render/explore/place_grid.h"

namespace kaustik::render {

// What decides between the two ways to estimate the indirect light of a place.
struct Place {
  // Harmonic mean of the distances that light travels to the place from the other surfaces, weighted by the
  // cosine at the place; metres, infinite in the open. The irradiance of a place varies over distances of
  // about its clearance (Ward, Rubinstein and Clear 1988, "A Ray Tracing Solution for Diffuse
  // Interreflection").
  float clearance = 0;
  // The same, weighted by the light as well: where a near surface shines brightly, that is how fast the
  // irradiance varies. Infinite where no light is known.
  float lit_clearance = kInfinity;
  // Relative standard deviation of the light that one random ray from the place brings.
  float noise = 0;
};

// Explores the surroundings of points that the camera sees by rays, and averages them in cells of space. A
// function of scene and settings; clearances scale exactly with the scene for powers of two. Immutable;
// thread-safe.
class Surroundings {
 public:
  // go_on: is called now and then; where it returns false, the exploration ends early and is of no use.
  explicit Surroundings(const RenderInput& input, const std::function<bool()>& go_on = {});

  // The surface at p whose lit side has the normal n; clearance 0 where nothing is known, since the camera
  // hardly sees it.
  Place at(const Point3& p, const Normal3& n) const;

  // The clearance, weighted by light or not, that a quarter of the points do not have; metres, infinite in
  // the open.
  float lower_quartile() const { return lower_quartile_; }

 private:
  // Sums over the rays of a cell.
  struct Cell {
    double inverse = 0;             // of 1 / distance
    double light_by_distance = 0;   // of the radiance that a ray brings over the distance
    double light = 0, squared = 0;  // of the radiance that a ray brings, and of its square
    uint32_t rays = 0;

    void add(const Cell& other);
    float clearance() const;
    float lit_clearance() const;
    // The least value is that of a place whose surroundings shine evenly.
    float noise() const;
  };
  using Cells = std::unordered_map<uint64_t, Cell>;
  static constexpr int kRaysEach = 16;  // rays from a visible point
  // Grids from fine to coarse. A place is looked up in the finest grid that has enough rays there; more are
  // needed for what depends on the light, since a few bright rays decide about it.
  static constexpr std::array<float, 3> kResolution = {64, 32, 16};
  static constexpr std::array<uint32_t, 3> kEnough = {4 * kRaysEach, 2 * kRaysEach, kRaysEach};
  static constexpr uint32_t kEnoughForLight = 16 * kRaysEach;

  static Cell explore(const RenderInput& input, const SurfaceInteraction& si, const Normal3& n,
                      Sampler& sampler);
  void add(const Point3& p, const Normal3& n, const Cell& found);
  float quartile_of(const std::vector<VisiblePoint>& points) const;

  std::array<PlaceGrid, kResolution.size()> grids_;
  std::array<Cells, kResolution.size()> cells_;
  Cell all_;
  float lower_quartile_ = kInfinity;
};

}  // namespace kaustik::render
