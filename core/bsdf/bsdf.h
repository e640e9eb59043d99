#pragma once
// The list of all BSDFs. To add one: (1) write a header with the struct (core/bsdf/bsdf_types.h says what it
// must have), (2) add its name here, (3) add its row to core/scene/schema/schema.cpp. The tests then ask for
// example values of it in tests/core/support/bsdf_examples.h.

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

// Does not compile when a type lacks a member that BsdfType requires.
template <BsdfType... B>
using VariantOfBsdfs = std::variant<B...>;

using Bsdf = VariantOfBsdfs<Lambertian, OrenNayar, Dielectric, Conductor, Mirror, ThinDielectric,
                            DiffuseTransmission, CoatedDiffuse>;

inline std::string_view name_of(const Bsdf& bsdf) {
  return std::visit([]<class B>(const B&) -> std::string_view { return B::kName; }, bsdf);
}
inline Lobes lobes(const Bsdf& bsdf) {
  return std::visit([](const auto& b) { return b.lobes(); }, bsdf);
}
// Whether there is no diffuse part, so that no photons are gathered.
inline bool is_specular(const Bsdf& bsdf) {
  return !lobes(bsdf).diffuse;
}
inline Rgb albedo(const Bsdf& bsdf) {
  return std::visit([](const auto& b) { return b.albedo(); }, bsdf);
}
// Whether turning the surface about its normal changes the BSDF.
inline bool is_anisotropic(const Bsdf& bsdf) {
  return std::visit([](const auto& b) { return b.anisotropic(); }, bsdf);
}
// The diffuse lobes can let light through.
inline bool transmits(const Bsdf& bsdf) {
  return std::visit([]<class B>(const B&) { return B::kTransmits; }, bsdf);
}
inline bool lit_from_one_side(const Bsdf& bsdf) {
  return std::visit([]<class B>(const B&) { return B::kLitFromOneSide; }, bsdf);
}
// Whether all that the BSDF scatters has one wavelength, as at rough dispersive glass.
inline bool scatters_one_wavelength(const Bsdf& bsdf) {
  const auto* dielectric = std::get_if<Dielectric>(&bsdf);
  return dielectric && dielectric->disperses && !dielectric->facets.smooth();
}
// Whether what the sample sends on has one wavelength from there on.
inline bool selects_wavelength(const Bsdf& bsdf, const Vector3& wo, const BsdfSample& s) {
  const auto* dielectric = std::get_if<Dielectric>(&bsdf);
  return dielectric && dielectric->selects_wavelength(wo, s);
}
// The diffuse lobes as a product of a factor of wo (local) and one of wi; nothing where they are none.
inline std::optional<SeparatedF> separated(const Bsdf& bsdf, const Vector3& wo) {
  return std::visit(
      [&]<class B>(const B& b) -> std::optional<SeparatedF> {
        if constexpr (MaySeparate<B>)
          return b.separated(wo);
        else if constexpr (HasConstantValue<B> && !B::kTransmits)
          return SeparatedF{b.pi_f(false), {}};
        else
          return std::nullopt;
      },
      bsdf);
}

// The value in 1/sr, without the cosine, of one part of the lobes.
inline Rgb f(const Bsdf& bsdf, const Vector3& wo, const Vector3& wi, LobePart part) {
  return std::visit(
      [&]<class B>(const B& b) {
        if (part == LobePart::kDiffuse) return b.f(wo, wi);
        if constexpr (HasGlossyValue<B>) return b.f_glossy(wo, wi);
        return Rgb(0);
      },
      bsdf);
}
// The density per solid angle of samples of that part.
inline float pdf(const Bsdf& bsdf, const Vector3& wo, const Vector3& wi, LobePart part) {
  return std::visit(
      [&]<class B>(const B& b) {
        if (part == LobePart::kDiffuse) return b.pdf(wo, wi);
        if constexpr (HasGlossyValue<B>) return b.pdf_glossy(wo, wi);
        return 0.0f;
      },
      bsdf);
}
// A sample of either part, or of the part alone that is asked for. uc in [0, 1), u in [0, 1)^2.
inline std::optional<BsdfSample> sample_f(const Bsdf& bsdf, const Vector3& wo, float uc, const Point2& u,
                                          TransportMode mode, Scatter part = Scatter::kEither) {
  return std::visit(
      [&]<class B>(const B& b) {
        if constexpr (SamplesParts<B>) {
          if (part == Scatter::kDiffuse) return b.sample_diffuse(wo, uc, u, mode);
          if (part == Scatter::kSpecular) return b.sample_specular(wo, uc, u, mode);
        }
        return b.sample_f(wo, uc, u, mode);
      },
      bsdf);
}

}  // namespace kaustik
