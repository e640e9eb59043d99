#pragma once
// Radiance estimates at neighbouring points of one pixel share one gather.

#include <array>
#include <memory>
#include <optional>
#include <vector>

#include "photon/estimate/radiance_estimate.h"
#include "photon/estimate/walls.h"

namespace kaustik::photon {

class EstimateBatch {
 public:
  // Points on one surface that are closer than this fraction of the disc's radius, or of the mean radius of
  // the photons' own discs, share one gather. Of the k photons in the disc, at most a share of 2 kShared /
  // pi, a sixth, lies outside the second point's disc, and about as many others lie inside it, so its own
  // estimate would add little information. Neither estimate is closer to the true value than the other.
  static constexpr float kShared = 1.0f / 4;

  static constexpr uint32_t kPixels = 16;

  // Forgets all gathers, before other pixels are rendered. flush() must have been called.
  void begin_block();
  // Selects which of the kPixels the following add() calls belong to. The results of one pixel do not depend
  // on the others.
  void begin_pixel(uint32_t pixel) { pixel_ = pixel; }

  // Takes the estimate and returns true; flush() will then add weight times estimate_radiance(), at this
  // point or at one nearby in the same pixel, to *radiance, and the number of photons that counted to
  // *photons. Returns false and does nothing for the leaf lookup and for BSDFs that are no product of a
  // factor of wo and one of wi (SeparatedF). map and settings must stay valid until flush().
  bool add(const PhotonMap& map, const SurfaceInteraction& si, const Vector3& wo, const Bsdf& bsdf,
           const EstimateSettings& settings, const Rgb& weight, Rgb* radiance, float* photons);

  // Adds the estimates that were taken, in the order of the add() calls, and the counts of the gathers to
  // `counters`. They are added after everything that was added to the sums directly.
  void flush(GatherCounters& counters);

  // Number of different points at which maps were gathered since begin_block().
  size_t gathers() const { return completed_; }

 private:
  static constexpr uint32_t kNone = ~0u;
  static constexpr int kLookedAt = 16;  // number of a pixel's latest gathers that are compared

  struct Gather {
    const PhotonMap* map;
    GatherQuery query;
    Coat coat;
    uint32_t previous;                   // previous gather of the same pixel
    SurfaceInteraction si;               // the disc's centre
    DiscRadii radii;                     // of the photons' own discs once the gather is done
    std::unique_ptr<const WallCut> cut;  // null where no wall cuts the disc
    bool done = false;                   // whether the photons have been gathered
    Rgb flux{0};                         // W/m^2 through the coat, corrected for the share
    float accepted = 0;
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
    Coat coat;
  };
  uint32_t find_or_prepare(const PhotonMap& map, const EstimateSettings& settings, const Point& x);
  uint32_t gather_near(const PhotonMap& map, const Point& x) const;
  uint32_t prepare(const PhotonMap& map, const EstimateSettings& settings, const Point& x);
  static void cut_by_walls(const EstimateSettings& settings, const Point& x, Gather* gather);
  void complete(const EstimateSettings& settings, const Point& x, uint32_t number);
  Rgb gather_visible(const Gather& gather, const KernelSpec& kernel, const Point& x);
  Rgb gather_through_coat(const Gather& gather, const KernelSpec& kernel, const Point& x);

  uint32_t pixel_ = 0;
  size_t completed_ = 0;
  std::array<uint32_t, kPixels> latest_{};
  std::vector<Gather> gathers_;
  std::vector<Waiting> waiting_;
  GatherCounters counters_;
};

}  // namespace kaustik::photon
