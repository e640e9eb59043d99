#pragma once
// nanoflann's kd-tree. Flux is summed while the search meets the photons, without a list of indices. Photons
// are first sorted into Morton order by a radix sort, which pays for itself in the build of the tree and
// makes a search faster by a third.

#include <algorithm>
#include <limits>
#include <memory>
#include <nanoflann.hpp>

#include "benchmarks/photon_index.h"
#include "benchmarks/rivals/lsd_radix_sort.h"
#include "benchmarks/rivals/plain_photon.h"

namespace kaustik::benchmarks {

class KdTree {
 public:
  static constexpr std::string_view kName = "nanoflann";

  static KdTree build(photon::PhotonBuffer&& photons, float /*radius*/) {
    KdTree tree;
    if (photons.records.empty()) return tree;
    tree.cloud_ = std::make_unique<Cloud>(Cloud{in_morton_order(photons)});
    tree.index_ =
        std::make_unique<Index>(3, *tree.cloud_, nanoflann::KDTreeSingleIndexAdaptorParams(kLeafPhotons));
    return tree;
  }

  Rgb flux_density(const photon::GatherQuery& query, photon::GatherCounters& counters) const {
    return summed_flux_density(*this, query, counters);
  }

  template <class Fn>
  void for_each(const photon::GatherQuery& query, photon::GatherCounters& counters, Fn&& fn) const {
    ++counters.queries;
    if (!index_) return;
    Result<Fn> result(cloud_->photons.data(), Acceptance(query), counters, fn);
    index_->findNeighbors(result, &query.p.x, {});
  }

  float nearest_radius(const photon::GatherQuery& query, uint32_t k, photon::GatherCounters& counters) const {
    ++counters.queries;
    if (!index_ || k == 0) return query.radius;
    NearestResult result(cloud_->photons.data(), Acceptance(query), counters, k);
    index_->findNeighbors(result, &query.p.x, {});
    return result.nearest.size() < k ? query.radius
                                     : std::min(query.radius, std::sqrt(result.nearest.front()));
  }

  uint64_t memory_bytes() const {
    if (!index_) return 0;
    return cloud_->photons.capacity() * sizeof(PlainPhoton) + index_->usedMemory(*index_);
  }

 private:
  static constexpr size_t kLeafPhotons = 32;  // the fastest of 8, 16, 32, 64 for 50 and 500 in reach

  struct Cloud {
    std::vector<PlainPhoton> photons;
    size_t kdtree_get_point_count() const { return photons.size(); }
    float kdtree_get_pt(size_t i, size_t axis) const { return (&photons[i].p.x)[axis]; }
    template <class Box>
    bool kdtree_get_bbox(Box&) const {
      return false;
    }
  };

  static std::vector<PlainPhoton> in_morton_order(const photon::PhotonBuffer& buffer) {
    const photon::PhotonRecords& records = buffer.records;
    KeyIndices order(records.size()), spare(records.size());
    fill_key_indices(records, photon::MortonCube::around(bounds_of(buffer)), order);
    lsd_radix_sort<11>(order, spare);
    std::vector<PlainPhoton> photons;
    photons.reserve(records.size());
    for (const KeyIndex& at : order) photons.push_back(plain_photon(records[at.index], buffer.flux_unit));
    return photons;
  }

  using Index =
      nanoflann::KDTreeSingleIndexAdaptor<nanoflann::L2_Simple_Adaptor<float, Cloud>, Cloud, 3, uint32_t>;

  // A result set for nanoflann, which prunes by bounds that it rounds at each level on the way down: without
  // some slack a photon on the rim could be lost. Whether a photon counts is decided exactly.
  struct ResultSet {
    using DistanceType = float;
    const PlainPhoton* photons;
    Acceptance counts;
    photon::GatherCounters& counters;
    float worst = std::nextafter(counts.radius_squared() * (1 + 0x1p-12f), kInfinity);

    ResultSet(const PlainPhoton* all, const Acceptance& acceptance, photon::GatherCounters& to)
        : photons(all), counts(acceptance), counters(to) {}
    bool accepts(float distance_squared, uint32_t index) {
      ++counters.candidates;
      if (distance_squared > counts.radius_squared() || !counts.on_surface(photons[index].surface))
        return false;
      ++counters.accepted;
      return true;
    }
    float worstDist() const { return worst; }
    bool full() const { return true; }
    bool empty() const { return false; }
    void sort() {}
  };

  template <class Fn>
  struct Result : ResultSet {
    Fn& fn;

    Result(const PlainPhoton* all, const Acceptance& acceptance, photon::GatherCounters& to, Fn& call)
        : ResultSet(all, acceptance, to), fn(call) {}
    bool addPoint(float distance_squared, uint32_t index) {
      if (this->accepts(distance_squared, index)) fn(this->photons[index].flux);
      return true;
    }
    size_t size() const { return 0; }
  };

  // The k nearest photons in a heap with the farthest in front: nanoflann's own set, a sorted list, is slow
  // for large k.
  struct NearestResult : ResultSet {
    size_t k;
    std::vector<float> nearest{};  // squared distances

    NearestResult(const PlainPhoton* all, const Acceptance& acceptance, photon::GatherCounters& to,
                  size_t count)
        : ResultSet(all, acceptance, to), k(count) {
      nearest.reserve(k + 1);
    }
    bool addPoint(float distance_squared, uint32_t index) {
      if (!accepts(distance_squared, index)) return true;
      nearest.push_back(distance_squared);
      std::push_heap(nearest.begin(), nearest.end());
      if (nearest.size() <= k) return true;
      std::pop_heap(nearest.begin(), nearest.end());
      nearest.pop_back();
      worst = std::nextafter(nearest.front() * (1 + 0x1p-12f), kInfinity);
      return true;
    }
    size_t size() const { return nearest.size(); }
  };

  std::unique_ptr<Cloud> cloud_;  // the index keeps a reference
  std::unique_ptr<Index> index_;
};
static_assert(NearestIndex<KdTree>);

}  // namespace kaustik::benchmarks
