#pragma once
// The variant of all BSDF types. To add a BSDF: (1) write a header with the struct, (2) add its name here,
// (3) add its row in core/scene/schema/schema.cpp.

#include <variant>

#include "core/bsdf/coated_diffuse.h"
#include "core/bsdf/conductor.h"
#include "core/bsdf/dielectric.h"
#include "core/bsdf/diffuse_transmission.h"
#include "core/bsdf/lambertian.h"
#include "core/bsdf/mirror.h"
#include "core/bsdf/oren_nayar.h"
#include "core/bsdf/thin_dielectric.h"

namespace kaustik {

template <class B>
inline constexpr bool kTransmitsBroadly = requires {
  B::kTransmits;
};

using Bsdf = std::variant<Lambertian, OrenNayar, Dielectric, Conductor, Mirror, ThinDielectric,
                          DiffuseTransmission, CoatedDiffuse>;

inline Lobes lobes(const Bsdf& bsdf) {
  return std::visit([](const auto& b) { return b.lobes(); }, bsdf);
}
// Whether there is no diffuse part, so that no photons are gathered.
inline bool is_specular(const Bsdf& bsdf) {
  return !lobes(bsdf).broad;
}
inline Rgb albedo(const Bsdf& bsdf) {
  return std::visit([](const auto& b) { return b.albedo(); }, bsdf);
}
// Whether turning the surface about its normal changes the BSDF.
inline bool is_anisotropic(const Bsdf& bsdf) {
  return std::visit(
      [](const auto& b) {
        if constexpr (requires { b.facets; }) return b.facets.alpha_x != b.facets.alpha_y;
        return false;
      },
      bsdf);
}
// Whether the diffuse part transmits light.
inline bool transmits(const Bsdf& bsdf) {
  return std::visit([]<class B>(const B&) { return kTransmitsBroadly<B>; }, bsdf);
}

}  // namespace kaustik
