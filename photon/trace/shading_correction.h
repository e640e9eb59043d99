#pragma once
// Validity of a flux, and Veach's correction of photon flux for shading normals.

#include "core/bsdf/bsdf.h"
#include "core/geometry/interaction.h"

namespace kaustik::photon::detail {

inline bool is_valid_flux(const Rgb& flux) {
  return is_finite(flux) && flux.x >= 0 && flux.y >= 0 && flux.z >= 0;
}

// Shading normals. With the shading normal ns, the camera path's measurement is defined as (Veach 1997,
// section 5.3)
//   Lo(wo) = integral f(wo, wi) Li(wi) |wi.ns| dwi,
// while photons that cross the geometric surface from wi bring the flux dPhi = Li |wi.n| dwi dA. Hence
//   Lo(wo) = 1/dA sum f(wo, wi) dPhi c(wi)   with   c(w) = |w.ns| / |w.n|,
// so a deposit is multiplied by c(wi). A photon that continues towards wi carries Lo(wi) |wi.n| dwi dA: with
// sample_f's weight f |wi.ns| / pdf, the remaining factor is c(wo) / c(wi), where wo points back to where the
// photon came from. Both hold for delta lobes too, whose f contains 1/|wi.ns|. Directions on different sides
// of n and ns carry nothing (no light leaks), as on camera paths. The exception is light that leaves
// BSDFs whose kScattersAboutN is true in such directions: see below.
//
// cos_ns = w.ns. Returns c(w): zero when the sides differ, exactly one when ns equals n.
inline float shading_correction(const SurfaceInteraction& si, const Vector3& w, float cos_ns) {
  const float cos_n = glm::dot(w, si.n);
  if (!(cos_n * cos_ns > 0)) return 0;
  return si.n == si.ns ? 1.0f : cos_ns / cos_n;
}

// Camera paths shade non-specular surfaces by n when they see them from a direction on different sides of n
// and ns (render/camera/shading_point.h). Towards such directions Lo(w) = 1/dA sum f_n(w, wi) dPhi,
// without the factor c, for all photons that cross the geometric surface. Photons do the same at BSDFs whose
// kScattersAboutN is true.

inline bool sides_differ(const SurfaceInteraction& si, const Vector3& w) {
  return !(glm::dot(w, si.n) * glm::dot(w, si.ns) > 0);
}

// A photon that arrives from a direction wo on different sides of n and ns continues only in such directions;
// its direction must be sampled about n.
template <class B>
bool scatters_about_n(const SurfaceInteraction& si, const Vector3& wo) {
  return B::kScattersAboutN && si.n != si.ns && sides_differ(si, wo);
}

inline Frame geometric_frame(SurfaceInteraction si) {
  si.ns = si.n;
  return si.shading_frame();
}

// Next direction of a photon, and the factor for its flux; a zero factor ends the path.
struct Onward {
  Vector3 wi{0};
  Rgb weight{0};
};

// Turns a sample about ns that ended below the geometric surface into one of the directions above the surface
// for which the sides of n and ns differ: it is reflected in the plane that swaps n and ns, which preserves
// the density (now with respect to |w.n| instead of |w.ns|).
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

// Next direction of a photon that comes from wo and whose sample was drawn in `frame`, the frame about n if
// scatters_about_n<B>(si, wo) and about ns otherwise.
template <class B>
Onward onward(const B& bsdf, const SurfaceInteraction& si, const Frame& frame, const Vector3& wo,
              const Vector3& wo_local, const BsdfSample& sample) {
  const Vector3 wi = frame.to_world(sample.wi);
  if (scatters_about_n<B>(si, wo)) return {wi, sides_differ(si, wi) ? sample.weight : Rgb(0)};
  const float c_out = shading_correction(si, wi, sample.wi.z);
  if (c_out != 0) return {wi, sample.weight * (shading_correction(si, wo, wo_local.z) / c_out)};
  if constexpr (B::kScattersAboutN) {
    if (!sample.specular && si.n != si.ns) return mirrored(bsdf, si, wo, wi, wo_local, sample);
  }
  return {wi};
}

}  // namespace kaustik::photon::detail
