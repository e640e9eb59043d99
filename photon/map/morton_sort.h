#pragma once
// Sorts photon records into columns, in the order of their Morton keys.

#include <cstdint>
#include <span>

#include "photon/map/morton.h"
#include "photon/record/photon_record.h"

namespace kaustik::photon {

// Destination of the records: one array per member, each with room for all.
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

// Writes the records in ascending order of Morton keys; records with the same key keep their order. Fewer
// than 2^32 records. The input is consumed: it is left in another order, and part of its memory is returned
// to the system. The result does not depend on the number of threads.
//
// This is a radix sort, most significant digit first. Each block of records is arranged in place by buckets
// of keys; then each bucket is collected from the blocks and sorted within the caches of one core. Every
// record moves three times, whatever the length of its key.
void sort_into_columns(std::span<PhotonRecord> records, const MortonCube& cube, const RecordColumns& to);

}  // namespace kaustik::photon
