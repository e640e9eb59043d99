#pragma once
// This program's photon map as a PhotonIndex.

#include "benchmarks/photon_index.h"
#include "photon/gather/gather.h"
#include "photon/gather/nearest.h"

namespace kaustik::benchmarks {

class PhotonMapIndex {
 public:
  static constexpr std::string_view kName = "PhotonMap";

  static PhotonMapIndex build(photon::PhotonBuffer&& photons, float /*radius*/) {
    PhotonMapIndex index;
    index.map_ = photon::PhotonMap::build(std::move(photons));
    return index;
  }
  Rgb flux_density(const photon::GatherQuery& query, photon::GatherCounters& counters) const {
    return photon::gather_flux(map_, query, {}, counters);
  }
  template <class Fn>
  void for_each(const photon::GatherQuery& query, photon::GatherCounters& counters, Fn&& fn) const {
    photon::for_each_photon(
        map_, query, [&](const photon::Photon& photon, float) { fn(photon.flux); }, counters);
  }
  float nearest_radius(const photon::GatherQuery& query, uint32_t k, photon::GatherCounters& counters) const {
    return photon::nearest_radius(map_, query, k, counters);
  }
  uint64_t memory_bytes() const { return map_.memory_bytes(); }
  const photon::PhotonMap& map() const { return map_; }

 private:
  photon::PhotonMap map_;
};
static_assert(NearestIndex<PhotonMapIndex>);

}  // namespace kaustik::benchmarks
