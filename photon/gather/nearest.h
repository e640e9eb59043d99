#pragma once
// Distance to the k-th nearest photon that counts.

#include <optional>
#include <vector>

#include "photon/gather/gather_query.h"
#include "photon/map/photon_map.h"

namespace kaustik::photon {

// The smallest radius, in metres, that reaches the k-th nearest photon that counts; query.radius if fewer
// than k are within it. Counts as one query. Thread-safe.
float nearest_radius(const PhotonMap& map, const GatherQuery& query, uint32_t k, GatherCounters& counters);

namespace detail {
// The squared distance of the k-th nearest photon that counts; nothing when fewer than k > 0 are within
// query.radius. guess: metres, a radius that may hold k photons but not many more; the result does not depend
// on it. Counts one query.
std::optional<float> nearest_distance_squared(const PhotonMap& map, const GatherQuery& query, uint64_t k,
                                              float guess, GatherCounters& counters);
}  // namespace detail

// Returns the k-th smallest of `size` >= k > 0 values in [0, high], and reorders them. There must be room for
// kSelectSlack more values behind them. Fast if they are evenly spread, as squared distances in a disc of
// uniform density are.
inline constexpr size_t kSelectSlack = 64;
float select_smallest(float* values, size_t size, size_t k, float high);

// Buffer for squared distances; a few thousand fit without allocating memory.
class DistanceList {
 public:
  // Returns an array with room for `more` values behind the first `size`, which are kept, plus kSelectSlack.
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
