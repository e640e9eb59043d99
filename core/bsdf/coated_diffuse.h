#pragma once
#include "core/bsdf/fresnel.h"
#include "core/bsdf/ggx.h"
#include "core/bsdf/rough_coat.h"

namespace kaustik {

// A dielectric coat over a Lambertian base, both sides alike. Light is reflected by the coat, smooth (a delta
// lobe) or of GGX facets, or goes in, is scattered by the base, and goes out after any number of reflections
// between base and coat. The base's light is even inside the coat, whatever came in, so what the coat throws
// back is known by its sum alone. The sum over reflections is geometric and exact,
//   f = coat(wo, wi) + T(wo) T(wi) rho / (pi eta^2 (1 - rho Ri)),
// with T the share of light that a coat lets through, 1 - F for a smooth one, and Ri what it throws back of
// even light from inside. Thickness has no effect: nothing absorbs in the coat, and light leaves where it
// came in. What facets lose by single scattering is lost.
struct CoatedDiffuse {
  static constexpr std::string_view kName = "coateddiffuse";

  float eta = 1.5f;  // of the coat over the outside; at least one where it is rough
  Ggx facets{};
  Rgb base{0.5f};    // rho / (eta^2 (1 - rho Ri))
  float enters = 1;  // T of even light

  // Smooth where eta is one: no coat.
  static CoatedDiffuse from_reflectance(const Rgb& rho, float eta, const Ggx& facets = {});

  Lobes lobes() const { return {true, !coat_is_broad(), !facets.smooth() && !coat_is_broad()}; }
  Rgb f(const Vector3& wo, const Vector3& wi) const;
  // f of one wo, for many wi.
  class Seen {
   public:
    Seen(const CoatedDiffuse& bsdf, const Vector3& wo);
    Rgb f(const Vector3& wi) const {
      if (!same_hemisphere(wo_, wi)) return Rgb(0);
      const float z = abs_cos_theta(wi);
      const float T = bsdf_->facets.smooth() ? 1 - fresnel_dielectric(z, bsdf_->eta) : through_(z);
      return bsdf_->coat_is_broad() ? from_base_ * T + bsdf_->f_coat(wo_, wi) : from_base_ * T;
    }

   private:
    const CoatedDiffuse* bsdf_;
    Vector3 wo_;
    Rgb from_base_;  // but for T(wi)
    RoughTransmittance through_;
  };
  Seen seen_from(const Vector3& wo) const { return {*this, wo}; }
  float pdf(const Vector3& wo, const Vector3& wi) const;
  Rgb f_glossy(const Vector3& wo, const Vector3& wi) const;
  float pdf_glossy(const Vector3& wo, const Vector3& wi) const;
  // The coat and the base, each with the probability of its share of what is scattered.
  std::optional<BsdfSample> sample_f(const Vector3& wo, float uc, const Point2& u, TransportMode mode) const;
  std::optional<BsdfSample> sample_broad(const Vector3& wo, float uc, const Point2& u,
                                         TransportMode mode) const;
  std::optional<BsdfSample> sample_specular(const Vector3& wo, float uc, const Point2& u,
                                            TransportMode mode) const;
  // Of a smooth coat.
  Rgb albedo() const;

 private:
  bool coat_is_broad() const { return !facets.smooth() && !facets.is_narrow(); }
  float transmittance(const Vector3& w) const;
  float share_of_coat(const Vector3& wo) const;
  // The coat of facets.
  float f_coat(const Vector3& wo, const Vector3& wi) const;
  float pdf_coat(const Vector3& wo, const Vector3& wi) const;
  std::optional<BsdfSample> sample_coat(const Vector3& wo, const Point2& u) const;
  std::optional<BsdfSample> sample_base(const Vector3& wo, const Point2& u) const;
};

}  // namespace kaustik
