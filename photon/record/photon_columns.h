#pragma once
// Columns of photons in Morton order, and ranges of photons.

#include <cstdint>
#include <limits>

namespace kaustik::photon {

// Photons [begin, end) in Morton order.
struct PhotonRange {
  uint64_t begin = 0, end = 0;
  uint64_t size() const { return end - begin; }
  bool empty() const { return begin >= end; }
};
inline constexpr PhotonRange kAllPhotons{0, std::numeric_limits<uint64_t>::max()};

// Columns of a photon map. They are readable for kColumnPadding elements beyond the last photon, where x is
// NaN. direction, surface and power are those of PhotonRecord.
struct PhotonColumns {
  const float *x = nullptr, *y = nullptr, *z = nullptr;
  const uint32_t* direction = nullptr;
  const uint32_t* surface = nullptr;
  const uint32_t* power = nullptr;
};
inline constexpr uint64_t kColumnPadding = 64;

}  // namespace kaustik::photon
