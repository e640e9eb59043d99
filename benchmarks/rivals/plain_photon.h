#pragma once
// The photon of the scalar rivals, with its flux unpacked, and the test whether it counts.

#include "core/math/bounds.h"
#include "photon/gather/gather.h"
#include "photon/record/packing.h"
#include "photon/record/photon_record.h"

namespace kaustik::benchmarks {

struct PlainPhoton {
  Point3 p;
  uint32_t surface;  // as in photon::PhotonRecord
  Rgb flux;          // watts
  uint32_t direction;
};
static_assert(sizeof(PlainPhoton) == 32);

inline PlainPhoton plain_photon(const photon::PhotonRecord& record, float flux_unit) {
  return {{record.x, record.y, record.z},
          record.surface,
          photon::unpack_rgb9e5(record.power) * flux_unit,
          record.direction};
}

inline Bounds3 bounds_of(const photon::PhotonBuffer& buffer) {
  Bounds3 bounds;
  for (const photon::PhotonRecord& r : buffer.records) bounds.add(Point3(r.x, r.y, r.z));
  return bounds;
}

// Decides by photon::GatherQuery's rule which photons count.
class Acceptance {
 public:
  explicit Acceptance(const photon::GatherQuery& query)
      : p_(query.p),
        n_(query.n),
        radius_squared_(query.radius * query.radius),
        surface_(photon::pack_surface(query.n, query.surface_group)) {}

  float radius_squared() const { return radius_squared_; }
  bool within(const Point3& p) const {
    const Vector3 d = p - p_;
    return d.x * d.x + d.y * d.y + d.z * d.z <= radius_squared_;
  }
  // An identical packed surface needs no decoding.
  bool on_surface(uint32_t surface) const {
    if (surface == surface_) return true;
    return surface >> 16 == surface_ >> 16 && photon::normal_counts(surface, n_);
  }
  bool operator()(const PlainPhoton& photon) const { return within(photon.p) && on_surface(photon.surface); }

 private:
  Point3 p_;
  Normal3 n_;
  float radius_squared_;
  uint32_t surface_;
};

// Every coordinate of a photon that counts is within this of the query's: its rounded squared distance is at
// most the rounded squared radius.
inline float box_reach(float radius) {
  return radius * (1 + 0x1p-20f);
}

// Implements flux_density() by for_each().
template <class Index>
Rgb summed_flux_density(const Index& index, const photon::GatherQuery& query,
                        photon::GatherCounters& counters) {
  glm::dvec3 sum(0);
  index.for_each(query, counters, [&](const Rgb& flux) { sum += glm::dvec3(flux); });
  return Rgb(sum * double(photon::kernel_terms({}, query.radius).scale));
}

}  // namespace kaustik::benchmarks
