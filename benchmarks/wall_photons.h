#pragma once
// Photons on the walls, floor and ceiling of a room, and queries in the order of a rendered tile: the input
// of the map's benchmarks.

#include <tbb/parallel_for.h>

#include <vector>

#include "core/memory/memory_pages.h"
#include "core/sampling/sampler.h"
#include "photon/record/photon_record.h"

namespace kaustik::benchmarks {

inline constexpr Vector3 kRoom{4, 3, 5};

inline float canonical(uint64_t index, uint64_t dimension) {
  return float(mix64(hash_combine(index, dimension)) >> 40) * 0x1p-24f;
}

// A photon on wall w of six, at (u, v) in the unit square, with the inward normal.
inline photon::Photon wall_point(uint32_t wall, float u, float v) {
  const int axis = int(wall >> 1), a = (axis + 1) % 3, b = (axis + 2) % 3;
  photon::Photon photon;
  photon.p[a] = u * kRoom[a];
  photon.p[b] = v * kRoom[b];
  photon.p[axis] = wall & 1 ? kRoom[axis] : 0;
  photon.n[axis] = wall & 1 ? -1.0f : 1.0f;
  photon.wi = photon.n;
  photon.flux = Rgb(1, 0.5f, 0.25f);
  photon.surface_group = wall;
  return photon;
}

inline float wall_area(uint32_t wall) {
  const int axis = int(wall >> 1);
  return kRoom[(axis + 1) % 3] * kRoom[(axis + 2) % 3];
}
inline float room_area() {
  return 2 * (wall_area(0) + wall_area(2) + wall_area(4));
}

// Photons evenly spread over the area, in the order of a shoot: neighbours in the buffer are far apart. They
// are in large pages, as those of a shoot.
inline photon::PhotonBuffer wall_photons(size_t count) {
  photon::PhotonBuffer buffer;
  buffer.records.reserve(count);
  prefer_large_pages(buffer.records.data(), count * sizeof(photon::PhotonRecord));
  buffer.records.resize(count);
  tbb::parallel_for(size_t(0), count, [&](size_t i) {
    float area = canonical(i, 0) * room_area();
    uint32_t wall = 0;
    while (wall < 5 && area >= wall_area(wall)) area -= wall_area(wall++);
    buffer.records[i] = pack(wall_point(wall, canonical(i, 1), canonical(i, 2)), 1);
  });
  return buffer;
}

// The radius of the disc on a wall that holds this many photons on average.
inline float radius_for(double photons_in_reach, size_t count) {
  return float(std::sqrt(photons_in_reach / double(count) * double(room_area()) / std::numbers::pi));
}

// The points of 16 x 16 pixel tiles of a picture of one wall, tile by tile, with a jitter of a pixel; within
// a tile row by row.
inline std::vector<photon::Photon> tile_points(size_t tiles_per_axis) {
  std::vector<photon::Photon> points;
  const float pixels = float(16 * tiles_per_axis);
  for (size_t tile = 0; tile < tiles_per_axis * tiles_per_axis; ++tile) {
    for (size_t pixel = 0; pixel < 256; ++pixel) {
      const size_t x = 16 * (tile % tiles_per_axis) + pixel % 16,
                   y = 16 * (tile / tiles_per_axis) + pixel / 16;
      points.push_back(wall_point(4, (float(x) + canonical(points.size(), 3)) / pixels,
                                  (float(y) + canonical(points.size(), 4)) / pixels));
    }
  }
  return points;
}

}  // namespace kaustik::benchmarks
