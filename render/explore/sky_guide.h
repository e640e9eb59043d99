#pragma once
// Directions in which the sky is visible, learned for the places that the camera sees.

#include <array>
#include <optional>
#include <unordered_map>

#include "core/sampling/discrete.h"
#include "render/explore/place_grid.h"

namespace kaustik::render {

// A density of directions for light samples of skies. In a room the sky is seen through a window, of which
// the light's own density knows nothing. Rays from visible points find the directions that are open; their
// irradiance is added to cells of directions for each cell of space. The guide is mixed with the light's own
// density, so that samples stay unbiased whatever was learned (Vorba et al. 2014, "On-line Learning of
// Parametric Mixture Models for Light Transport Simulation", guides paths likewise). A function of scene and
// settings. Immutable; thread-safe.
class SkyGuide {
 public:
  // Requires infinite lights.
  explicit SkyGuide(const RenderInput& input);

  // Whether samples gain: little of the sky's light arrives at the visible points, but some does.
  bool useful() const { return useful_; }

  struct Sample {
    Vector3 wi{0};  // unit
    float pdf = 0;  // per solid angle
  };
  // Directions at one place; pdf() is zero where nothing was learned.
  class Directions {
   public:
    Directions() = default;
    explicit Directions(const DiscreteDistribution* cells) : cells_(cells) {}
    bool empty() const { return !cells_; }
    // u in [0, 1)^2. Requires !empty().
    Sample sample(const Point2& u) const;
    float pdf(const Vector3& wi) const;

   private:
    const DiscreteDistribution* cells_ = nullptr;
  };
  Directions at(const Point3& p, const Normal3& n) const;

 private:
  // Grids of space from fine to coarse. A place is looked up in the finest grid with enough open rays there.
  static constexpr std::array<float, 3> kResolution = {16, 6, 2};
  static constexpr uint32_t kEnough = 12;

  using Cells = std::unordered_map<uint64_t, DiscreteDistribution>;

  std::array<PlaceGrid, kResolution.size()> grids_;
  std::array<Cells, kResolution.size()> cells_;
  bool useful_ = false;
};

}  // namespace kaustik::render
