#pragma once
// Radiance estimates that wait until there are many: neighbouring searches share their work, and those of one
// pixel their result.

#include <array>
#include <span>
#include <vector>

#include "photon/estimate/radiance_estimate.h"

namespace kaustik::photon {

class EstimateBatch {
 public:
  // Points of one surface that are nearer to each other than this part of the disc's radius are read as one:
  // of k photons in the disc 4 kShared / pi, at most a sixth, are others for the second point, so that its
  // own estimate would hardly tell more. Neither is nearer to what is estimated than the other.
  static constexpr float kShared = 1.0f / 8;

  static constexpr uint32_t kPixels = 16;

  // Forgets all that was read, for other pixels. flush() comes first.
  void begin_block();
  // What is added from here on belongs to this one of kPixels. What is added to one does not depend on
  // others.
  void begin_pixel(uint32_t pixel) { pixel_ = pixel; }

  // True when the estimate waits: then flush() adds weight times estimate_radiance(), at this point or at one
  // of the same pixel nearby, to *radiance, and to *photons how many counted. False, and nothing is done, for
  // BSDFs without a constant_pi_f(), whose value differs from photon to photon, and for the leaf lookup. map
  // and settings must live as long.
  bool add(const PhotonMap& map, const SurfaceInteraction& si, const Vector3& wo, const Bsdf& bsdf,
           const EstimateSettings& settings, const Rgb& weight, Rgb* radiance, float* photons);

  void flush(GatherCounters& counters);

  // How many different points of the maps have been asked for since begin_block().
  size_t readings() const { return readings_.size(); }

 private:
  static constexpr uint32_t kNone = ~0u;
  static constexpr int kLookedAt = 16;  // of a pixel's readings, the latest

  struct Waiting {
    uint32_t reading;
    Rgb weight;
    Rgb* radiance;
    float* photons;
  };
  struct Reading {
    const PhotonMap* map;
    const EstimateSettings* settings;
    SurfaceInteraction si;
    GatherQuery query;
    uint32_t surface;   // packed, to sort by
    uint32_t previous;  // of the same pixel
    Rgb flux{0};        // of a disc that lies on the surface as a whole, W/m^2
    float accepted = 0;
  };
  uint32_t reading_near(const PhotonMap& map, const SurfaceInteraction& si, const Normal3& n) const;
  uint32_t new_reading(const PhotonMap& map, const EstimateSettings& settings, const SurfaceInteraction& si,
                       const Normal3& n);
  void read_new(GatherCounters& counters);
  void read(std::span<const uint32_t> of_one_map, GatherCounters& counters);

  uint32_t pixel_ = 0;
  std::array<uint32_t, kPixels> latest_{};
  std::vector<Reading> readings_;
  size_t complete_ = 0;  // of the readings
  GatherCounters nearest_;
  std::vector<Waiting> waiting_;
  std::vector<uint32_t> order_;
  std::vector<GatherQuery> queries_;
  std::vector<PhotonMap::Gathered> results_;
};

}  // namespace kaustik::photon
