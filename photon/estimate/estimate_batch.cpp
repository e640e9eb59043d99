#include "photon/estimate/estimate_batch.h"

#include <algorithm>
#include <functional>
#include <numeric>

#include "photon/record/packing.h"

namespace kaustik::photon {

void EstimateBatch::begin_block() {
  latest_.fill(kNone);
  readings_.clear();
  complete_ = 0;
}

bool EstimateBatch::add(const PhotonMap& map, const SurfaceInteraction& si, const Vector3& wo,
                        const Bsdf& bsdf, const EstimateSettings& settings, const Rgb& weight, Rgb* radiance,
                        float* photons) {
  if (map.empty()) return true;
  const std::optional<Rgb> pi_f = constant_pi_f(bsdf);
  if (!pi_f || settings.leaf) return false;
  const Normal3 n = glm::dot(wo, si.n) < 0 ? -si.n : si.n;
  uint32_t reading = reading_near(map, si, n);
  if (reading == kNone) reading = new_reading(map, settings, si, n);
  waiting_.push_back({reading, weight * *pi_f * kInvPi, radiance, photons});
  return true;
}

uint32_t EstimateBatch::reading_near(const PhotonMap& map, const SurfaceInteraction& si,
                                     const Normal3& n) const {
  constexpr float kSameSide = 0.99f;  // cosine between normals
  uint32_t i = latest_[pixel_];
  for (int looked_at = 0; i != kNone && looked_at < kLookedAt; ++looked_at, i = readings_[i].previous) {
    const Reading& r = readings_[i];
    const float shared = kShared * r.query.radius;
    if (r.map == &map && r.query.surface_group == si.surface_group &&
        length_squared(r.query.p - si.p) <= shared * shared && glm::dot(r.query.n, n) > kSameSide)
      return i;
  }
  return kNone;
}

// The disc of a nearest search is found at once: it says how far the reading serves.
uint32_t EstimateBatch::new_reading(const PhotonMap& map, const EstimateSettings& settings,
                                    const SurfaceInteraction& si, const Normal3& n) {
  GatherQuery query{si.p, n, si.surface_group, settings.radius, kAllPhotons};
  if (settings.nearest > 0) query.radius = disc_of_nearest(map, query, settings.nearest, nearest_);
  readings_.push_back({&map, &settings, si, query, pack_surface(n, si.surface_group), latest_[pixel_]});
  return latest_[pixel_] = static_cast<uint32_t>(readings_.size() - 1);
}

void EstimateBatch::flush(GatherCounters& counters) {
  read_new(counters);
  counters += nearest_;
  nearest_ = {};
  for (const Waiting& w : waiting_) {
    const Reading& reading = readings_[w.reading];
    *w.photons += reading.accepted;
    *w.radiance += w.weight * reading.flux;
  }
  waiting_.clear();
}

// By map and surface; of one surface in the order in which they came, neighbour after neighbour.
void EstimateBatch::read_new(GatherCounters& counters) {
  order_.resize(readings_.size() - complete_);
  std::iota(order_.begin(), order_.end(), static_cast<uint32_t>(complete_));
  complete_ = readings_.size();
  std::ranges::stable_sort(order_, [&](uint32_t i, uint32_t j) {
    const Reading &a = readings_[i], &b = readings_[j];
    if (a.map != b.map) return std::less<>()(a.map, b.map);
    return a.surface < b.surface;
  });
  for (auto first = order_.begin(); first != order_.end();) {
    const PhotonMap* const map = readings_[*first].map;
    const auto end = std::find_if(first, order_.end(), [&](uint32_t i) { return readings_[i].map != map; });
    read({first, end}, counters);
    first = end;
  }
}

void EstimateBatch::read(std::span<const uint32_t> of_one_map, GatherCounters& counters) {
  const PhotonMap& map = *readings_[of_one_map.front()].map;
  const EstimateSettings& settings = *readings_[of_one_map.front()].settings;
  queries_.clear();
  for (const uint32_t i : of_one_map) queries_.push_back(readings_[i].query);
  results_.resize(queries_.size());
  map.gather_flux(queries_, settings.kernel, results_.data());
  for (size_t k = 0; k < of_one_map.size(); ++k) {
    Reading& reading = readings_[of_one_map[k]];
    counters += results_[k].counters;
    reading.accepted = float(results_[k].counters.accepted);
    reading.flux = results_[k].flux;
    if (!settings.edges || is_black(reading.flux)) continue;
    reading.flux /= float(share_of_disc(settings, reading.si, reading.query.radius));
  }
}

}  // namespace kaustik::photon
