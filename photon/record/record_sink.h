#pragma once
// What the tracer hands over, packed into records.

#include <array>

#include "photon/record/packing_lanes.h"

namespace kaustik::photon {

using RecordsByKind = std::array<PhotonRecords, kPhotonKinds>;

class RecordSink {
 public:
  // Appends to records, which must outlive it.
  RecordSink(float flux_unit, RecordsByKind& records) : flux_unit_(flux_unit), records_(records) {
    packers_.fill(RecordPacker(flux_unit));
  }

  void operator()(PhotonKind kind, const Photon& photon) {
    packers_[static_cast<size_t>(kind)].add(photon, records_[static_cast<size_t>(kind)]);
  }
  // The first `count` lanes, whose flux is what they leave at p. kind[k] is a PhotonKind, or kPhotonKinds for
  // nothing.
  void operator()(const VertexLanes& lanes, const uint8_t* kind, size_t count);
  // Packs what still waits.
  void flush() {
    for (size_t k = 0; k < packers_.size(); ++k) packers_[k].flush(records_[k]);
  }

 private:
  float flux_unit_;
  RecordsByKind& records_;
  std::array<RecordPacker, kPhotonKinds> packers_;
};

}  // namespace kaustik::photon
