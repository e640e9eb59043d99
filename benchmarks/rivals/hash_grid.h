#pragma once
// A spatial hash (Teschner et al. 2003, "Optimized Spatial Hashing for Collision Detection of Deformable
// Objects") with photons sorted by bucket. Cells are as wide as the radius and a query visits 27 of them: a
// third faster here than the eight cells of twice that width in SmallVCM (Davidovic and Georgiev 2012).

#include <algorithm>
#include <cmath>

#include "benchmarks/photon_index.h"
#include "benchmarks/rivals/plain_photon.h"
#include "core/memory/uninitialised_array.h"

namespace kaustik::benchmarks {

class HashGrid {
 public:
  static constexpr std::string_view kName = "hash grid";

  static HashGrid build(photon::PhotonBuffer&& buffer, float radius) {
    HashGrid grid;
    const size_t count = buffer.records.size();
    grid.bounds_ = bounds_of(buffer);
    grid.cells_per_metre_ = cells_per_metre(grid.bounds_, radius);
    grid.first_.resize(std::max<size_t>(count, 1) + 1);  // as many buckets as photons
    UninitialisedArray<uint32_t> bucket(count);
    for (size_t i = 0; i < count; ++i) {
      const photon::PhotonRecord& r = buffer.records[i];
      bucket[i] = grid.bucket(grid.cell({r.x, r.y, r.z}));
      ++grid.first_[bucket[i] + 1];
    }
    for (size_t b = 1; b < grid.first_.size(); ++b) grid.first_[b] += grid.first_[b - 1];
    std::vector<uint32_t> place = grid.first_;
    grid.photons_.resize(count);
    for (size_t i = 0; i < count; ++i) {
      grid.photons_[place[bucket[i]]++] = plain_photon(buffer.records[i], buffer.flux_unit);
    }
    return grid;
  }

  Rgb flux_density(const photon::GatherQuery& query, photon::GatherCounters& counters) const {
    return summed_flux_density(*this, query, counters);
  }

  template <class Fn>
  void for_each(const photon::GatherQuery& query, photon::GatherCounters& counters, Fn&& fn) const {
    ++counters.queries;
    const Acceptance counts(query);
    const Buckets near = buckets_near(query.p, box_reach(query.radius));
    for (size_t b = 0; b < near.size; ++b) {
      const uint32_t begin = first_[near.bucket[b]], end = first_[near.bucket[b] + 1];
      counters.candidates += end - begin;
      for (uint32_t i = begin; i < end; ++i) {
        if (!counts(photons_[i])) continue;
        ++counters.accepted;
        fn(photons_[i].flux);
      }
    }
  }

  uint64_t memory_bytes() const {
    return photons_.capacity() * sizeof(PlainPhoton) + first_.capacity() * sizeof(uint32_t);
  }

 private:
  // The buckets that a query visits, each once: two cells may share one.
  struct Buckets {
    uint32_t bucket[64];  // four cells along an axis when rounding makes the query wider than two
    size_t size = 0;
    void add(uint32_t b) {
      if (std::find(bucket, bucket + size, b) == bucket + size) bucket[size++] = b;
    }
  };

  // Limits the number of cells so that coordinates do not overflow.
  static float cells_per_metre(const Bounds3& bounds, float radius) {
    const float size = std::max(max_component(bounds.diagonal()), 0x1p-60f);
    return std::min(1 / box_reach(radius), 0x1p20f / size);
  }

  // The cell of p, clamped to the photons' bounds. Monotone, so that an interval of positions is an interval
  // of cells.
  glm::ivec3 cell(const Point3& p) const {
    return glm::ivec3((glm::clamp(p, bounds_.min, bounds_.max) - bounds_.min) * cells_per_metre_);
  }
  uint32_t bucket(const glm::ivec3& c) const {
    const uint32_t hash = uint32_t(c.x) * 73856093u ^ uint32_t(c.y) * 19349663u ^ uint32_t(c.z) * 83492791u;
    return uint32_t(uint64_t(hash) * (first_.size() - 1) >> 32);
  }

  Buckets buckets_near(const Point3& p, float reach) const {
    Buckets near;
    if (photons_.empty()) return near;
    const glm::ivec3 low = cell(p - reach), high = cell(p + reach);
    for (int z = low.z; z <= high.z; ++z) {
      for (int y = low.y; y <= high.y; ++y) {
        for (int x = low.x; x <= high.x; ++x) {
          const uint32_t b = bucket({x, y, z});
          if (first_[b] != first_[b + 1]) near.add(b);
        }
      }
    }
    return near;
  }

  Bounds3 bounds_;
  float cells_per_metre_ = 1;
  std::vector<uint32_t> first_;  // index of the first photon of each bucket
  std::vector<PlainPhoton> photons_;
};
static_assert(PhotonIndex<HashGrid>);

}  // namespace kaustik::benchmarks
