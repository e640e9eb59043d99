// Gather of the photons within a fixed radius: the photon map, nanoflann's radius search, and as the roof a
// dense grid whose cells are made for this very radius. One thread, equal radius, coherent queries, the same
// sum of flux. Arguments: photons in the map, photons in reach. Compare within one run, e.g.
//   gather_bench --benchmark_enable_random_interleaving=true --benchmark_repetitions=5

#include <benchmark/benchmark.h>

#include <map>
#include <nanoflann.hpp>

#include "benchmarks/wall_photons.h"
#include "photon/photon_map.h"

namespace kaustik::benchmarks {
namespace {

using photon::PhotonBuffer;
using photon::PhotonMap;

// The input of one size, shared by the benchmarks of that size.
const PhotonMap& shared_map(size_t count) {
  static std::map<size_t, PhotonMap> maps;
  auto [at, fresh] = maps.try_emplace(count);
  if (fresh) at->second = PhotonMap::build(wall_photons(count));
  return at->second;
}

const std::vector<photon::Photon>& shared_queries() {
  static const std::vector<photon::Photon> points = tile_points(12);
  return points;
}

photon::GatherQuery query_at(const photon::Photon& point, float radius) {
  return {point.p, point.n, point.surface_group, radius, photon::kAllPhotons};
}

void report(benchmark::State& state, uint64_t queries, uint64_t accepted, uint64_t candidates) {
  state.SetItemsProcessed(int64_t(queries));
  state.counters["accepted"] = double(accepted) / double(queries);
  if (candidates) state.counters["candidates"] = double(candidates) / double(queries);
}

void BM_PhotonMap(benchmark::State& state) {
  const size_t count = size_t(state.range(0));
  const PhotonMap& map = shared_map(count);
  const float radius = radius_for(double(state.range(1)), count);
  photon::GatherCounters counters;
  for (auto _ : state) {
    for (const photon::Photon& point : shared_queries()) {
      benchmark::DoNotOptimize(map.gather_flux(query_at(point, radius), {}, counters));
    }
  }
  report(state, counters.queries, counters.accepted, counters.candidates);
}

void BM_PhotonMapNearest(benchmark::State& state) {
  const size_t count = size_t(state.range(0));
  const PhotonMap& map = shared_map(count);
  const float radius = 4 * radius_for(double(state.range(1)), count);
  photon::GatherCounters counters;
  for (auto _ : state) {
    for (const photon::Photon& point : shared_queries()) {
      benchmark::DoNotOptimize(
          map.nearest_radius(query_at(point, radius), uint32_t(state.range(1)), counters));
    }
  }
  report(state, counters.queries, counters.accepted, counters.candidates);
}

// The records in the order that the kd-tree is given: Morton order, which is kind to its caches.
struct PointCloud {
  std::vector<photon::PhotonRecord> records;
  size_t kdtree_get_point_count() const { return records.size(); }
  float kdtree_get_pt(size_t i, size_t axis) const { return (&records[i].x)[axis]; }
  template <class Box>
  bool kdtree_get_bbox(Box&) const {
    return false;
  }
};

struct KdTree {
  using Index = nanoflann::KDTreeSingleIndexAdaptor<nanoflann::L2_Simple_Adaptor<float, PointCloud>,
                                                    PointCloud, 3, uint32_t>;
  PointCloud cloud;
  std::unique_ptr<Index> index;
};

const KdTree& shared_tree(size_t count) {
  static std::map<size_t, KdTree> trees;
  auto [at, fresh] = trees.try_emplace(count);
  KdTree& tree = at->second;
  if (fresh) {
    const photon::PhotonColumns& c = shared_map(count).columns();
    for (size_t i = 0; i < count; ++i) {
      tree.cloud.records.push_back({c.x[i], c.y[i], c.z[i], c.direction[i], c.power[i], c.surface[i]});
    }
    tree.index =
        std::make_unique<KdTree::Index>(3, tree.cloud, nanoflann::KDTreeSingleIndexAdaptorParams(16));
    tree.index->buildIndex();
  }
  return tree;
}

void BM_Nanoflann(benchmark::State& state) {
  const size_t count = size_t(state.range(0));
  const KdTree& tree = shared_tree(count);
  const float radius = radius_for(double(state.range(1)), count);
  std::vector<std::pair<uint32_t, float>> found;
  nanoflann::SearchParams parameters;
  parameters.sorted = false;
  uint64_t queries = 0, accepted = 0;
  for (auto _ : state) {
    for (const photon::Photon& point : shared_queries()) {
      // The search alone: its caller would still have to sum the flux.
      accepted += tree.index->radiusSearch(&point.p.x, radius * radius, found, parameters);
      benchmark::DoNotOptimize(found.data());
      ++queries;
    }
  }
  report(state, queries, accepted, 0);
}

// Photons sorted into a dense grid of cells as wide as the radius, cell by cell: a query reads three rows of
// three cells in three layers and nothing else. Rows along x are contiguous.
class DenseGrid {
 public:
  DenseGrid(const PhotonMap& map, float radius) : cell_(radius), size_(glm::ivec3(kRoom / radius) + 3) {
    std::vector<uint32_t> cell_of(map.size());
    first_.assign(size_t(size_.x) * size_t(size_.y) * size_t(size_.z) + 1, 0);
    for (size_t i = 0; i < map.size(); ++i) {
      cell_of[i] = uint32_t(index(coordinates(map.positions()[i])));
      ++first_[cell_of[i] + 1];
    }
    for (size_t i = 1; i < first_.size(); ++i) first_[i] += first_[i - 1];
    std::vector<uint32_t> place(first_.begin(), first_.end() - 1);
    const size_t padded = map.size() + photon::kGatherPadding;
    x_.resize(padded), y_.resize(padded), z_.resize(padded), surface_.resize(padded), power_.resize(padded);
    for (size_t i = 0; i < map.size(); ++i) {
      const size_t at = place[cell_of[i]]++;
      const photon::PhotonColumns& c = map.columns();
      x_[at] = c.x[i], y_[at] = c.y[i], z_[at] = c.z[i], surface_[at] = c.surface[i], power_[at] = c.power[i];
    }
    columns_ = {x_.data(), y_.data(), z_.data(), nullptr, surface_.data(), power_.data(), {}};
  }

  Rgb gather(const photon::GatherQuery& query, uint64_t& candidates, uint64_t& accepted) const {
    const glm::ivec3 c = coordinates(query.p);
    photon::PhotonRange rows[9];
    size_t count = 0;
    for (int z = c.z - 1; z <= c.z + 1; ++z) {
      for (int y = c.y - 1; y <= c.y + 1; ++y) {
        const size_t row = index({c.x - 1, y, z});
        if (first_[row] == first_[row + 3]) continue;
        rows[count++] = {first_[row], first_[row + 3]};
        candidates += first_[row + 3] - first_[row];
      }
    }
    const photon::GatherSum sum =
        gather_ranges(columns_, {rows, count}, query, photon::KernelType::kConstant, 0);
    accepted += sum.accepted;
    return Rgb(sum.flux);
  }

 private:
  glm::ivec3 coordinates(const Point3& p) const { return glm::ivec3(p / cell_) + 1; }
  size_t index(const glm::ivec3& c) const {
    return size_t(c.x) + size_t(size_.x) * (size_t(c.y) + size_t(size_.y) * size_t(c.z));
  }

  float cell_;
  glm::ivec3 size_;
  std::vector<uint32_t> first_;
  std::vector<float> x_, y_, z_;
  std::vector<uint32_t> surface_, power_;
  photon::PhotonColumns columns_;
};

void BM_DenseGridRoof(benchmark::State& state) {
  const size_t count = size_t(state.range(0));
  const float radius = radius_for(double(state.range(1)), count);
  static std::map<std::pair<size_t, int64_t>, std::unique_ptr<DenseGrid>> grids;
  auto& grid = grids[{count, state.range(1)}];
  if (!grid) grid = std::make_unique<DenseGrid>(shared_map(count), radius);
  uint64_t queries = 0, candidates = 0, accepted = 0;
  for (auto _ : state) {
    for (const photon::Photon& point : shared_queries()) {
      benchmark::DoNotOptimize(grid->gather(query_at(point, radius), candidates, accepted));
      ++queries;
    }
  }
  report(state, queries, accepted, candidates);
}

void sizes(benchmark::internal::Benchmark* bench) {
  bench->ArgNames({"photons", "reach"})->Unit(benchmark::kMillisecond);
  for (const int64_t reach : {50, 500}) bench->Args({1'000'000, reach});
}

BENCHMARK(BM_PhotonMap)->Apply(sizes);
BENCHMARK(BM_Nanoflann)->Apply(sizes);
BENCHMARK(BM_DenseGridRoof)->Apply(sizes);
BENCHMARK(BM_PhotonMapNearest)->Apply(sizes);

}  // namespace
}  // namespace kaustik::benchmarks

BENCHMARK_MAIN();
