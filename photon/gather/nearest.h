#pragma once
// How far it is to the k-th nearest photon that counts.

#include <optional>
#include <vector>

#include "photon/gather/gather_query.h"
#include "photon/map/photon_map.h"

namespace kaustik::photon {

// The smallest radius in metres that reaches the k-th nearest photon that counts; query.radius when fewer
// than k are within it. Counts one query. Thread-safe.
float nearest_radius(const PhotonMap& map, const GatherQuery& query, uint32_t k, GatherCounters& counters);

namespace detail {
// The squared distance of the k-th nearest photon that counts; nothing when fewer than k > 0 are within
// query.radius. guess: metres, a radius that may hold k photons but not many more; the result does not depend
// on it. Counts one query.
std::optional<float> nearest_distance_squared(const PhotonMap& map, const GatherQuery& query, uint64_t k,
                                              float guess, GatherCounters& counters);
}  // namespace detail

// The k-th smallest of `size` >= k > 0 values in [0, high], which are reordered. Behind them, kSelectSlack
// more can be written. Fast when they are spread evenly, as squared distances in a disc of even density.
inline constexpr size_t kSelectSlack = 64;
float select_smallest(float* values, size_t size, size_t k, float high);

// Squared distances on their way to the selection. Few need no memory of their own.
class DistanceList {
 public:
  // Room for `more` behind the first `size`, which are kept, and for kSelectSlack.
  float* reserve(size_t size, size_t more) {
    if (size + more + kSelectSlack > capacity_) {
      if (many_.empty()) many_.assign(few_, few_ + size);
      many_.resize(capacity_ = 2 * size + more + kSelectSlack);
    }
    return data();
  }
  float* data() { return many_.empty() ? few_ : many_.data(); }

 private:
  static constexpr size_t kFew = 4096;
  float few_[kFew];
  std::vector<float> many_;
  size_t capacity_ = kFew;
};

}  // namespace kaustik::photon
