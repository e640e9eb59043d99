#pragma once
// Packs photons into records, many at once in SIMD lanes.

#include <cstddef>
#include <vector>

#include "photon/lanes/photon_lanes.h"
#include "photon/record/photon_record.h"

namespace kaustik::photon {

// Photons as columns aligned to 64 bytes. d points away from where the photon came from (the opposite of
// Photon::wi).
struct PhotonLanes {
  const float *d[3], *flux[3], *n[3];
  const uint32_t* surface_group;
};
// Words of the photons' records, as aligned columns.
struct PackedLanes {
  alignas(64) uint32_t direction[kPhotonLanes], power[kPhotonLanes], surface[kPhotonLanes];
};

// Packs the first `count` lanes, at most kPhotonLanes. Reads and writes whole multiples of 16 lanes.
void pack_lanes(const PhotonLanes& photons, size_t count, float flux_unit, PackedLanes* packed);

// Collects photons of one kind and packs kLanes at a time into records.
class RecordPacker {
 public:
  static constexpr size_t kLanes = 16;

  explicit RecordPacker(float flux_unit = 1) : flux_unit_(flux_unit) {}

  // Appends pack(photon, flux_unit) to records, now or with a later call.
  void add(const Photon& photon, PhotonRecords& records) {
    for (int c = 0; c < 3; ++c) {
      p_[c][waiting_] = photon.p[c];
      d_[c][waiting_] = -photon.wi[c];
      flux_[c][waiting_] = photon.flux[c];
      n_[c][waiting_] = photon.n[c];
    }
    surface_group_[waiting_] = photon.surface_group;
    if (++waiting_ == kLanes) flush(records);
  }
  // Packs the photons that are still waiting.
  void flush(PhotonRecords& records);

 private:
  alignas(64) float p_[3][kLanes]{}, d_[3][kLanes]{}, flux_[3][kLanes]{}, n_[3][kLanes]{};
  alignas(64) uint32_t surface_group_[kLanes]{};
  size_t waiting_ = 0;
  float flux_unit_;
};

}  // namespace kaustik::photon
