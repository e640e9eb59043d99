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

// What a gather asks for, and the radii of the discs that it finds.
struct Disc {
  GatherQuery query;
  DiscRadii radii;
};

// Where photons have their own discs, walls and the surface's border ask for their radii before the sum.
Disc disc_of(const PhotonMap& map, const GatherQuery& query, const EstimateSettings& settings,
             GatherCounters& counters) {
  Disc disc{query, {query.radius, query.radius}};
  if (query.discs) gather_flux(map, query, settings.kernel, counters, &disc.radii);
  return disc;
}

// Sum is ReflectedRadiance or GlossyTail, more its last members.
template <class Sum, class... More>
Rgb radiance_of_disc(const PhotonMap& map, const SeenPoint& x, const Disc& disc,
                     const EstimateSettings& settings, GatherCounters& counters, const More&... more) {
  if (disc.query.discs && !(disc.radii.widest > 0)) return Rgb(0);
  const Frame frame = x.si.shading_frame();
  const Vector3 wo = frame.to_local(x.wo);
  std::optional<WallCut> cut;
  if (settings.walls && settings.walls->near(x.si.p))
    cut.emplace(*settings.walls, x.si, x.wo, disc.query.n, disc.radii.widest);
  const WallCut* const cuts = cut && cut->cuts() ? &*cut : nullptr;
  const Rgb Lr =
      std::visit(Sum{{map, disc.query, settings.kernel, frame, wo, cuts, counters}, more...}, x.bsdf);
  if (!settings.edges || settings.leaf || is_black(Lr)) return Lr;
  return Lr / float(share_of_disc(settings, x.si, disc.radii.mean, cuts));
}

// Reflected (or transmitted) radiance due to the photons that arrived on the side of n.
Rgb radiance_from_side(const PhotonMap& map, const SeenPoint& x, const Normal3& n,
                       const EstimateSettings& settings, GatherCounters& counters, BiasEstimate* bias) {
  GatherQuery query = query_at(map, x.si, n, settings, counters);
  if (settings.leaf) query.within = map.find_cell(x.si.p, settings.node_photons, query.radius).range;
  Disc disc = disc_of(map, query, settings, counters);
  const Rgb Lr = radiance_of_disc<ReflectedRadiance>(map, x, disc, settings, counters);
  if (bias) {
    disc.query.radius /= 2;
    disc.radii = {disc.radii.mean / 2, disc.radii.widest / 2};
    bias->bias +=
        (Lr - radiance_of_disc<ReflectedRadiance>(map, x, disc, settings, bias->counters)) * (4 / 3.0f);
  }
  return Lr;
}

// Radius of the disc whose photons count in a K-nearest estimate, at most query.radius.
float disc_of_nearest(const PhotonMap& map, const GatherQuery& query, uint32_t k, GatherCounters& counters) {
  const float radius = nearest_radius(map, query, k, counters);
  return radius < query.radius ? std::nextafter(radius, 0.0f) : radius;
}

}  // namespace

double share_of_disc(const EstimateSettings& settings, const SurfaceInteraction& si, float radius,
                     const WallCut* cut) {
  if (settings.areas && settings.areas->covers(si.surface_group, radius))
    return settings.areas->share(si, settings.kernel, radius, cut);
  if (cut) return std::max(cut->share(si, settings.kernel, *settings.edges, radius), kLeastShare);
  return surface_share(*settings.edges, si, settings.kernel, radius);
}

GatherQuery query_at(const PhotonMap& map, const SurfaceInteraction& si, const Normal3& n,
                     const EstimateSettings& settings, GatherCounters& counters) {
  GatherQuery query{si.p, n, si.surface_group, settings.radius, kAllPhotons, settings.discs};
  if (settings.clear) query.radius = settings.clear->at(si, n);
  if (!query.discs && settings.nearest > 0)
    query.radius = disc_of_nearest(map, query, settings.nearest, counters);
  return query;
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
  const Disc disc = disc_of(map, query_at(map, si, n, settings, counters), settings, counters);
  return radiance_of_disc<GlossyTail>(map, {si, wo, bsdf}, disc, settings, counters, most_pdf);
}

}  // namespace kaustik::photon
