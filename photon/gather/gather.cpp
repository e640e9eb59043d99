// Sums over blocks of photons, compiled once per instruction set (Google Highway) and chosen at run time.

#include "photon/gather/gather.h"

#include <algorithm>
#include <cmath>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "photon/gather/gather.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "photon/gather/flux_sum-inl.h"

HWY_BEFORE_NAMESPACE();
namespace kaustik::photon::HWY_NAMESPACE {

using detail::TakePhotons;

// Adds blocks whose photons all have the query's surface. There is no branch to skip vectors without a photon
// inside, since it would be mispredicted at the rim of the disc.
template <class Sum>
HWY_INLINE void AddSame(const PhotonColumns& c, Sphere sphere, const uint32_t* blocks, size_t size, Vf slope,
                        Sum& total) {
  Sum sum = total;  // a local copy stays in registers
  for (size_t b = 0; b < size; ++b) {
    sum.Reach(blocks[b]);
    for (uint32_t j = 0; j < BoxTree::kBlockPhotons; j += uint32_t(hn::Lanes(Floats()))) {
      const uint64_t i = uint64_t(blocks[b]) + j;
      const Vf distance_squared = sum.Stretched(DistanceSquared(sphere, c, i), i);
      sum.Add(c, i, distance_squared, hn::Le(distance_squared, sphere.radius_squared), slope);
    }
  }
  total = sum;
}

// same, others: empty sums of photons in blocks of the two kinds.
template <class Reach, class Sum>
HWY_INLINE GatherSum GatherInto(const PhotonMap& map, const BoxTree::Start& start, const GatherQuery& query,
                                Reach reach, float slope, Sum same, Sum others) {
  const PhotonColumns& c = map.columns();
  const LaneQuery q(query, map.size());
  const Vf slopes = hn::Set(Floats(), slope);
  GatherSum sum;
  VisitBlocks(map.boxes(), start, q, reach, [&](const FoundBlocks& found) HWY_ATTR {
    AddSame(c, q.sphere, found.same, found.same_size, slopes, same);
    AddOthers(c, q, found.other, found.other_size, slopes, others);
    sum.candidates += (found.same_size + found.other_size) * BoxTree::kBlockPhotons;
  });
  same.AddTo(sum);
  others.AddTo(sum);
  return sum;
}

GatherSum GatherPhotons(const PhotonMap& map, const BoxTree::Start& start, const GatherQuery& query,
                        KernelType kernel, float slope) {
  return with_kernel(kernel, [&]<KernelType kType>() HWY_ATTR {
    if (!query.discs)
      return GatherInto(map, start, query, OneRadius(), slope, FluxSum<kType>(), FluxSum<kType>());
    const OwnRadii reach(*query.discs);
    const DiscFluxSum<kType> none(reach);
    return GatherInto(map, start, query, reach, slope, none, none);
  });
}

template <class Reach>
HWY_INLINE void SelectWithin(const PhotonMap& map, const BoxTree::Start& start, const GatherQuery& query,
                             Reach reach, GatherCounters& counters, TakePhotons take, void* to) {
  const Floats d;
  const Words u;
  const PhotonColumns& c = map.columns();
  const LaneQuery q(query, map.size());
  uint32_t index[2 * BoxTree::kBlockPhotons];
  float distances_squared[2 * BoxTree::kBlockPhotons];
  const auto select = [&](uint32_t block) HWY_ATTR {
    size_t count = 0;
    for (uint32_t j = 0; j < BoxTree::kBlockPhotons; j += uint32_t(hn::Lanes(d))) {
      const Vf distance_squared = reach.OfPhotons(DistanceSquared(q.sphere, c, block + j), block + j);
      const Mask counts = Counts(q, c, block + j, distance_squared);
      StoreLanes(d, distance_squared, counts, distances_squared + count);
      count += StoreLanes(u, Numbers(block + j), counts, index + count);
    }
    counters.accepted += count;
    counters.candidates += BoxTree::kBlockPhotons;
    take(to, index, distances_squared, count);
  };
  VisitBlocks(map.boxes(), start, q, reach, [&](const FoundBlocks& found) HWY_ATTR {
    const uint32_t *same = found.same, *other = found.other;
    const uint32_t *const same_end = same + found.same_size, *const other_end = other + found.other_size;
    while (same < same_end || other < other_end) {
      const bool next_same = other == other_end || (same < same_end && *same < *other);
      select(next_same ? *same++ : *other++);
    }
  });
}

void SelectPhotons(const PhotonMap& map, const BoxTree::Start& start, const GatherQuery& query,
                   GatherCounters& counters, TakePhotons take, void* to) {
  if (query.discs)
    SelectWithin(map, start, query, OwnRadii(*query.discs), counters, take, to);
  else
    SelectWithin(map, start, query, OneRadius(), counters, take, to);
}

}  // namespace kaustik::photon::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace kaustik::photon {

HWY_EXPORT(GatherPhotons);
HWY_EXPORT(SelectPhotons);

Rgb gather_flux(const PhotonMap& map, const GatherQuery& query, const KernelSpec& kernel,
                GatherCounters& counters, DiscRadii* radii) {
  const KernelTerms terms = kernel_terms(kernel, query.radius);
  const detail::GatherSum sum =
      HWY_DYNAMIC_DISPATCH(GatherPhotons)(map, detail::start_of(map, query), query, kernel.type, terms.slope);
  counters += {1, sum.candidates, sum.accepted};
  if (radii && !query.discs) *radii = {query.radius, query.radius};
  if (radii && query.discs)
    *radii = {query.radius * float(std::sqrt(double(sum.accepted) / std::max(sum.stretch, 1.0))),
              query.radius / std::sqrt(sum.least_stretch)};
  return Rgb(rgb_of_flux(sum.flux * double(terms.scale) * double(map.flux_unit()), map.colours()));
}

void detail::select_photons(const PhotonMap& map, const GatherQuery& query, GatherCounters& counters,
                            TakePhotons take, void* to) {
  HWY_DYNAMIC_DISPATCH(SelectPhotons)(map, start_of(map, query), query, counters, take, to);
}

}  // namespace kaustik::photon
#endif
