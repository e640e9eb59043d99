#pragma once
// A surface point seen from a direction: the BSDF in world space, with the checks that shading normals need.

#include <optional>

#include "core/sampling/sampler.h"
#include "core/scene/bsdf_at.h"
#include "core/scene/media.h"

namespace kaustik::render {

struct ShadingPoint {
  SurfaceInteraction si;
  Vector3 wo{0};  // unit, world, to the viewer (or to the previous vertex of the camera path)
  Frame frame;    // si.shading_frame()
  Vector3 wo_local{0};
  BsdfAt bsdf;
  MediumIndex medium = kVacuum;  // on the side of wo; set by those who follow paths through media
  // Of light that leaves towards wo, if it has only one. Set by those who follow paths through dispersive
  // glass.
  float wavelength = kNoWavelength;

  // If wo lies on different sides of the geometric and the shading surface of a non-specular material, the
  // geometric normal is used for shading, since the interpolated one is meaningless there. index_wavelength:
  // for which dispersive surfaces have their BSDF.
  ShadingPoint(const Scene& scene, const SurfaceInteraction& interaction, const Vector3& to_viewer,
               const Footprint& footprint = {}, float index_wavelength = kNoWavelength)
      : si(interaction), wo(to_viewer), bsdf(scene, si, to_viewer, footprint, index_wavelength) {
    if (!is_specular(*bsdf) && glm::dot(wo, si.n) * glm::dot(wo, si.ns) <= 0) si.ns = si.n;
    frame = si.shading_frame();
    wo_local = frame.to_local(wo);
  }

  bool specular() const { return is_specular(*bsdf); }

  // The point as LightSampler sees it.
  LightReceiver receiver() const {
    return {si.p, wo_local.z < 0 ? -si.ns : si.ns, !lit_from_one_side(*bsdf)};
  }
};

// f(wo, wi) |wi . ns| in 1/sr. Zero where wi lies on different sides of the geometric and the shading
// surface, so that no light leaks through (Veach 1997, section 5.3).
inline Rgb f_cos(const ShadingPoint& x, const Vector3& wi, LobePart part = LobePart::kDiffuse) {
  const Vector3 local = x.frame.to_local(wi);
  if (!(glm::dot(wi, x.si.n) * local.z > 0)) return Rgb(0);
  return f(*x.bsdf, x.wo_local, local, part) * std::abs(local.z);
}

// Density of scatter() per solid angle, given the lobes that were chosen.
inline float scatter_pdf(const ShadingPoint& x, const Vector3& wi, LobePart part = LobePart::kDiffuse) {
  return pdf(*x.bsdf, x.wo_local, x.frame.to_local(wi), part);
}

inline const Point3& position(const ShadingPoint& x) {
  return x.si.p;
}
// Ray that leaves in direction w, which need not be of unit length.
inline Ray spawn(const ShadingPoint& x, const Vector3& w, float t_max = kInfinity) {
  return x.si.spawn(w, t_max);
}
// The medium of a ray that leaves in direction w.
inline MediumIndex medium_towards(const Scene& scene, const ShadingPoint& x, const Vector3& w) {
  return medium_beyond(scene, x.si, x.wo, w, x.medium);
}

namespace detail {
// Transforms wi to world space; nothing if the geometric surface has it on another side than the shading
// surface.
inline std::optional<BsdfSample> in_world(const ShadingPoint& x, std::optional<BsdfSample> s) {
  if (!s) return {};
  const bool above = s->transmission ? glm::dot(x.wo, x.si.n) < 0 : glm::dot(x.wo, x.si.n) > 0;
  s->wi = x.frame.to_world(s->wi);
  if ((glm::dot(s->wi, x.si.n) > 0) != above) return {};
  return s;
}
}  // namespace detail

// Samples the BSDF; wi is in world space. Always draws three dimensions: uc, then a pair.
inline std::optional<BsdfSample> scatter(const ShadingPoint& x, Sampler& sampler,
                                         Scatter part = Scatter::kEither) {
  const float uc = sampler.next_1d();
  const Point2 u = sampler.next_2d();
  return detail::in_world(x, sample_f(*x.bsdf, x.wo_local, uc, u, TransportMode::kRadiance, part));
}

// For a BSDF that has only delta lobes: the lobe that uc chooses, with its probability as pdf.
inline std::optional<BsdfSample> scatter_delta(const ShadingPoint& x, float uc) {
  return detail::in_world(x, sample_f(*x.bsdf, x.wo_local, uc, {0, 0}, TransportMode::kRadiance));
}

}  // namespace kaustik::render
