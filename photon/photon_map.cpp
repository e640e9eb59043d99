// Building the columns of a map, and its searches.

#include "photon/photon_map.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_reduce.h>

#include <algorithm>
#include <stdexcept>

#include "photon/packing.h"
#include "photon/radix_sort.h"

namespace kaustik::photon {

namespace {

using IndexBlock = tbb::blocked_range<size_t>;
constexpr size_t kGrain = 1 << 14;

template <class Fn>
void for_each_index(size_t size, const Fn& fn) {
  tbb::parallel_for(IndexBlock(0, size, kGrain), [&](const IndexBlock& block) {
    for (size_t i = block.begin(); i < block.end(); ++i) fn(i);
  });
}

// Minima and maxima do not depend on the order in which they are joined.
Bounds3 bounds_of(std::span<const PhotonRecord> records) {
  return tbb::parallel_reduce(
      IndexBlock(0, records.size(), kGrain), Bounds3{},
      [&](const IndexBlock& block, Bounds3 bounds) {
        for (size_t i = block.begin(); i < block.end(); ++i) {
          bounds.add(Point3(records[i].x, records[i].y, records[i].z));
        }
        return bounds;
      },
      [](Bounds3 a, const Bounds3& b) {
        a.add(b);
        return a;
      });
}

// order[i] is the photon at place i of the Morton order. The keys are freed on return.
Octree sort_photons(std::span<const PhotonRecord> records, const MortonCube& cube,
                    UninitialisedArray<uint32_t>& order) {
  if (records.size() >= std::numeric_limits<uint32_t>::max()) {
    throw std::length_error("a photon map holds fewer than 2^32 - 1 photons: shoot fewer per pass");
  }
  UninitialisedArray<uint64_t> keys(records.size());
  order = UninitialisedArray<uint32_t>(records.size());
  for_each_index(records.size(), [&](size_t i) {
    keys[i] = morton_key(cube.cell(Point3(records[i].x, records[i].y, records[i].z)));
    order[i] = uint32_t(i);
  });
  radix_sort(keys, order);
  return Octree(cube, {keys.data(), keys.size()});
}

// Ranges on their way from the octree to the SIMD loop.
struct RangeBatch {
  static constexpr size_t kCapacity = 64;
  PhotonRange ranges[kCapacity];
  size_t size = 0;
};

// The k smallest of many squared distances. Keeps up to half as many more before it selects, so that each
// costs a constant time on average.
class NearestSet {
 public:
  NearestSet(uint32_t k, float reach_squared) : k_(k), select_at_(k), reach_squared_(reach_squared) {}

  // No larger distance is needed any more.
  float reach_squared() const { return reach_squared_; }
  void add(std::span<const float> distances_squared) {
    distances_.insert(distances_.end(), distances_squared.begin(), distances_squared.end());
    if (distances_.size() >= select_at_) finish();
  }
  // Leaves the k-th distance in reach_squared; false when there are fewer.
  bool finish() {
    if (distances_.size() < k_) return false;
    std::nth_element(distances_.begin(), distances_.begin() + ptrdiff_t(k_ - 1), distances_.end());
    reach_squared_ = std::min(reach_squared_, distances_[k_ - 1]);
    distances_.resize(k_);
    select_at_ = k_ + size_t(k_) / 2 + 16;
    return true;
  }

 private:
  size_t k_, select_at_;
  float reach_squared_;
  std::vector<float> distances_;
};

}  // namespace

PhotonMap::Writer PhotonMap::allocate(uint64_t size, bool f32_power) {
  const uint64_t stride = (size + kGatherPadding) * sizeof(uint32_t), columns = f32_power ? 8 : 6;
  size_ = size;
  // Bytes, in which the columns' floats and words may begin their lives.
  storage_ = UninitialisedArray<std::byte>(stride * columns);
  for (uint64_t c = 0; c < columns; ++c) {
    std::fill_n(storage_.data() + (c + 1) * stride - kGatherPadding * sizeof(uint32_t),
                kGatherPadding * sizeof(uint32_t), std::byte(0));
  }
  const auto words = [&](uint64_t c) { return reinterpret_cast<uint32_t*>(storage_.data() + c * stride); };
  const auto floats = [&](uint64_t c) { return reinterpret_cast<float*>(storage_.data() + c * stride); };
  Writer to{floats(0), floats(1), floats(2), words(3), words(4), nullptr, {}};
  if (f32_power) {
    for (uint64_t c = 0; c < 3; ++c) to.power_f32[c] = floats(5 + c);
  } else {
    to.power = words(5);
  }
  columns_ = {to.x, to.y, to.z, to.direction, to.surface, to.power, {}};
  std::copy_n(to.power_f32, 3, columns_.power_f32);
  return to;
}

void PhotonMap::Writer::write(uint64_t i, const PhotonRecord& record) const {
  x[i] = record.x;
  y[i] = record.y;
  z[i] = record.z;
  direction[i] = record.direction;
  surface[i] = record.surface;
}

PhotonMap PhotonMap::build(PhotonBuffer&& buffer, const MapSettings& settings) {
  const PhotonBuffer from = std::move(buffer);
  buffer = {};
  const std::vector<PhotonRecord>& records = from.records;
  PhotonMap map;
  map.flux_unit_ = from.flux_unit;
  UninitialisedArray<uint32_t> order;
  map.octree_ =
      sort_photons(records, MortonCube::around(settings.bounds.value_or(bounds_of(records))), order);
  const Writer to = map.allocate(records.size(), false);
  for_each_index(records.size(), [&](size_t i) {
    const PhotonRecord& record = records[order[i]];
    to.write(i, record);
    to.power[i] = record.power;
  });
  return map;
}

PhotonMap PhotonMap::build_f32(std::span<const Photon> photons, float flux_unit,
                               const MapSettings& settings) {
  std::vector<PhotonRecord> records(photons.size());
  for_each_index(photons.size(), [&](size_t i) { records[i] = pack(photons[i], flux_unit); });
  PhotonMap map;
  map.flux_unit_ = flux_unit;
  UninitialisedArray<uint32_t> order;
  map.octree_ =
      sort_photons(records, MortonCube::around(settings.bounds.value_or(bounds_of(records))), order);
  const Writer to = map.allocate(records.size(), true);
  for_each_index(records.size(), [&](size_t i) {
    to.write(i, records[order[i]]);
    for (int c = 0; c < 3; ++c) to.power_f32[c][i] = photons[order[i]].flux[c] / flux_unit;
  });
  return map;
}

uint64_t PhotonMap::memory_bytes() const {
  return storage_.size() + octree_.memory_bytes();
}

Photon PhotonMap::photon(uint64_t i) const {
  const PhotonColumns& c = columns_;
  const uint32_t power = c.power ? c.power[i] : 0;
  Photon photon = unpack({c.x[i], c.y[i], c.z[i], c.direction[i], power, c.surface[i]}, flux_unit_);
  if (!c.power) photon.flux = Rgb(c.power_f32[0][i], c.power_f32[1][i], c.power_f32[2][i]) * flux_unit_;
  return photon;
}

Rgb PhotonMap::gather_flux(const GatherQuery& query, const KernelSpec& kernel,
                           GatherCounters& counters) const {
  ++counters.queries;
  const KernelTerms terms = kernel_terms(kernel, query.radius);
  RangeBatch batch;
  GatherSum sum;
  const auto flush = [&] {
    const GatherSum part =
        gather_ranges(columns_, {batch.ranges, batch.size}, query, kernel.type, terms.slope);
    sum.flux += part.flux;
    sum.accepted += part.accepted;
    batch.size = 0;
  };
  octree_.visit_ranges(query.p, query.radius, query.within, [&](PhotonRange range) {
    counters.candidates += range.size();
    batch.ranges[batch.size++] = range;
    if (batch.size == RangeBatch::kCapacity) flush();
  });
  if (batch.size > 0) flush();
  counters.accepted += sum.accepted;
  return Rgb(sum.flux * double(terms.scale) * double(flux_unit_));
}

float PhotonMap::nearest_radius(const GatherQuery& query, uint32_t k, GatherCounters& counters) const {
  ++counters.queries;
  if (k == 0 || size_ < k) return query.radius;
  NearestSet nearest(k, query.radius * query.radius);
  uint32_t index[kSelectBlock + kGatherPadding];
  float distance_squared[kSelectBlock + kGatherPadding];
  octree_.visit_near_first(query.p, query.radius, query.within, [&](PhotonRange range) {
    counters.candidates += range.size();
    while (!range.empty()) {
      const PhotonRange block{range.begin, std::min(range.end, range.begin + kSelectBlock)};
      const size_t count =
          select_range(columns_, block, query, nearest.reach_squared(), index, distance_squared);
      counters.accepted += count;
      nearest.add({distance_squared, count});
      range.begin = block.end;
    }
    return std::min(query.radius, std::sqrt(nearest.reach_squared()));
  });
  if (!nearest.finish()) return query.radius;
  float radius = std::sqrt(nearest.reach_squared());
  // The root is rounded; its square must still reach the photon.
  if (radius * radius < nearest.reach_squared()) radius = std::nextafter(radius, kInfinity);
  return std::min(radius, query.radius);
}

}  // namespace kaustik::photon
