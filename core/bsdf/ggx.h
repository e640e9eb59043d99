#pragma once
// Microfacets of the GGX distribution (Trowbridge and Reitz 1975; Walter et al. 2007; Heitz 2014), by the
// conventions of pbrt-v4 (Pharr et al. 2023, section 9.6). All directions lie in the local frame; which side
// of the surface they are on does not matter. Not modelled: light that meets several facets, so that rough
// surfaces lose up to some ten percent, as they do in pbrt.

#include "core/bsdf/bsdf_types.h"

namespace kaustik {

struct Ggx {
  float alpha_x = 0, alpha_y = 0;  // both zero: smooth, and nothing below smooth() may be called

  // Below this alpha in both directions a surface counts as smooth; a smaller one than kLeastAlpha in one
  // direction is raised to it. As in pbrt.
  static constexpr float kSmoothAlpha = 1e-3f, kLeastAlpha = 1e-4f;
  // Roughness >= 0 along x and y. remap: alpha = sqrt(roughness), else alpha is the roughness.
  static Ggx from_roughness(float u, float v, bool remap);

  bool smooth() const { return alpha_x == 0; }
  // Below the roughness from which on gathering photons under a lobe beats following it (docs/accuracy.md,
  // "Rough surfaces"): the lobe is followed.
  bool is_narrow() const { return alpha_x * alpha_y < kNarrowAlpha * kNarrowAlpha; }
  static constexpr float kNarrowAlpha = 0.3f;

  // Density of facets' normals per solid angle, times the cosine integrating to one.
  float D(const Vector3& wm) const {
    const float x = wm.x / alpha_x, y = wm.y / alpha_y;
    const float s = x * x + y * y + wm.z * wm.z;
    return kInvPi / (alpha_x * alpha_y * s * s);
  }
  // Smith's height-correlated masking and shadowing G(wo, wi), over 4 |cos wo cos wi|.
  float masking(const Vector3& wo, const Vector3& wi) const {
    return 0.5f / (stretched(wo) * std::abs(wi.z) + stretched(wi) * std::abs(wo.z));
  }
  // G(wo, wi) / G1(wo): of the light scattered by facets that wo sees, what leaves towards wi.
  float unshadowed(const Vector3& wo, const Vector3& wi) const {
    const float o = stretched(wo), cos_i = std::abs(wi.z), cos_o = std::abs(wo.z);
    return cos_i * (cos_o + o) / (o * cos_i + stretched(wi) * cos_o);
  }
  // Density of the normals that are seen from w.
  float visible_D(const Vector3& w, const Vector3& wm) const {
    return 2 / (std::abs(w.z) + stretched(w)) * D(wm) * std::abs(glm::dot(w, wm));
  }
  // Of directions that such normals reflect w to.
  float reflection_pdf(const Vector3& w, const Vector3& wm) const {
    return D(wm) / (2 * (std::abs(w.z) + stretched(w)));
  }
  // One of them, on w's side (Heitz 2018, "Sampling the GGX Distribution of Visible Normals").
  Vector3 sample_visible(const Vector3& w, const Point2& u) const;

 private:
  // |cos| (1 + 2 Lambda): finite at grazing, where Smith's Lambda is not.
  float stretched(const Vector3& w) const {
    const float x = alpha_x * w.x, y = alpha_y * w.y;
    return std::sqrt(x * x + y * y + w.z * w.z);
  }
};

}  // namespace kaustik
