#pragma once
// Radiance estimates at neighbouring points of one pixel share one gather.

#include <array>
#include <vector>

#include "photon/estimate/radiance_estimate.h"

namespace kaustik::photon {

class EstimateBatch {
 public:
  // Points of one surface that are nearer to each other than this part of the disc's radius share a gather:
  // of k photons in the disc 4 kShared / pi, at most a sixth, are others for the second point, so that its
  // own estimate would hardly tell more. Neither is nearer to what is estimated than the other.
  static constexpr float kShared = 1.0f / 8;

  static constexpr uint32_t kPixels = 16;

  // Forgets all gathers, for other pixels. flush() comes first.
  void begin_block();
  // What is added from here on belongs to this one of kPixels. What is added to one does not depend on
  // others.
  void begin_pixel(uint32_t pixel) { pixel_ = pixel; }

  // True when the estimate is taken: then flush() adds weight times estimate_radiance(), at this point or at
  // one of the same pixel nearby, to *radiance, and to *photons how many counted. False, and nothing is done,
  // for BSDFs without a constant_pi_f(), whose value differs from photon to photon, and for the leaf lookup.
  // map and settings must live as long.
  bool add(const PhotonMap& map, const SurfaceInteraction& si, const Vector3& wo, const Bsdf& bsdf,
           const EstimateSettings& settings, const Rgb& weight, Rgb* radiance, float* photons);

  // Adds what was taken, in the order in which it came and behind all that was added to the sums at once, and
  // the counts of the gathers to `counters`.
  void flush(GatherCounters& counters);

  // How many different points of the maps have been gathered at since begin_block().
  size_t gathers() const { return gathers_.size(); }

 private:
  static constexpr uint32_t kNone = ~0u;
  static constexpr int kLookedAt = 16;  // of a pixel's gathers, the latest

  struct Gather {
    const PhotonMap* map;
    GatherQuery query;
    uint32_t previous;  // gather of the same pixel
    Rgb flux{0};        // of a disc that lies on the surface as a whole, W/m^2
    float accepted = 0;
  };
  struct Waiting {
    uint32_t gather;
    Rgb weight;
    Rgb* radiance;
    float* photons;
  };
  uint32_t gather_near(const PhotonMap& map, const SurfaceInteraction& si, const Normal3& n) const;
  uint32_t new_gather(const PhotonMap& map, const EstimateSettings& settings, const SurfaceInteraction& si,
                      const Normal3& n);

  uint32_t pixel_ = 0;
  std::array<uint32_t, kPixels> latest_{};
  std::vector<Gather> gathers_;
  std::vector<Waiting> waiting_;
  GatherCounters counters_;
};

}  // namespace kaustik::photon
