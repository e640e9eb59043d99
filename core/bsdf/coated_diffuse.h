#pragma once
// A diffuse surface under a smooth or rough dielectric coat, with all reflections between both.

#include "core/bsdf/bsdf_types.h"
#include "core/bsdf/microfacet/fresnel.h"
#include "core/bsdf/microfacet/ggx.h"

namespace kaustik {

// A dielectric coat over a Lambertian base, the same on both sides. The coat, smooth (a delta lobe) or with
// GGX facets, reflects light or lets it in; the base scatters it, and it leaves after any number of
// reflections between base and coat. The base makes the light inside the coat uniform over directions
// whatever came in, so only the total reflectance of the coat from inside matters, and the geometric sum over
// reflections is exact:
// f = coat(wo, wi) + T(wo) T(wi) rho / (pi eta^2 (1 - rho Ri)),
// where T is the transmittance of the coat (1 - F if smooth) and Ri its reflectance from inside for uniform
// light. Not modelled: thickness (the coat does not absorb, and light leaves where it entered) and scattering
// by several facets, whose light is lost.
struct CoatedDiffuse {
  static constexpr std::string_view kName = "coateddiffuse";
  static constexpr bool kTransmits = false;
  static constexpr bool kLitFromOneSide = false;
  static constexpr bool kDrawsLobe = true;
  static constexpr bool kScattersAboutN = true;

  float eta = 1.5f;  // of the coat relative to the outside; at least one if the coat is rough
  Ggx facets{};
  Rgb base{0.5f};    // rho / (eta^2 (1 - rho Ri))
  float enters = 1;  // T for uniform light

  // Without a coat (eta = 1) the facets are smooth.
  static CoatedDiffuse from_reflectance(const Rgb& rho, float eta, const Ggx& facets = {});

  bool anisotropic() const { return facets.anisotropic(); }
  Lobes lobes() const {
    return {true, !coat_is_diffuse(), !facets.smooth() && !coat_is_diffuse(), coat_is_diffuse()};
  }
  Rgb f(const Vector3& wo, const Vector3& wi) const;
  // Evaluates f for one wo and many wi.
  class Seen {
   public:
    Seen(const CoatedDiffuse& bsdf, const Vector3& wo);
    Rgb f(const Vector3& wi) const {
      if (!same_hemisphere(wo_, wi)) return Rgb(0);
      const float z = abs_cos_theta(wi);
      const Rgb from_base = from_base_ * through_(z);
      return bsdf_->coat_is_diffuse() ? from_base + bsdf_->f_coat(wo_, wi) : from_base;
    }

   private:
    const CoatedDiffuse* bsdf_;
    Vector3 wo_;
    Rgb from_base_;  // without the factor T(wi)
    CoatTransmittance through_;
  };
  Seen seen_from(const Vector3& wo) const { return {*this, wo}; }
  std::optional<SeparatedF> separated(const Vector3& wo) const;
  float pdf(const Vector3& wo, const Vector3& wi) const;
  Rgb f_glossy(const Vector3& wo, const Vector3& wi) const;
  float pdf_glossy(const Vector3& wo, const Vector3& wi) const;
  // Chooses the coat or the base with a probability according to their shares of the scattered light.
  std::optional<BsdfSample> sample_f(const Vector3& wo, float uc, const Point2& u, TransportMode mode) const;
  std::optional<BsdfSample> sample_diffuse(const Vector3& wo, float uc, const Point2& u,
                                           TransportMode mode) const;
  std::optional<BsdfSample> sample_specular(const Vector3& wo, float uc, const Point2& u,
                                            TransportMode mode) const;
  // Albedo with a smooth coat.
  Rgb albedo() const;

 private:
  Coat coat() const;
  bool coat_is_diffuse() const { return !facets.smooth() && !facets.is_narrow(); }
  float transmittance(const Vector3& w) const;
  float share_of_coat(const Vector3& wo) const;
  // The rough coat.
  float f_coat(const Vector3& wo, const Vector3& wi) const;
  float pdf_coat(const Vector3& wo, const Vector3& wi) const;
  std::optional<BsdfSample> sample_coat(const Vector3& wo, const Point2& u) const;
  std::optional<BsdfSample> sample_base(const Vector3& wo, const Point2& u) const;
};

}  // namespace kaustik
