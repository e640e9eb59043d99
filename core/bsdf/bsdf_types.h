#pragma once
// The interface that all BSDFs share.
//
// The lobes of a BSDF belong to one of two parts:
//   diffuse lobes    photons are gathered under them. They are wide; a rough metal's lobe may be one.
//   specular lobes   photons and camera paths follow them by sampling. They are delta lobes, or glossy lobes,
//                    whose width is finite but too small to gather under (Ggx::is_narrow).
// The part that scatters a path decides its class (docs/decisions/020-one-owner-per-path.md). A value can
// have diffuse lobes, specular lobes, or both.
//
// The concept BsdfType below lists what a BSDF must have. Directions are in the local shading frame (z = ns);
// wo and wi have unit length and point away from the surface, and wo.z < 0 means the back side:
//   static constexpr std::string_view kName
//     name of the type in messages and in `kaustik info`
//   static constexpr bool kTransmits
//     diffuse lobes can let light through the surface
//   static constexpr bool kLitFromOneSide
//     only light on wo's side matters. The choice of a light uses it; false is correct for every BSDF
//   static constexpr bool kDrawsLobe
//     photons draw the number uc for sample_f, which is 0 otherwise
//   static constexpr bool kScattersAboutN
//     where ns and n disagree about the side of a direction, photons are scattered about n
//     (photon/trace/shading_correction.h); only for lobes so wide that f about n and about ns are alike
//   bool anisotropic() const
//     f changes when the surface turns about its normal
//   Lobes lobes() const
//     the lobes that this value has
//   Rgb f(wo, wi) const
//     value of the diffuse lobes in 1/sr, without the cosine, for radiance that leaves towards wo
//   float pdf(wo, wi) const
//     density per solid angle of the diffuse samples of sample_f
//   std::optional<BsdfSample> sample_f(wo, uc, u, mode) const
//     uc in [0, 1) chooses the lobe, u in [0, 1)^2 the direction; nothing if no light is scattered
//   Rgb albedo() const
//     hemispherical reflectance, for the AOV
// These members come in pairs, for types that have values which need them:
//   f_glossy, pdf_glossy
//     like f and pdf, for the glossy lobes; required where lobes().glossy
//   sample_diffuse, sample_specular
//     like sample_f, for one part alone; required where lobes() has both parts
// These members are optional and make gathering faster:
//   Rgb pi_f(transmitted) const
//     pi f, where f is the same for all wi on a side
//   std::optional<SeparatedF> separated(wo) const
//     the diffuse lobes as a product of a factor of wo and one of wi, for values that are one
//   seen_from(wo)
//     an object whose f(wi) equals f(wo, wi), for many wi
// tests/core/support/bsdf_examples.h holds the values of each BSDF that all tests of BSDFs run over.

#include <concepts>
#include <optional>
#include <string_view>

#include "core/bsdf/microfacet/coat.h"
#include "core/math/vec.h"

namespace kaustik {

// Camera paths carry radiance, photon paths carry importance (Veach's adjoint). Refraction scales radiance by
// 1/eta^2 (Pharr 2023, section 9.5.2), but not flux.
enum class TransportMode { kRadiance, kImportance };

struct Lobes {
  bool diffuse = false;
  bool specular = false;
  bool glossy = false;  // the specular part has finite width, so lights can be sampled there
  bool rough =
      false;  // the diffuse part holds a microfacet lobe, which scatters little of what a photon brings
};
inline constexpr Lobes kDiffuseLobes{true, false, false}, kDeltaLobes{false, true, false},
    kGlossyLobes{false, true, true}, kRoughLobes{true, false, false, true};

// The lobes whose value is asked for: those under which photons are gathered, or those of finite width that
// are followed.
enum class LobePart { kDiffuse, kGlossy };
// The part of a BSDF that scatters: either one by chance, or one alone.
enum class Scatter { kEither, kDiffuse, kSpecular };

struct BsdfSample {
  Vector3 wi{0};  // local frame
  Rgb weight{0};  // f |cos wi| / density; for delta lobes the lobe's factor over its probability
  // Density per solid angle, given the chosen part; for delta lobes the probability of the lobe.
  float pdf = 0;
  bool specular = false;  // whether the specular part was chosen
  bool transmission = false;
  bool glossy = false;  // specular, but not a delta lobe
};

// Whether a density is usable. Lobes evaluated at their very edge may overflow or underflow; such samples are
// dropped.
inline bool is_density(float pdf) {
  return pdf > 0 && pdf < kInfinity;
}
inline float cos_theta(const Vector3& w) {
  return w.z;
}
inline float abs_cos_theta(const Vector3& w) {
  return std::abs(w.z);
}
inline bool same_hemisphere(const Vector3& a, const Vector3& b) {
  return a.z * b.z > 0;
}

// Diffuse lobes whose value for wi on wo's side is  of_wo T(wi) / pi,  T being the coat's transmittance, and
// zero on the other side.
struct SeparatedF {
  Rgb of_wo{0};
  Coat coat{};
};

template <class B>
concept HasGlossyValue = requires(const B& b, const Vector3& w) {
  { b.f_glossy(w, w) } -> std::same_as<Rgb>;
  { b.pdf_glossy(w, w) } -> std::same_as<float>;
};
template <class B>
concept SamplesParts = requires(const B& b, const Vector3& w, float uc, const Point2& u, TransportMode mode) {
  { b.sample_diffuse(w, uc, u, mode) } -> std::same_as<std::optional<BsdfSample>>;
  { b.sample_specular(w, uc, u, mode) } -> std::same_as<std::optional<BsdfSample>>;
};
template <class B>
concept HasConstantValue = requires(const B& b) {
  { b.pi_f(true) } -> std::same_as<Rgb>;
};
template <class B>
concept MaySeparate = requires(const B& b, const Vector3& wo) {
  { b.separated(wo) } -> std::same_as<std::optional<SeparatedF>>;
};

// What every BSDF must have; the meanings are at the top of this file.
template <class B>
concept BsdfType = requires(const B& b, const Vector3& w, float uc, const Point2& u, TransportMode mode) {
  { B::kName } -> std::convertible_to<std::string_view>;
  { B::kTransmits } -> std::convertible_to<bool>;
  { B::kLitFromOneSide } -> std::convertible_to<bool>;
  { B::kDrawsLobe } -> std::convertible_to<bool>;
  { B::kScattersAboutN } -> std::convertible_to<bool>;
  { b.anisotropic() } -> std::same_as<bool>;
  { b.lobes() } -> std::same_as<Lobes>;
  { b.f(w, w) } -> std::same_as<Rgb>;
  { b.pdf(w, w) } -> std::same_as<float>;
  { b.sample_f(w, uc, u, mode) } -> std::same_as<std::optional<BsdfSample>>;
  { b.albedo() } -> std::same_as<Rgb>;
  requires !(B::kTransmits && B::kLitFromOneSide);
  requires !(B::kTransmits && B::kScattersAboutN);
  // Members that come in pairs: both or neither.
  requires HasGlossyValue<B> || !(
      requires { b.f_glossy(w, w); } || requires { b.pdf_glossy(w, w); });
  requires SamplesParts<B> || !(
      requires { b.sample_diffuse(w, uc, u, mode); } || requires { b.sample_specular(w, uc, u, mode); });
};

}  // namespace kaustik
