#pragma once
// What a flux is, and Veach's correction of photons' flux for shading normals.

#include <type_traits>

#include "core/bsdf/bsdf.h"
#include "core/geometry/interaction.h"

namespace kaustik::photon::detail {

inline bool is_valid_flux(const Rgb& flux) {
  return is_finite(flux) && flux.x >= 0 && flux.y >= 0 && flux.z >= 0;
}

// Shading normals. With ns the camera path's measurement is defined as (Veach 1997, section 5.3)
//   Lo(wo) = integral f(wo, wi) Li(wi) |wi.ns| dwi,
// while photons that cross the geometric surface from wi bring the flux dPhi = Li |wi.n| dwi dA. Hence
//   Lo(wo) = 1/dA sum f(wo, wi) dPhi c(wi)   with   c(w) = |w.ns| / |w.n|,
// so a deposit carries c(wi). A photon that goes on in wi carries Lo(wi) |wi.n| dwi dA: with sample_f's
// weight f |wi.ns| / pdf the factor left is c(wo) / c(wi), where wo points back to where the photon came
// from. Both hold for delta lobes too, whose f has 1/|wi.ns|. Directions on different sides of n and ns carry
// nothing (no light leaks), as on camera paths; but for light that leaves matt surfaces there: below.
//
// cos_ns = w.ns. Returns c(w), zero when the sides differ; exactly one when ns equals n.
inline float shading_correction(const SurfaceInteraction& si, const Vector3& w, float cos_ns) {
  const float cos_n = glm::dot(w, si.n);
  if (!(cos_n * cos_ns > 0)) return 0;
  return si.n == si.ns ? 1.0f : cos_ns / cos_n;
}

// Seen from where n and ns disagree, matt surfaces are shaded by n (render/estimators/shading_point.h), so
// towards there Lo(w) = 1/dA sum f_n(w, wi) dPhi, without c, of whatever crosses the geometric surface.
template <class B>
inline constexpr bool kIsMatt =
    std::is_same_v<B, Lambertian> || std::is_same_v<B, OrenNayar> || std::is_same_v<B, CoatedDiffuse>;

inline bool sides_differ(const SurfaceInteraction& si, const Vector3& w) {
  return !(glm::dot(w, si.n) * glm::dot(w, si.ns) > 0);
}

// A photon that comes from wo, where the sides differ, goes on only where they differ too: its direction is
// to be sampled about n.
template <class B>
bool scatters_about_n(const SurfaceInteraction& si, const Vector3& wo) {
  return kIsMatt<B> && si.n != si.ns && sides_differ(si, wo);
}

inline Frame geometric_frame(SurfaceInteraction si) {
  si.ns = si.n;
  return si.shading_frame();
}

// Where a photon goes on, and the factor to its flux; zero: nowhere.
struct Onward {
  Vector3 wi{0};
  Rgb weight{0};
};

// A sample about ns that ends below the surface, in the mirror that swaps n and ns: a sample of the
// directions above it where the sides differ, as dense there in |w.n| as the other was in |w.ns|.
template <class B>
Onward mirrored(const B& bsdf, const SurfaceInteraction& si, const Vector3& wo, const Vector3& below,
                const Vector3& wo_local, const BsdfSample& sample) {
  const Vector3 across = glm::normalize(si.ns - si.n);
  const Vector3 wi = below - 2 * glm::dot(below, across) * across;
  const Frame frame = geometric_frame(si);
  const Rgb sampled = bsdf.f(wo_local, sample.wi), wanted = bsdf.f(frame.to_local(wo), frame.to_local(wi));
  Onward onward{wi};
  for (int c = 0; c < 3; ++c)
    onward.weight[c] = sampled[c] > 0 ? sample.weight[c] * (wanted[c] / sampled[c]) : 0;
  return onward;
}

// A photon from wo whose sample was drawn in `frame`: that of ns, or of n where it scatters_about_n.
template <class B>
Onward onward(const B& bsdf, const SurfaceInteraction& si, const Frame& frame, const Vector3& wo,
              const Vector3& wo_local, const BsdfSample& sample) {
  const Vector3 wi = frame.to_world(sample.wi);
  if (scatters_about_n<B>(si, wo)) return {wi, sides_differ(si, wi) ? sample.weight : Rgb(0)};
  const float c_out = shading_correction(si, wi, sample.wi.z);
  if (c_out != 0) return {wi, sample.weight * (shading_correction(si, wo, wo_local.z) / c_out)};
  if constexpr (kIsMatt<B>) {
    if (!sample.specular && si.n != si.ns) return mirrored(bsdf, si, wo, wi, wo_local, sample);
  }
  return {wi};
}

}  // namespace kaustik::photon::detail
