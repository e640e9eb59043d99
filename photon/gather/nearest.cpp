// Finds the distances in a disc that should hold somewhat more than k photons, and selects the k-th smallest
// of them.

#include "photon/gather/nearest.h"

#include <algorithm>
#include <cmath>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "photon/gather/nearest.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "photon/gather/block_lanes-inl.h"
#include "photon/gather/gather.h"

HWY_BEFORE_NAMESPACE();
namespace kaustik::photon::HWY_NAMESPACE {

// Appends the squared distances of the block's photons that count to `to`; returns their number.
template <bool kSame>
HWY_INLINE size_t AppendDistances(const PhotonColumns& c, const LaneQuery& q, Sphere sphere, uint64_t block,
                                  float* to) {
  const Floats d;
  size_t count = 0;
  for (uint32_t j = 0; j < BoxTree::kBlockPhotons; j += uint32_t(hn::Lanes(d))) {
    const Vf distance_squared = DistanceSquared(sphere, c, block + j);
    const Mask counts =
        kSame ? hn::Le(distance_squared, sphere.radius_squared) : Counts(q, c, block + j, distance_squared);
    count += StoreLanes(d, distance_squared, counts, to + count);
  }
  return count;
}

// Collects the squared distances of the photons that count within query.radius. Returns their number; adds to
// candidates.
size_t FindDistances(const PhotonMap& map, const BoxTree::Start& start, const GatherQuery& query,
                     DistanceList& distances, uint64_t& candidates) {
  const PhotonColumns c = map.columns();
  const LaneQuery q(query, map.size());
  size_t size = 0;
  VisitBlocks(map.boxes(), start, q, OneRadius(), [&](const FoundBlocks& found) HWY_ATTR {
    const size_t most = (found.same_size + found.other_size) * BoxTree::kBlockPhotons;
    float* const to = distances.reserve(size, most);
    size_t end = size;
    for (size_t b = 0; b < found.same_size; ++b)
      end += AppendDistances<true>(c, q, q.sphere, found.same[b], to + end);
    for (size_t b = 0; b < found.other_size; ++b)
      end += AppendDistances<false>(c, q, q.sphere, found.other[b], to + end);
    size = end;
    candidates += most;
  });
  return size;
}

// Up to this many values, the k-th smallest is found by computing all ranks.
inline constexpr size_t kFew = 32;
static_assert(kFew + BoxTree::kBlockPhotons <= kSelectSlack);

HWY_INLINE float SelectOfFew(float* values, size_t size, size_t k) {
  const Floats d;
  const Words u;
  const Vf none = hn::Inf(d);
  hn::StoreU(none, d, values + size);
  Vf least = none;
  for (size_t i = 0; i < size; i += hn::Lanes(d)) {
    const Vf v = hn::LoadU(d, values + i);
    Vu rank = hn::Zero(u);  // number of values that are not larger; a true lane is -1
    for (size_t j = 0; j < size; ++j)
      rank = hn::Sub(rank, hn::BitCast(u, hn::VecFromMask(d, hn::Le(hn::Set(d, values[j]), v))));
    const auto enough = hn::RebindMask(d, hn::Gt(rank, hn::Set(u, uint32_t(k) - 1)));
    least = hn::Min(least, hn::IfThenElse(enough, v, none));
  }
  return hn::GetLane(hn::MinOfLanes(d, least));
}

// An interval of values, and the number of values that are at most `low` and at most `high`.
struct Interval {
  float low, high;
  size_t below, up_to;
  size_t size() const { return up_to - below; }
};

// Cuts the interval at four values and returns the part that contains the k-th smallest of the values.
HWY_INLINE Interval Narrow(const float* values, size_t size, size_t k, const Interval& from) {
  // Cuts around the expected position of the k-th value.
  const float rank = float(k - from.below), among = float(from.size());
  const float margin = 1 + 0.5f * std::sqrt(std::min(rank, among - rank));
  const float unit = (from.high - from.low) / among;
  const auto at = [&](float r) { return std::clamp(from.low + unit * r, from.low, from.high); };
  const float cuts[] = {from.low,          at(rank - 3 * margin), at(rank - margin),
                        at(rank + margin), at(rank + 3 * margin), from.high};
  const Floats d;
  const Vf cut1 = hn::Set(d, cuts[1]), cut2 = hn::Set(d, cuts[2]);
  const Vf cut3 = hn::Set(d, cuts[3]), cut4 = hn::Set(d, cuts[4]);
  size_t up_to[] = {from.below, 0, 0, 0, 0, from.up_to};
  for (size_t i = 0; i < size; i += hn::Lanes(d)) {
    const Vf v = hn::LoadU(d, values + i);
    up_to[1] += hn::CountTrue(d, hn::Le(v, cut1));
    up_to[2] += hn::CountTrue(d, hn::Le(v, cut2));
    up_to[3] += hn::CountTrue(d, hn::Le(v, cut3));
    up_to[4] += hn::CountTrue(d, hn::Le(v, cut4));
  }
  // Branchless, since branches would be mispredicted.
  size_t part = 0;
  for (size_t i = 1; i <= 4; ++i) part += up_to[i] < k;
  return {cuts[part], cuts[part + 1], up_to[part], up_to[part + 1]};
}

// Moves the values in the interval to the front; returns their number.
HWY_INLINE size_t KeepBetween(float* values, size_t size, const Interval& interval) {
  const Floats d;
  const Vf low = hn::Set(d, interval.low), high = hn::Set(d, interval.high);
  size_t kept = 0;
  for (size_t i = 0; i < size; i += hn::Lanes(d)) {
    const Vf v = hn::LoadU(d, values + i);
    kept += StoreLanes(d, v, hn::And(hn::Gt(v, low), hn::Le(v, high)), values + kept);
  }
  return kept;
}

float SelectSmallest(float* values, size_t size, size_t k, float high) {
  constexpr float kBelowAll = -1;
  if (size <= kFew) return SelectOfFew(values, size, k);
  // NaN behind the values keeps the surplus lanes from being counted.
  hn::StoreU(hn::NaN(Floats()), Floats(), values + size);
  constexpr int kSteps = 12;  // a limit, since equal values cannot be separated
  Interval interval{0, high, 0, size};
  for (int step = 0; step < kSteps && interval.size() > kFew; ++step)
    interval = Narrow(values, size, k, interval);
  if (interval.below == 0) interval.low = kBelowAll;  // so that values of zero are inside the interval
  const size_t kept = KeepBetween(values, size, interval);
  k -= interval.below;
  if (kept <= kFew) return SelectOfFew(values, kept, k);
  std::nth_element(values, values + (k - 1), values + kept);
  return values[k - 1];
}

}  // namespace kaustik::photon::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace kaustik::photon {

HWY_EXPORT(FindDistances);
HWY_EXPORT(SelectSmallest);

float select_smallest(float* values, size_t size, size_t k, float high) {
  return HWY_DYNAMIC_DISPATCH(SelectSmallest)(values, size, k, high);
}

std::optional<float> detail::nearest_distance_squared(const PhotonMap& map, const GatherQuery& query,
                                                      uint64_t k, float guess, GatherCounters& counters) {
  ++counters.queries;
  DistanceList distances;
  GatherQuery disc = query;
  for (disc.radius = std::min(query.radius, guess);; disc.radius = std::min(query.radius, disc.radius)) {
    const size_t found =
        HWY_DYNAMIC_DISPATCH(FindDistances)(map, start_of(map, disc), disc, distances, counters.candidates);
    counters.accepted += found;
    if (found >= k) return select_smallest(distances.data(), found, k, disc.radius_squared());
    if (!(disc.radius < query.radius)) return {};
    // Assume the same density farther out, within limits.
    const float grow = std::sqrt(1.3f * float(k) / float(std::max<size_t>(1, found)));
    disc.radius = std::max(disc.radius, query.radius * 0x1p-20f) * std::clamp(grow, 1.25f, 4.0f);
  }
}

float nearest_radius(const PhotonMap& map, const GatherQuery& query, uint32_t k, GatherCounters& counters) {
  if (k == 0 || map.size() < k) return query.radius;
  const float guess = map.octree().guess_radius(query.p, k);
  const auto nearest = detail::nearest_distance_squared(map, query, k, guess, counters);
  if (!nearest) return query.radius;
  float radius = std::sqrt(*nearest);
  // The root is rounded; make sure that its square still reaches the photon.
  if (radius * radius < *nearest) radius = std::nextafter(radius, kInfinity);
  return std::min(radius, query.radius);
}

}  // namespace kaustik::photon
#endif
