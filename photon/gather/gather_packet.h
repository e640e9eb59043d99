#pragma once
// Queries that are answered together.

#include <limits>

#include "photon/gather/gather.h"

namespace kaustik::photon {

// Neighbouring queries of one surface as columns for the lanes; unused ones have a negative radius_squared.
struct QueryPacket {
  static constexpr size_t kMost = 16;

  alignas(64) float p[3][kMost], radius_squared[kMost], slope[kMost];
  Point3 lo{std::numeric_limits<float>::infinity()}, hi{-std::numeric_limits<float>::infinity()};  // of p
  float most = -1, most_squared = -1;  // the largest radius, metres, and square
  uint32_t surface = 0;                // packed
};

}  // namespace kaustik::photon
