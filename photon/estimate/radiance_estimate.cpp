// Radiance estimate: the BSDF's type is resolved once, outside the sum over photons.

#include "photon/estimate/radiance_estimate.h"

#include <algorithm>
#include <optional>
#include <variant>

#include "photon/estimate/boundary_correction.h"
#include "photon/gather/gather.h"
#include "photon/gather/nearest.h"

namespace kaustik::photon {

namespace {

// Precomputes what depends on wo alone, for BSDFs that support it.
template <class AnyBsdf>
auto seen_from(const AnyBsdf& bsdf, const Vector3& wo) {
  if constexpr (requires { bsdf.seen_from(wo); }) {
    return bsdf.seen_from(wo);
  } else {
    struct Seen {
      const AnyBsdf& bsdf;
      const Vector3& wo;
      Rgb f(const Vector3& wi) const { return bsdf.f(wo, wi); }
    };
    return Seen{bsdf, wo};
  }
}

// The disc over which photons are summed, and the point that scatters their light.
struct DiscSum {
  const PhotonMap& map;
  const GatherQuery& query;
  const KernelSpec& kernel;
  const Frame& frame;
  const Vector3& wo;   // local
  const WallCut* cut;  // null where no wall is near
  GatherCounters& counters;
};

// Lr = sum of f_r(x, wo, wi_p) flux_p K(|x - x_p|); f_r is taken out of the sum where it is constant.
struct ReflectedRadiance : DiscSum {
  template <HasConstantValue ConstantBsdf>
  Rgb operator()(const ConstantBsdf& bsdf) const {
    const bool transmitted = glm::dot(query.n, frame.z) * wo.z < 0;
    const Rgb flux =
        cut ? gather_flux(map, query, kernel, *cut, counters) : gather_flux(map, query, kernel, counters);
    return bsdf.pi_f(transmitted) * kInvPi * flux;
  }

  template <class AnyBsdf>
  Rgb operator()(const AnyBsdf& bsdf) const {
    if (!bsdf.lobes().diffuse) return Rgb(0);
    const KernelTerms terms = kernel_terms(kernel, query.radius);
    const auto seen = seen_from(bsdf, wo);
    Rgb Lr(0);
    for_each_photon(
        map, query,
        [&](const Photon& photon, float distance_squared) {
          if (cut && cut->hides(photon.p, photon.wi)) return void(--counters.accepted);
          const Vector3 wi = frame.to_local(photon.wi);
          Lr += seen.f(wi) * photon.flux * kernel_value(kernel.type, terms, distance_squared);
        },
        counters);
    return Lr;
  }
};

// The sum over the photons whose directions are faint in the glossy lobes.
struct GlossyTail : DiscSum {
  float most_pdf;

  template <class AnyBsdf>
  Rgb operator()(const AnyBsdf& bsdf) const {
    Rgb Lr(0);
    if constexpr (HasGlossyValue<AnyBsdf>) {
      if (!bsdf.lobes().glossy) return Lr;
      const KernelTerms terms = kernel_terms(kernel, query.radius);
      for_each_photon(
          map, query,
          [&](const Photon& photon, float distance_squared) {
            if (cut && cut->hides(photon.p, photon.wi)) return void(--counters.accepted);
            const Vector3 wi = frame.to_local(photon.wi);
            if (!(bsdf.pdf_glossy(wo, wi) < most_pdf)) return;
            Lr += bsdf.f_glossy(wo, wi) * photon.flux * kernel_value(kernel.type, terms, distance_squared);
          },
          counters);
    }
    return Lr;
  }
};

// A point of the surface, its BSDF, and the direction from which it is seen.
struct SeenPoint {
  const SurfaceInteraction& si;
  const Vector3& wo;
  const Bsdf& bsdf;
};

// Sum is ReflectedRadiance or GlossyTail, more its last members.
template <class Sum, class... More>
Rgb radiance_of_disc(const PhotonMap& map, const SeenPoint& x, const GatherQuery& disc,
                     const EstimateSettings& settings, GatherCounters& counters, const More&... more) {
  const Frame frame = x.si.shading_frame();
  const Vector3 wo = frame.to_local(x.wo);
  std::optional<WallCut> cut;
  if (settings.walls && settings.walls->near(x.si.p))
    cut.emplace(*settings.walls, x.si, x.wo, disc.n, disc.radius);
  const WallCut* const cuts = cut && cut->cuts() ? &*cut : nullptr;
  const Rgb Lr = std::visit(Sum{{map, disc, settings.kernel, frame, wo, cuts, counters}, more...}, x.bsdf);
  if (!settings.edges || settings.leaf || is_black(Lr)) return Lr;
  return Lr / float(share_of_disc(settings, x.si, disc.radius, cuts));
}

// Reflected (or transmitted) radiance due to the photons that arrived on the side of n.
Rgb radiance_from_side(const PhotonMap& map, const SeenPoint& x, const Normal3& n,
                       const EstimateSettings& settings, GatherCounters& counters, BiasEstimate* bias) {
  const SurfaceInteraction& si = x.si;
  GatherQuery query{si.p, n, si.surface_group, settings.radius, kAllPhotons};
  if (settings.nearest > 0) query.radius = disc_of_nearest(map, query, settings.nearest, counters);
  if (settings.leaf) query.within = map.find_cell(si.p, settings.node_photons, query.radius).range;
  const Rgb Lr = radiance_of_disc<ReflectedRadiance>(map, x, query, settings, counters);
  if (bias) {
    query.radius /= 2;
    bias->bias +=
        (Lr - radiance_of_disc<ReflectedRadiance>(map, x, query, settings, bias->counters)) * (4 / 3.0f);
  }
  return Lr;
}

}  // namespace

double share_of_disc(const EstimateSettings& settings, const SurfaceInteraction& si, float radius,
                     const WallCut* cut) {
  if (settings.areas && settings.areas->covers(si.surface_group, radius))
    return settings.areas->share(si, settings.kernel, radius, cut);
  if (cut) return std::max(cut->share(si, settings.kernel, *settings.edges), kLeastShare);
  return surface_share(*settings.edges, si, settings.kernel, radius);
}

float disc_of_nearest(const PhotonMap& map, const GatherQuery& query, uint32_t k, GatherCounters& counters) {
  const float radius = nearest_radius(map, query, k, counters);
  return radius < query.radius ? std::nextafter(radius, 0.0f) : radius;
}

Rgb estimate_radiance(const PhotonMap& map, const SurfaceInteraction& si, const Vector3& wo, const Bsdf& bsdf,
                      const EstimateSettings& settings, GatherCounters& counters, BiasEstimate* bias) {
  if (map.empty()) return Rgb(0);
  const Normal3 n = glm::dot(wo, si.n) < 0 ? -si.n : si.n;
  const SeenPoint x{si, wo, bsdf};
  const Rgb Lr = radiance_from_side(map, x, n, settings, counters, bias);
  if (!transmits(bsdf)) return Lr;
  return Lr + radiance_from_side(map, x, -n, settings, counters, bias);
}

Rgb estimate_glossy_tail(const PhotonMap& map, const SurfaceInteraction& si, const Vector3& wo,
                         const Bsdf& bsdf, const EstimateSettings& settings, float most_pdf,
                         GatherCounters& counters) {
  if (map.empty()) return Rgb(0);
  const Normal3 n = glm::dot(wo, si.n) < 0 ? -si.n : si.n;
  GatherQuery query{si.p, n, si.surface_group, settings.radius, kAllPhotons};
  if (settings.nearest > 0) query.radius = disc_of_nearest(map, query, settings.nearest, counters);
  return radiance_of_disc<GlossyTail>(map, {si, wo, bsdf}, query, settings, counters, most_pdf);
}

}  // namespace kaustik::photon
