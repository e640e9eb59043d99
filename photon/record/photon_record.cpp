// Packs photons into 24 bytes.

#include "photon/record/photon_record.h"

#include "photon/record/packing.h"

namespace kaustik::photon {

PhotonRecord pack(const Photon& photon, float flux_unit) {
  return {photon.p.x,
          photon.p.y,
          photon.p.z,
          pack_direction(photon.wi),
          pack_rgb9e5(photon.flux * (1 / flux_unit)),
          pack_surface(photon.n, photon.surface_group)};
}

}  // namespace kaustik::photon
