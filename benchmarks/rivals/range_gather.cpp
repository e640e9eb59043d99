#include "benchmarks/rivals/range_gather.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "benchmarks/rivals/range_gather.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "photon/gather/flux_sum-inl.h"

HWY_BEFORE_NAMESPACE();
namespace kaustik::photon::HWY_NAMESPACE {

GatherSum GatherRanges(const PhotonColumns& c, std::span<const PhotonRange> ranges,
                       const GatherQuery& query) {
  const LaneQuery q(query, 0);
  const Floats d;
  const uint64_t lanes = hn::Lanes(d);
  FluxSum<KernelType::kConstant> flux;
  const auto add = [&](uint64_t i, Mask valid) HWY_ATTR {
    const Vf distance_squared = DistanceSquared(q.sphere, c, i);
    const Mask inside = hn::And(valid, hn::Le(distance_squared, q.sphere.radius_squared));
    flux.Reach(i);
    flux.Add(c, i, distance_squared, OnSurface(q, c, i, inside), hn::Zero(d));
  };
  const Mask all = hn::FirstN(d, lanes);
  for (const PhotonRange& range : ranges) {
    uint64_t i = range.begin;
    for (; i + lanes <= range.end; i += lanes) add(i, all);
    if (i < range.end) add(i, hn::FirstN(d, range.end - i));
  }
  GatherSum sum;
  flux.AddTo(sum);
  return sum;
}

}  // namespace kaustik::photon::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace kaustik::photon {
HWY_EXPORT(GatherRanges);
}  // namespace kaustik::photon

namespace kaustik::benchmarks {

photon::detail::GatherSum gather_ranges(const photon::PhotonColumns& columns,
                                        std::span<const photon::PhotonRange> ranges,
                                        const photon::GatherQuery& query) {
  using namespace photon;
  return HWY_DYNAMIC_DISPATCH(GatherRanges)(columns, ranges, query);
}

}  // namespace kaustik::benchmarks
#endif
