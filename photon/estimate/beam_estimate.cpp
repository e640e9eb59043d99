#include "photon/estimate/beam_estimate.h"

#include <cmath>

namespace kaustik::photon {

Rgb estimate_beam(const PhotonMap& map, BeamQuery query, const Medium& medium, const KernelSpec& kernel,
                  uint32_t nearest, GatherCounters& counters, const accel::Bvh* bvh) {
  if (map.empty()) return Rgb(0);
  const uint64_t count = nearest > 0 ? count_along(map, query) : 0;
  if (count > nearest) query.radius *= float(std::sqrt(double(nearest) / double(count)));
  const bool is_empty = nearest > 0 && count == 0;  // then nothing can be hidden
  if (!bvh || is_empty) return gather_along(map, query, medium, kernel, counters);
  const BeamSight sight(*bvh, query.ray, query.distance, query.radius, kernel);
  query.sight = &sight;
  return gather_along(map, query, medium, kernel, counters);
}

}  // namespace kaustik::photon
