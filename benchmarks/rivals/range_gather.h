#pragma once
// The photon map's SIMD loop over ranges of photons that another structure finds.

#include <span>

#include "photon/gather/gather.h"

namespace kaustik::benchmarks {

// The sum with the constant kernel over the photons of the ranges that count; ranges ascend. query.within is
// not read, candidates are not counted.
photon::detail::GatherSum gather_ranges(const photon::PhotonColumns& columns,
                                        std::span<const photon::PhotonRange> ranges,
                                        const photon::GatherQuery& query);

}  // namespace kaustik::benchmarks
