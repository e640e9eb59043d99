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
  RecordSink(float flux_unit, RecordsByKind& records, FluxColours colours = FluxColours::kRgb)
      : flux_unit_(flux_unit), colours_(colours), records_(records) {
    packers_.fill(RecordPacker(flux_unit));
  }

  // index: of the photon.
  void operator()(PhotonKind kind, const Photon& photon, uint64_t index) {
    const bool converts = colours_ == FluxColours::kXyz;
    packers_[static_cast<size_t>(kind)].add(converts ? in_xyz(photon, index) : photon,
                                            records_[static_cast<size_t>(kind)]);
  }
  // Adds the first `count` lanes with their flux at p, which is RGB. kind[k] is a PhotonKind, or kPhotonKinds
  // for no photon.
  void operator()(const VertexLanes& lanes, const uint8_t* kind, size_t count);
  // Packs the photons that are still waiting.
  void flush() {
    for (size_t k = 0; k < packers_.size(); ++k) packers_[k].flush(records_[k]);
  }

 private:
  Photon in_xyz(Photon photon, uint64_t index) const;

  float flux_unit_;
  FluxColours colours_;
  RecordsByKind& records_;
  std::array<RecordPacker, kPhotonKinds> packers_;
};

}  // namespace kaustik::photon
