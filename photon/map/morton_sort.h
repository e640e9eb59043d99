#pragma once
// Photon records into columns, in the order of their Morton keys.

#include <cstdint>
#include <span>

#include "photon/map/morton.h"
#include "photon/record/photon_record.h"

namespace kaustik::photon {

// Where the records go: one array per member, each with room for all.
struct RecordColumns {
  float *x = nullptr, *y = nullptr, *z = nullptr;
  uint32_t *direction = nullptr, *power = nullptr, *surface = nullptr;

  void write(uint64_t i, const PhotonRecord& record) const {
    x[i] = record.x;
    y[i] = record.y;
    z[i] = record.z;
    direction[i] = record.direction;
    power[i] = record.power;
    surface[i] = record.surface;
  }
};

// Writes the records by ascending Morton key; those of one key keep their order. Fewer than 2^32. The records
// are used up: they are left in another order, and the memory of some is given back on the way. The result
// does not depend on the number of threads.
//
// Most significant digits first. Blocks of records are each arranged by buckets of keys, in place; then each
// bucket is collected from the blocks and sorted within the caches of one core. Every record moves three
// times, whatever the length of its key.
void sort_into_columns(std::span<PhotonRecord> records, const MortonCube& cube, const RecordColumns& to);

}  // namespace kaustik::photon
