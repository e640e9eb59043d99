#include "photon/estimate_batch.h"

#include <algorithm>
#include <functional>

#include "photon/boundary_correction.h"
#include "photon/packing.h"

namespace kaustik::photon {

bool EstimateBatch::add(const PhotonMap& map, const SurfaceInteraction& si, const Vector3& wo,
                        const Bsdf& bsdf, const EstimateSettings& settings, const Rgb& weight, Rgb* radiance,
                        float* photons) {
  if (map.empty()) return true;
  const auto* const lambertian = std::get_if<Lambertian>(&bsdf);
  if (!lambertian || settings.nearest > 0 || settings.leaf) return false;
  const Normal3 n = glm::dot(wo, si.n) < 0 ? -si.n : si.n;
  waiting_.push_back({&map, &settings, si, n, pack_surface(n, si.surface_group),
                      weight * lambertian->reflectance * kInvPi, radiance, photons});
  return true;
}

void EstimateBatch::flush(GatherCounters& counters) {
  // By map and surface; of one surface in the order in which they came, neighbour after neighbour.
  std::ranges::stable_sort(waiting_, [](const Waiting& a, const Waiting& b) {
    if (a.map != b.map) return std::less<>()(a.map, b.map);
    return a.surface < b.surface;
  });
  for (const Waiting *first = waiting_.data(), *const end = first + waiting_.size(); first != end;) {
    const Waiting* const next =
        std::find_if(first, end, [&](const Waiting& w) { return w.map != first->map; });
    gather(first, next, counters);
    first = next;
  }
  waiting_.clear();
}

// Of one map.
void EstimateBatch::gather(const Waiting* first, const Waiting* end, GatherCounters& counters) {
  const EstimateSettings& settings = *first->settings;
  queries_.clear();
  for (const Waiting* w = first; w != end; ++w)
    queries_.push_back({w->si.p, w->n, w->si.surface_group, settings.radius, kAllPhotons});
  results_.resize(queries_.size());
  first->map->gather_flux(queries_, settings.kernel, results_.data());
  for (const PhotonMap::Gathered* result = results_.data(); first != end; ++first, ++result) {
    counters += result->counters;
    *first->photons += float(result->counters.accepted);
    if (is_black(result->flux)) continue;
    const float share =
        settings.edges ? float(surface_share(*settings.edges, first->si, settings.kernel, settings.radius))
                       : 1;
    *first->radiance += first->weight * result->flux / share;
  }
}

}  // namespace kaustik::photon
