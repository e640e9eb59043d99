#pragma once
// Radiance estimates at neighbouring points of one pixel share one gather.

#include <array>
#include <vector>

#include "photon/estimate/radiance_estimate.h"

namespace kaustik::photon {

class EstimateBatch {
 public:
  // Points on one surface that are closer than this fraction of the disc's radius share one gather. Of the k
  // photons in the disc, only a share of 4 kShared / pi, at most a sixth, would differ for the second point,
  // so its own estimate would add little information. Neither estimate is closer to the true value than the
  // other.
  static constexpr float kShared = 1.0f / 8;

  static constexpr uint32_t kPixels = 16;

  // Forgets all gathers, before other pixels are rendered. flush() must have been called.
  void begin_block();
  // Selects which of the kPixels the following add() calls belong to. The results of one pixel do not depend
  // on the others.
  void begin_pixel(uint32_t pixel) { pixel_ = pixel; }

  // Takes the estimate and returns true; flush() will then add weight times estimate_radiance(), at this
  // point or at one nearby in the same pixel, to *radiance, and the number of photons that counted to
  // *photons. Returns false and does nothing for the leaf lookup and for BSDFs other than Lambertian, whose
  // value differs from photon to photon. map and settings must stay valid until flush().
  bool add(const PhotonMap& map, const SurfaceInteraction& si, const Vector3& wo, const Bsdf& bsdf,
           const EstimateSettings& settings, const Rgb& weight, Rgb* radiance, float* photons);

  // Adds the estimates that were taken, in the order of the add() calls, and the counts of the gathers to
  // `counters`. They are added after everything that was added to the sums directly.
  void flush(GatherCounters& counters);

  // Number of different points at which maps were gathered since begin_block().
  size_t gathers() const { return gathers_.size(); }

 private:
  static constexpr uint32_t kNone = ~0u;
  static constexpr int kLookedAt = 16;  // number of a pixel's latest gathers that are compared

  struct Gather {
    const PhotonMap* map;
    GatherQuery query;
    uint32_t previous;  // previous gather of the same pixel
    Rgb flux{0};        // W/m^2, corrected for the share of the disc on the surface
    float accepted = 0;
    Vector3 wo{0};     // from which the point was seen
    bool cut = false;  // whether walls cut the disc
  };
  struct Waiting {
    uint32_t gather;
    Rgb weight;
    Rgb* radiance;
    float* photons;
  };
  // A point with the direction it is seen from, and its side of the surface.
  struct Point {
    const SurfaceInteraction& si;
    const Vector3& wo;
    const Normal3& n;
  };
  uint32_t gather_near(const PhotonMap& map, const EstimateSettings& settings, const Point& x) const;
  uint32_t new_gather(const PhotonMap& map, const EstimateSettings& settings, const Point& x);

  uint32_t pixel_ = 0;
  std::array<uint32_t, kPixels> latest_{};
  std::vector<Gather> gathers_;
  std::vector<Waiting> waiting_;
  GatherCounters counters_;
};

}  // namespace kaustik::photon
