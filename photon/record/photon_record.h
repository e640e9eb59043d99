#pragma once
// The 24-byte photon record that shoots produce and maps store.

#include <cstdint>
#include <vector>

#include "core/memory/uninitialised_array.h"
#include "photon/record/flux_colours.h"
#include "photon/record/packing.h"
#include "photon/record/photon.h"

namespace kaustik::photon {

// direction: octahedral 2 x u16 (towards where the photon came from); power: RGB9E5 of flux / flux_unit,
// in the colours of its buffer;
// surface: octahedral normal 2 x u8 (low half) and surface group (high half, modulo 2^16).
struct PhotonRecord {
  float x, y, z;
  uint32_t direction;
  uint32_t power;
  uint32_t surface;
};
static_assert(sizeof(PhotonRecord) == 24);

// resize() leaves new records uninitialised, for threads to fill.
using PhotonRecords = std::vector<PhotonRecord, UninitialisedAllocator<PhotonRecord>>;

// Photons of one kind as shoot() returns them, before the map is built. flux_unit is a power of two near the
// mean flux of one photon, so that the shared-exponent format keeps its range at any scene scale and photon
// count.
struct PhotonBuffer {
  PhotonRecords records;
  float flux_unit = 1;
  FluxColours colours = FluxColours::kRgb;

  Photon photon(size_t i) const;
};

PhotonRecord pack(const Photon& photon, float flux_unit);
inline Photon unpack(const PhotonRecord& record, float flux_unit, FluxColours colours = FluxColours::kRgb) {
  Photon photon;
  photon.p = {record.x, record.y, record.z};
  photon.wi = unpack_direction(record.direction);
  photon.flux = rgb_of_flux(unpack_rgb9e5(record.power) * flux_unit, colours);
  photon.n = unpack_surface_normal(record.surface);
  photon.surface_group = record.surface >> 16;
  return photon;
}
inline Photon PhotonBuffer::photon(size_t i) const {
  return unpack(records[i], flux_unit, colours);
}

}  // namespace kaustik::photon
