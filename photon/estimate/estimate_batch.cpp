#include "photon/estimate/estimate_batch.h"

#include "photon/gather/gather.h"

namespace kaustik::photon {

void EstimateBatch::begin_block() {
  latest_.fill(kNone);
  gathers_.clear();
  completed_ = 0;
}

bool EstimateBatch::add(const PhotonMap& map, const SurfaceInteraction& si, const Vector3& wo,
                        const Bsdf& bsdf, const EstimateSettings& settings, const Rgb& weight, Rgb* radiance,
                        float* photons) {
  if (map.empty()) return true;
  const std::optional<SeparatedF> f = separated(bsdf, si.shading_frame().to_local(wo));
  if (!f || settings.leaf) return false;
  const Normal3 n = glm::dot(wo, si.n) < 0 ? -si.n : si.n;
  const Point x{si, wo, n, f->coat};
  const uint32_t gather = find_or_prepare(map, settings, x);
  if (!gathers_[gather].done) complete(settings, x, gather);
  waiting_.push_back({gather, weight * f->of_wo * kInvPi, radiance, photons});
  return true;
}

uint32_t EstimateBatch::find_or_prepare(const PhotonMap& map, const EstimateSettings& settings,
                                        const Point& x) {
  const uint32_t near = gather_near(map, x);
  return near == kNone ? prepare(map, settings, x) : near;
}

uint32_t EstimateBatch::gather_near(const PhotonMap& map, const Point& x) const {
  constexpr float kSameSide = 0.99f;  // cosine between normals
  uint32_t i = latest_[pixel_];
  for (int looked_at = 0; i != kNone && looked_at < kLookedAt; ++looked_at, i = gathers_[i].previous) {
    const Gather& g = gathers_[i];
    const float shared = kShared * g.radii.mean;
    if (g.map == &map && g.coat == x.coat && g.query.surface_group == x.si.surface_group &&
        length_squared(g.query.p - x.si.p) <= shared * shared && glm::dot(g.query.n, x.n) > kSameSide) {
      if (!g.cut || !g.cut->hides(x.si.p, x.wo)) return i;
    }
  }
  return kNone;
}

uint32_t EstimateBatch::prepare(const PhotonMap& map, const EstimateSettings& settings, const Point& x) {
  const GatherQuery query = query_at(map, x.si, x.n, settings, counters_);
  gathers_.push_back({&map, query, x.coat, latest_[pixel_], x.si, {query.radius, query.radius}, nullptr});
  if (!query.discs) cut_by_walls(settings, x, &gathers_.back());
  return latest_[pixel_] = static_cast<uint32_t>(gathers_.size() - 1);
}

void EstimateBatch::cut_by_walls(const EstimateSettings& settings, const Point& x, Gather* gather) {
  if (!settings.walls || !(gather->radii.widest > 0) || !settings.walls->near(x.si.p)) return;
  gather->cut = std::make_unique<const WallCut>(*settings.walls, x.si, x.wo, x.n, gather->radii.widest);
  if (!gather->cut->cuts()) gather->cut.reset();
}

// How wide the photons' own discs are is known when their flux is summed; only then is it known whether walls
// cut them.
void EstimateBatch::complete(const EstimateSettings& settings, const Point& x, uint32_t number) {
  Gather& gather = gathers_[number];
  uint64_t accepted = counters_.accepted;
  if (gather.query.discs) {
    gather.flux = gather_flux(*gather.map, gather.query, settings.kernel, counters_, &gather.radii);
    cut_by_walls(settings, x, &gather);
  }
  if (!gather.query.discs || gather.cut || x.coat != Coat{}) {
    accepted = counters_.accepted;
    gather.flux = gather_visible(gather, settings.kernel, x);
  }
  if (settings.edges && !is_black(gather.flux))
    gather.flux /= float(share_of_disc(settings, gather.si, gather.radii.mean, gather.cut.get()));
  gather.accepted = float(counters_.accepted - accepted);
  gather.done = true;
  ++completed_;
}

Rgb EstimateBatch::gather_visible(const Gather& gather, const KernelSpec& kernel, const Point& x) {
  if (x.coat != Coat{}) return gather_through_coat(gather, kernel, x);
  if (gather.cut) return gather_flux(*gather.map, gather.query, kernel, *gather.cut, counters_);
  return gather_flux(*gather.map, gather.query, kernel, counters_);
}

Rgb EstimateBatch::gather_through_coat(const Gather& gather, const KernelSpec& kernel, const Point& x) {
  const CoatTransmittance through(x.coat);
  const KernelTerms terms = kernel_terms(kernel, gather.query.radius);
  const Normal3 ns = glm::dot(x.wo, x.si.ns) < 0 ? -x.si.ns : x.si.ns;
  Rgb flux(0);
  for_each_photon(
      *gather.map, gather.query,
      [&](const Photon& photon, float distance_squared) {
        if (gather.cut && gather.cut->hides(photon.p, photon.wi)) return void(--counters_.accepted);
        if (const float z = glm::dot(photon.wi, ns); z > 0)
          flux += through(z) * photon.flux * kernel_value(kernel.type, terms, distance_squared);
      },
      counters_);
  return flux;
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
