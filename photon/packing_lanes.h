#pragma once
// Packing of photons into records, many at once in SIMD lanes.

#include <cstddef>
#include <vector>

#include "photon/photon_record.h"

namespace kaustik::photon {

// Photons of one kind on their way into records: as they are added, packed kLanes at a time.
class RecordPacker {
 public:
  static constexpr size_t kLanes = 16;

  // What waits, by columns.
  struct Columns {
    alignas(64) float p[3][kLanes], wi[3][kLanes], flux[3][kLanes], n[3][kLanes];
    uint32_t surface_group[kLanes];
  };

  explicit RecordPacker(float flux_unit = 1) : flux_unit_(flux_unit) {}

  // Appends pack(photon, flux_unit) to records, now or with a later call.
  void add(const Photon& photon, std::vector<PhotonRecord>& records) {
    for (int c = 0; c < 3; ++c) {
      columns_.p[c][waiting_] = photon.p[c];
      columns_.wi[c][waiting_] = photon.wi[c];
      columns_.flux[c][waiting_] = photon.flux[c];
      columns_.n[c][waiting_] = photon.n[c];
    }
    columns_.surface_group[waiting_] = photon.surface_group;
    if (++waiting_ == kLanes) flush(records);
  }
  // Packs what waits.
  void flush(std::vector<PhotonRecord>& records);

 private:
  Columns columns_{};
  size_t waiting_ = 0;
  float flux_unit_;
};

}  // namespace kaustik::photon
