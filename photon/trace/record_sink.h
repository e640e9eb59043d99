#pragma once
// Sink for trace_photons() that packs photons into records by kind.

#include <array>

#include "photon/record/packing_lanes.h"
#include "photon/trace/lanes/vertex_lanes.h"

namespace kaustik::photon {

using RecordsByKind = std::array<PhotonRecords, kPhotonKinds>;

class RecordSink {
 public:
  // Appends to `records`, which must outlive the sink.
  RecordSink(float flux_unit, RecordsByKind& records) : flux_unit_(flux_unit), records_(records) {
    packers_.fill(RecordPacker(flux_unit));
  }

  void operator()(PhotonKind kind, const Photon& photon) {
    packers_[static_cast<size_t>(kind)].add(photon, records_[static_cast<size_t>(kind)]);
  }
  // Adds the first `count` lanes with their flux at p. kind[k] is a PhotonKind, or kPhotonKinds for no
  // photon.
  void operator()(const VertexLanes& lanes, const uint8_t* kind, size_t count);
  // Packs the photons that are still waiting.
  void flush() {
    for (size_t k = 0; k < packers_.size(); ++k) packers_[k].flush(records_[k]);
  }

 private:
  float flux_unit_;
  RecordsByKind& records_;
  std::array<RecordPacker, kPhotonKinds> packers_;
};

}  // namespace kaustik::photon
