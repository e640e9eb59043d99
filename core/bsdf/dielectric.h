#pragma once
// Smooth and rough boundaries between dielectrics, such as glass and water.
// What lies behind the boundary absorbs as a medium does (core/medium/medium.h).

#include "core/bsdf/bsdf_types.h"
#include "core/bsdf/lobe_tints.h"
#include "core/bsdf/microfacet/fresnel.h"
#include "core/bsdf/microfacet/ggx.h"

namespace kaustik {

// Boundary between two dielectrics, at a smooth surface or at GGX microfacets (Pharr 2023, sections 9.5 and
// 9.7). Fresnel reflection or refraction is chosen in proportion to the Fresnel factors and the tints.
struct Dielectric {
  static constexpr std::string_view kName = "dielectric";
  static constexpr bool kTransmits = true;
  static constexpr bool kLitFromOneSide = false;
  static constexpr bool kDrawsLobe = true;
  static constexpr bool kScattersAboutN = false;

  float eta = 1.5f;  // of the inside (below the surface) relative to the outside
  Ggx facets{};      // smooth if eta is one, where there is no boundary
  LobeTints tints{};
  bool disperses = false;  // eta is that of one wavelength

  bool anisotropic() const { return facets.anisotropic(); }
  Lobes lobes() const {
    if (facets.smooth()) return kDeltaLobes;
    return facets.is_narrow() ? kGlossyLobes : kRoughLobes;
  }
  Rgb f(const Vector3& wo, const Vector3& wi) const { return lobes().diffuse ? f_rough(wo, wi) : Rgb(0); }
  float pdf(const Vector3& wo, const Vector3& wi) const { return lobes().diffuse ? pdf_rough(wo, wi) : 0; }
  Rgb f_glossy(const Vector3& wo, const Vector3& wi) const {
    return lobes().glossy ? f_rough(wo, wi) : Rgb(0);
  }
  float pdf_glossy(const Vector3& wo, const Vector3& wi) const {
    return lobes().glossy ? pdf_rough(wo, wi) : 0;
  }
  std::optional<BsdfSample> sample_f(const Vector3& wo, float uc, const Point2& u, TransportMode mode) const {
    if (wo.z == 0) return std::nullopt;
    if (!facets.smooth()) return sample_rough(wo, uc, u, mode);
    if (tints.tinted()) return sample_tinted(wo, uc, mode);
    if (eta == 1) return BsdfSample{-wo, Rgb(1), 1, true, true};
    const float relative = wo.z > 0 ? eta : 1 / eta;
    const float cos_i = std::min(std::abs(wo.z), 1.0f);
    const float cos_t = refracted_cosine(cos_i, relative);
    const float reflectance = fresnel_from_cosines(cos_i, cos_t, relative);
    // The probability of each lobe is its factor, so the weight is exactly one (before eta^2).
    if (uc < reflectance) return BsdfSample{{-wo.x, -wo.y, wo.z}, Rgb(1), reflectance, true, false};
    const float inverse = 1 / relative;
    const float scale = mode == TransportMode::kRadiance ? inverse * inverse : 1.0f;
    return BsdfSample{refracted(wo, inverse, cos_t), Rgb(scale), 1 - reflectance, true, true};
  }
  // Takes the index of one wavelength.
  void disperse(double index) {
    eta = static_cast<float>(index);
    disperses = true;
    if (eta == 1) facets = Ggx{};  // no boundary
  }
  // Whether what the sample of wo sends on has one wavelength from there on. Smooth surfaces reflect all
  // light alike on their thinner side: the reflectance is that of the wavelength, but varies little. On the
  // denser side total reflection begins at another angle for each wavelength.
  bool selects_wavelength(const Vector3& wo, const BsdfSample& s) const {
    const bool denser = (eta > 1) == (wo.z < 0);
    return disperses && (s.transmission || denser || !facets.smooth());
  }
  Rgb albedo() const { return tints.tinted() ? tints.albedo(eta) : Rgb(1); }

 private:
  static Vector3 refracted(const Vector3& wo, float inverse, float cos_t) {
    return {-wo.x * inverse, -wo.y * inverse, wo.z > 0 ? -cos_t : cos_t};
  }
  // A sample of the smooth surface with tints.
  std::optional<BsdfSample> sample_tinted(const Vector3& wo, float uc, TransportMode mode) const;
  // The lobes of the rough surface, whether they are diffuse or glossy.
  Rgb f_rough(const Vector3& wo, const Vector3& wi) const;
  float pdf_rough(const Vector3& wo, const Vector3& wi) const;
  std::optional<BsdfSample> sample_rough(const Vector3& wo, float uc, const Point2& u,
                                         TransportMode mode) const;
};

}  // namespace kaustik
