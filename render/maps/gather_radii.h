#pragma once
// Gather radii of the photon maps, from pass to pass.

#include <cstdint>

#include "render/statistics/statistics.h"

namespace kaustik::render {

// The widest discs of indirect photons, where surfaces are clear of others (photon/estimate/clear_radius.h),
// as a multiple of the radius that all discs have where they do not follow the clearance.
inline constexpr float kIndirectReach = 2;

// Gather radii r0 of the first pass, in metres; 0 for maps that are not used.
struct GatherRadii {
  float direct = 0, caustic = 0, indirect = 0;
  // If > 0, the map's radius shrinks to the k-th nearest photon, or caustic photons have discs of their own
  // by a rule of k, with k counted over all passes. Set where the user gave neither a radius nor --nearest.
  uint32_t caustic_nearest = 0, direct_nearest = 0;
  float medium_caustic = 0, medium_indirect = 0;
  // The same for rays through media: with k photons in reach.
  uint32_t medium_caustic_nearest = 0, medium_indirect_nearest = 0;
  // If > 0, discs of indirect photons follow the clearance, and where photons are of usual density the widest
  // hold so many, counted over all passes. Set likewise.
  uint32_t indirect_widest = 0;
  bool operator==(const GatherRadii&) const = default;
};

// Sets the radii of the statistics.
void note_radii(const GatherRadii& radii, RenderStatistics* statistics);

// Computes r_i^2 / r_1^2 for pass i = pass + 1 under r_{i+1}^2 = r_i^2 (i + alpha) / (i + 1) (Knaus and
// Zwicker 2011, "Progressive Photon Mapping: A Probabilistic Approach"). For alpha in (0, 1), bias and
// variance of the mean over passes both vanish, the bias like pass^(alpha - 1); alpha = 1 gives 1, a fixed
// radius. Uses basic arithmetic only, so the result is the same on every machine. Takes one step from a pass
// to the next one.
class RadiusShrink {
 public:
  double squared(uint64_t pass, float alpha);

 private:
  uint64_t pass_ = 0;
  float alpha_ = 1;
  double squared_ = 1;
};

}  // namespace kaustik::render
