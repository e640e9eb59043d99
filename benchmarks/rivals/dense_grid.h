#pragma once
// The upper limit of speed: a dense grid of cells as wide as the one radius that it is made for, photons as
// columns in the order of the cells, and the photon map's own SIMD loop over them. A query reads three rows
// of three cells in three layers, without any search. A renderer cannot use it: it serves one radius, and its
// memory grows with the volume.

#include "benchmarks/photon_index.h"
#include "benchmarks/rivals/plain_photon.h"
#include "benchmarks/rivals/range_gather.h"

namespace kaustik::benchmarks {

class DenseGrid {
 public:
  static constexpr std::string_view kName = "dense grid";

  static DenseGrid build(photon::PhotonBuffer&& buffer, float radius) {
    DenseGrid grid;
    grid.flux_unit_ = buffer.flux_unit;
    grid.choose_cells(buffer, radius);
    grid.fill(buffer);
    return grid;
  }

  Rgb flux_density(const photon::GatherQuery& query, photon::GatherCounters& counters) const {
    ++counters.queries;
    const Rows rows = rows_near(query.p, box_reach(query.radius));
    for (const photon::PhotonRange& row : rows) counters.candidates += row.size();
    const photon::detail::GatherSum sum = gather_ranges(columns(), rows, query);
    counters.accepted += sum.accepted;
    const float scale = photon::kernel_terms({}, query.radius).scale;
    return Rgb(sum.flux * double(scale) * double(flux_unit_));
  }

  template <class Fn>
  void for_each(const photon::GatherQuery& query, photon::GatherCounters& counters, Fn&& fn) const {
    ++counters.queries;
    const Acceptance counts(query);
    for (const photon::PhotonRange& row : rows_near(query.p, box_reach(query.radius))) {
      counters.candidates += row.size();
      for (uint64_t i = row.begin; i < row.end; ++i) {
        if (!counts.within({x_[i], y_[i], z_[i]}) || !counts.on_surface(surface_[i])) continue;
        ++counters.accepted;
        fn(photon::unpack_rgb9e5(power_[i]) * flux_unit_);
      }
    }
  }

  uint64_t memory_bytes() const {
    return (first_.capacity() + surface_.capacity() + power_.capacity() + direction_.capacity()) *
               sizeof(uint32_t) +
           (x_.capacity() + y_.capacity() + z_.capacity()) * sizeof(float);
  }

 private:
  // The rows of cells along x that a query meets; their photons are contiguous. Rounding may make the query
  // wider than two cells: then there are four rows along an axis.
  class Rows {
   public:
    void add(const photon::PhotonRange& row) { rows_[size_++] = row; }
    const photon::PhotonRange* begin() const { return rows_; }
    const photon::PhotonRange* end() const { return rows_ + size_; }
    operator std::span<const photon::PhotonRange>() const { return {rows_, size_}; }

   private:
    photon::PhotonRange rows_[16];
    size_t size_ = 0;
  };

  // Chooses cells at least as wide as the radius, and so wide that there are few more cells than photons.
  void choose_cells(const photon::PhotonBuffer& buffer, float radius) {
    bounds_ = bounds_of(buffer);
    const Vector3 diagonal = bounds_.diagonal();
    const float longest = std::max(max_component(diagonal), 0x1p-60f);
    const double most = 65536 + 4 * double(buffer.records.size());
    cells_per_metre_ = std::min(1 / box_reach(radius), 0x1p20f / longest);
    const auto cells = [&] {
      const glm::dvec3 along = glm::floor(glm::dvec3(diagonal * cells_per_metre_)) + 1.0;
      return along.x * along.y * along.z;
    };
    while (cells() > most) cells_per_metre_ *= 0.5f;
    size_ = bounds_.empty() ? glm::ivec3(1) : cell(bounds_.max) + 1;
  }

  void fill(const photon::PhotonBuffer& buffer) {
    const photon::PhotonRecords& records = buffer.records;
    std::vector<uint32_t> cell_of(records.size());
    first_.assign(size_t(size_.x) * size_t(size_.y) * size_t(size_.z) + 1, 0);
    for (size_t i = 0; i < records.size(); ++i) {
      cell_of[i] = uint32_t(index(cell({records[i].x, records[i].y, records[i].z})));
      ++first_[cell_of[i] + 1];
    }
    for (size_t c = 1; c < first_.size(); ++c) first_[c] += first_[c - 1];
    const size_t padded = records.size() + photon::kColumnPadding;
    for (auto* column : {&x_, &y_, &z_}) column->resize(padded);
    for (auto* column : {&surface_, &power_, &direction_}) column->resize(padded);
    std::vector<uint32_t> place = first_;
    for (size_t i = 0; i < records.size(); ++i) {
      const photon::PhotonRecord& r = records[i];
      const size_t at = place[cell_of[i]]++;
      x_[at] = r.x, y_[at] = r.y, z_[at] = r.z;
      surface_[at] = r.surface, power_[at] = r.power, direction_[at] = r.direction;
    }
  }

  Rows rows_near(const Point3& p, float reach) const {
    Rows rows;
    if (bounds_.empty()) return rows;
    const glm::ivec3 low = cell(p - reach), high = cell(p + reach);
    for (int z = low.z; z <= high.z; ++z) {
      for (int y = low.y; y <= high.y; ++y) {
        const photon::PhotonRange row{first_[index({low.x, y, z})], first_[index({high.x, y, z}) + 1]};
        if (!row.empty()) rows.add(row);
      }
    }
    return rows;
  }

  photon::PhotonColumns columns() const {
    return {x_.data(), y_.data(), z_.data(), direction_.data(), surface_.data(), power_.data()};
  }
  // The cell of p, clamped to the photons' bounds. Monotone, so that an interval of positions is an interval
  // of cells.
  glm::ivec3 cell(const Point3& p) const {
    return glm::ivec3((glm::clamp(p, bounds_.min, bounds_.max) - bounds_.min) * cells_per_metre_);
  }
  size_t index(const glm::ivec3& c) const {
    return size_t(c.x) + size_t(size_.x) * (size_t(c.y) + size_t(size_.y) * size_t(c.z));
  }

  Bounds3 bounds_;
  float cells_per_metre_ = 1, flux_unit_ = 1;
  glm::ivec3 size_{1};
  std::vector<uint32_t> first_;  // index of the first photon of each cell
  std::vector<float> x_, y_, z_;
  std::vector<uint32_t> surface_, power_, direction_;
};
static_assert(PhotonIndex<DenseGrid>);

}  // namespace kaustik::benchmarks
