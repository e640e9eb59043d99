#pragma once
// Packing of photons into records, many at once in SIMD lanes.

#include <cstddef>
#include <vector>

#include "photon/record/photon_record.h"
#include "photon/trace/vertex_lanes.h"

namespace kaustik::photon {

// Where photons lie side by side, by columns aligned to 64 bytes: d points away from where a photon came
// from.
struct PhotonLanes {
  const float *d[3], *flux[3], *n[3];
  const uint32_t* surface_group;
};
// Their records' words, aligned as well.
struct PackedLanes {
  alignas(64) uint32_t direction[VertexLanes::kLanes], power[VertexLanes::kLanes],
      surface[VertexLanes::kLanes];
};

// The first `count` lanes; at most VertexLanes::kLanes, and whole multiples of 16 are read and written.
void pack_lanes(const PhotonLanes& photons, size_t count, float flux_unit, PackedLanes* packed);

// Photons of one kind on their way into records: as they are added, packed kLanes at a time.
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
  // Packs what waits.
  void flush(PhotonRecords& records);

 private:
  alignas(64) float p_[3][kLanes]{}, d_[3][kLanes]{}, flux_[3][kLanes]{}, n_[3][kLanes]{};
  alignas(64) uint32_t surface_group_[kLanes]{};
  size_t waiting_ = 0;
  float flux_unit_;
};

}  // namespace kaustik::photon
