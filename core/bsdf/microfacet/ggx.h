#pragma once
// Microfacets with the GGX distribution (Trowbridge and Reitz 1975; Walter et al. 2007; Heitz 2014), with the
// conventions of pbrt-v4 (Pharr et al. 2023, section 9.6). All directions are in the local frame and may lie
// on either side of the surface. Not modelled: light that is scattered by several facets, so rough surfaces
// lose up to some ten percent, as in pbrt.

#include "core/math/vec.h"

namespace kaustik {

struct Ggx {
  float alpha_x = 0, alpha_y = 0;  // both zero: smooth; only smooth() may then be called

  // As in pbrt, a surface with alpha below kSmoothAlpha in both directions counts as smooth; otherwise alpha
  // is raised to at least kLeastAlpha in each direction.
  static constexpr float kSmoothAlpha = 1e-3f, kLeastAlpha = 1e-4f;
  // u and v: roughness >= 0 along x and y. remap: alpha = sqrt(roughness), otherwise alpha = roughness.
  static Ggx from_roughness(float u, float v, bool remap);

  bool smooth() const { return alpha_x == 0; }
  bool anisotropic() const { return alpha_x != alpha_y; }
  // Whether the lobe is glossy: so narrow that following it beats gathering photons under it
  // (docs/decisions/021-narrow-lobes-are-followed.md).
  bool is_narrow() const { return alpha_x * alpha_y < kNarrowAlpha * kNarrowAlpha; }
  static constexpr float kNarrowAlpha = 0.3f;

  // Density of the facets' normals per solid angle; its integral times the cosine is one.
  float D(const Vector3& wm) const {
    const float x = wm.x / alpha_x, y = wm.y / alpha_y;
    const float s = x * x + y * y + wm.z * wm.z;
    return kInvPi / (alpha_x * alpha_y * s * s);
  }
  // Smith's height-correlated masking and shadowing G(wo, wi), divided by 4 |cos wo cos wi|.
  float masking(const Vector3& wo, const Vector3& wi) const {
    return 0.5f / (stretched(wo) * std::abs(wi.z) + stretched(wi) * std::abs(wo.z));
  }
  // G(wo, wi) / G1(wo): the share of the light scattered towards wi by facets visible from wo that is not
  // blocked.
  float unshadowed(const Vector3& wo, const Vector3& wi) const {
    const float o = stretched(wo), cos_i = std::abs(wi.z), cos_o = std::abs(wo.z);
    return cos_i * (cos_o + o) / (o * cos_i + stretched(wi) * cos_o);
  }
  // Density of the normals visible from w.
  float visible_D(const Vector3& w, const Vector3& wm) const {
    return 2 / (std::abs(w.z) + stretched(w)) * D(wm) * std::abs(glm::dot(w, wm));
  }
  // Density of the directions into which the visible normals reflect w.
  float reflection_pdf(const Vector3& w, const Vector3& wm) const {
    return D(wm) / (2 * (std::abs(w.z) + stretched(w)));
  }
  // Samples a visible normal on w's side (Heitz 2018, "Sampling the GGX Distribution of Visible Normals").
  Vector3 sample_visible(const Vector3& w, const Point2& u) const;

 private:
  // |cos| (1 + 2 Lambda), which is finite at grazing angles, where Smith's Lambda is not.
  float stretched(const Vector3& w) const {
    const float x = alpha_x * w.x, y = alpha_y * w.y;
    return std::sqrt(x * x + y * y + w.z * w.z);
  }
};

}  // namespace kaustik
