// Packs a whole group of photons in SIMD lanes.

#include "photon/trace/record_sink.h"

#include "core/math/hash.h"

namespace kaustik::photon {

namespace {

// The step of RGB9E5's mantissas for a flux in its units.
float step_of(const Vector3& flux) {
  const float largest = std::clamp(max_component(flux), 0x1p-16f, kRgb9e5Max);
  return std::ldexp(1.0f, std::ilogb(largest) - 8);
}

// Shifts the flux by up to half a step at random, so that rounding keeps its mean: all photons of a lamp may
// have the same flux, whose rounding error in XYZ would tint the picture, since RGB is made of differences.
Vector3 dithered(const Vector3& flux, uint64_t index) {
  const uint64_t bits = mix64(index);
  const auto u = [&](int c) { return float(bits >> (21 * c) & 0x1fffff) * 0x1p-21f; };
  return glm::max(flux + step_of(flux) * (Vector3(u(0), u(1), u(2)) - 0.5f), 0.0f);
}

}  // namespace

Photon RecordSink::in_xyz(Photon photon, uint64_t index) const {
  if (photon.wavelength != kNoWavelength) photon.flux = at_wavelength(photon.flux, photon.wavelength);
  photon.flux = dithered(xyz_of_flux(photon.flux) / flux_unit_, index) * flux_unit_;
  return photon;
}

void RecordSink::operator()(const VertexLanes& lanes, const uint8_t* kind, size_t count) {
  const auto &d = lanes.ray.d, &flux = lanes.flux, &n = lanes.facing;
  PackedLanes packed;
  pack_lanes({{d[0], d[1], d[2]}, {flux[0], flux[1], flux[2]}, {n[0], n[1], n[2]}, lanes.surface_group},
             count, flux_unit_, &packed);
  for (size_t k = 0; k < count; ++k) {
    if (kind[k] == kPhotonKinds) continue;
    records_[kind[k]].push_back({lanes.p[0][k], lanes.p[1][k], lanes.p[2][k], packed.direction[k],
                                 packed.power[k], packed.surface[k]});
  }
}

}  // namespace kaustik::photon
