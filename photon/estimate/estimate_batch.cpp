#include "photon/estimate/estimate_batch.h"

#include <optional>

#include "photon/gather/gather.h"

namespace kaustik::photon {

void EstimateBatch::begin_block() {
  latest_.fill(kNone);
  gathers_.clear();
}

bool EstimateBatch::add(const PhotonMap& map, const SurfaceInteraction& si, const Vector3& wo,
                        const Bsdf& bsdf, const EstimateSettings& settings, const Rgb& weight, Rgb* radiance,
                        float* photons) {
  if (map.empty()) return true;
  const std::optional<Rgb> pi_f = constant_pi_f(bsdf);
  if (!pi_f || settings.leaf) return false;
  const Normal3 n = glm::dot(wo, si.n) < 0 ? -si.n : si.n;
  const Point x{si, wo, n};
  uint32_t gather = gather_near(map, settings, x);
  if (gather == kNone) gather = new_gather(map, settings, x);
  waiting_.push_back({gather, weight * *pi_f * kInvPi, radiance, photons});
  return true;
}

uint32_t EstimateBatch::gather_near(const PhotonMap& map, const EstimateSettings& settings,
                                    const Point& x) const {
  constexpr float kSameSide = 0.99f;  // cosine between normals
  uint32_t i = latest_[pixel_];
  for (int looked_at = 0; i != kNone && looked_at < kLookedAt; ++looked_at, i = gathers_[i].previous) {
    const Gather& g = gathers_[i];
    const float shared = kShared * g.query.radius;
    if (g.map == &map && g.query.surface_group == x.si.surface_group &&
        length_squared(g.query.p - x.si.p) <= shared * shared && glm::dot(g.query.n, x.n) > kSameSide) {
      if (!g.cut || !WallCut(*settings.walls, x.si, x.wo, x.n, shared).hides(g.query.p, g.wo)) return i;
    }
  }
  return kNone;
}

uint32_t EstimateBatch::new_gather(const PhotonMap& map, const EstimateSettings& settings, const Point& x) {
  GatherQuery query{x.si.p, x.n, x.si.surface_group, settings.radius, kAllPhotons};
  if (settings.nearest > 0) query.radius = disc_of_nearest(map, query, settings.nearest, counters_);
  std::optional<WallCut> cut;
  if (settings.walls && settings.walls->near(x.si.p))
    cut.emplace(*settings.walls, x.si, x.wo, x.n, query.radius);
  if (cut && !cut->cuts()) cut.reset();
  const uint64_t accepted = counters_.accepted;
  Rgb flux = cut ? gather_flux(map, query, settings.kernel, *cut, counters_)
                 : gather_flux(map, query, settings.kernel, counters_);
  if (settings.edges && !is_black(flux))
    flux /= float(share_of_disc(settings, x.si, query.radius, cut ? &*cut : nullptr));
  gathers_.push_back(
      {&map, query, latest_[pixel_], flux, float(counters_.accepted - accepted), x.wo, bool(cut)});
  return latest_[pixel_] = static_cast<uint32_t>(gathers_.size() - 1);
}

void EstimateBatch::flush(GatherCounters& counters) {
  counters += counters_;
  counters_ = {};
  for (const Waiting& w : waiting_) {
    const Gather& gather = gathers_[w.gather];
    *w.photons += gather.accepted;
    *w.radiance += w.weight * gather.flux;
  }
  waiting_.clear();
}

}  // namespace kaustik::photon
