// Packs a whole group of photons in SIMD lanes.

#include "photon/trace/record_sink.h"

namespace kaustik::photon {

void RecordSink::operator()(const VertexLanes& lanes, const uint8_t* kind, size_t count) {
  const auto &d = lanes.ray.d, &flux = lanes.flux, &n = lanes.facing;
  PackedLanes packed;
  pack_lanes({{d[0], d[1], d[2]}, {flux[0], flux[1], flux[2]}, {n[0], n[1], n[2]}, lanes.surface_group},
             count, flux_unit_, &packed);
  for (size_t k = 0; k < count; ++k) {
    if (kind[k] == kPhotonKinds) continue;
    records_[kind[k]].push_back({lanes.p[0][k], lanes.p[1][k], lanes.p[2][k], packed.direction[k],
                                 packed.power[k], packed.surface[k]});
  }
}

}  // namespace kaustik::photon
