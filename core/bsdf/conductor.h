#pragma once
// Smooth and rough metal.

#include "core/bsdf/bsdf_types.h"
#include "core/bsdf/microfacet/ggx.h"

namespace kaustik {

// Metal, on both sides: reflection with the Fresnel factor of a conductor, at a smooth surface or at GGX
// microfacets (Pharr 2023, sections 9.4 and 9.7).
struct Conductor {
  static constexpr std::string_view kName = "conductor";
  static constexpr bool kTransmits = false;
  static constexpr bool kLitFromOneSide = false;
  static constexpr bool kDrawsLobe = true;
  static constexpr bool kScattersAboutN = false;

  Rgb eta{1}, k{1};
  Ggx facets{};

  bool anisotropic() const { return facets.anisotropic(); }
  Lobes lobes() const {
    return facets.smooth() ? kDeltaLobes : facets.is_narrow() ? kGlossyLobes : kRoughLobes;
  }
  Rgb f(const Vector3& wo, const Vector3& wi) const { return lobes().diffuse ? f_rough(wo, wi) : Rgb(0); }
  float pdf(const Vector3& wo, const Vector3& wi) const { return lobes().diffuse ? pdf_rough(wo, wi) : 0; }
  Rgb f_glossy(const Vector3& wo, const Vector3& wi) const {
    return lobes().glossy ? f_rough(wo, wi) : Rgb(0);
  }
  float pdf_glossy(const Vector3& wo, const Vector3& wi) const {
    return lobes().glossy ? pdf_rough(wo, wi) : 0;
  }
  std::optional<BsdfSample> sample_f(const Vector3& wo, float uc, const Point2& u, TransportMode mode) const;
  // Reflectance of the whole hemisphere under uniform light, by an 8-point rule and for a smooth surface: for
  // the AOV and previews, not for transport.
  Rgb albedo() const;

 private:
  Rgb reflectance(float cos_theta_i) const;
  // The lobe of the rough surface, whether it is diffuse or glossy.
  Rgb f_rough(const Vector3& wo, const Vector3& wi) const;
  float pdf_rough(const Vector3& wo, const Vector3& wi) const;
};

}  // namespace kaustik
