// Sides of a few triangles are kept, sorted by position, and all triangles of their mesh are compared with
// them. A filter of the sides' ends tells most vertices to be no end of any.

#include "core/geometry/side_estimate.h"

#include <algorithm>
#include <bit>
#include <map>
#include <numeric>
#include <span>

#include "core/geometry/boundary_edges.h"
#include "core/geometry/point_bits.h"
#include "core/geometry/triangle_bounds.h"

namespace kaustik {
namespace {

using Ends = std::array<PointBits, 2>;

struct Side {
  Ends ends;     // sorted
  bool forward;  // the winding runs from the lower end to the higher one
};

struct SampledSide : Side {
  uint32_t triangle;
  Normal3 n;            // of the winding
  uint32_t others = 0;  // triangles that have the side, too
  bool smooth = false;  // one of them continues it without a bend
};

// Whether a point may be an end of a side: true too often, never too rarely.
class EndFilter {
 public:
  explicit EndFilter(std::span<const SampledSide> sides)
      : bits_(std::bit_ceil(kBitsOfSide * sides.size()) / 64 + 1) {
    for (const SampledSide& side : sides)
      for (const PointBits& end : side.ends) bits_[slot(end) / 64] |= uint64_t{1} << slot(end) % 64;
  }
  bool may_be(const PointBits& at) const { return bits_[slot(at) / 64] >> slot(at) % 64 & 1; }

 private:
  static constexpr size_t kBitsOfSide = 16;
  size_t slot(const PointBits& at) const {
    const uint64_t mixed =
        (at[0] * 0x9e3779b97f4a7c15u ^ at[1] * 0xbf58476d1ce4e5b9u ^ at[2] * 0x94d049bb133111ebu) *
        0x9e3779b97f4a7c15u;
    return (mixed >> 32) % (64 * bits_.size());
  }
  std::vector<uint64_t> bits_;
};

Side side_of(const TriangleMesh& mesh, uint32_t triangle, uint32_t k) {
  const auto& corners = mesh.indices[triangle];
  const PointBits a = bits_of(mesh.P[corners[k]]), b = bits_of(mesh.P[corners[(k + 1) % 3]]);
  return a < b ? Side{{a, b}, true} : Side{{b, a}, false};
}

// The sides of triangles first, first + stride and so on, three of each; none of triangles without area.
std::vector<SampledSide> sample(const TriangleMesh& mesh, uint64_t first, uint64_t stride) {
  std::vector<SampledSide> sides;
  for (uint64_t t = first; t < mesh.indices.size(); t += stride) {
    const auto triangle = static_cast<uint32_t>(t);
    const Normal3 n = winding_normal(mesh, triangle);
    if (n == Normal3(0)) continue;
    for (uint32_t k = 0; k < 3; ++k) sides.push_back({side_of(mesh, triangle, k), triangle, n});
  }
  return sides;
}

// Counts the side of a triangle for the sampled sides with the same ends. `order` sorts these by their ends.
void count_side(const TriangleMesh& mesh, uint32_t triangle, uint32_t k, std::span<const uint32_t> order,
                std::vector<SampledSide>* sampled) {
  const Side side = side_of(mesh, triangle, k);
  const auto first = std::lower_bound(order.begin(), order.end(), side.ends,
                                      [&](uint32_t i, const Ends& e) { return (*sampled)[i].ends < e; });
  if (first == order.end() || (*sampled)[*first].ends != side.ends) return;
  // Then each of them has two others at least, which is all that needs to be known. Thousands of triangles
  // may have one side.
  if ((*sampled)[*first].others > 2) return;
  const Normal3 n = winding_normal(mesh, triangle);
  if (n == Normal3(0)) return;
  for (auto i = first; i != order.end() && (*sampled)[*i].ends == side.ends; ++i) {
    SampledSide& at = (*sampled)[*i];
    if (at.triangle == triangle) continue;
    ++at.others;
    // If windings agree, they run along the common side in opposite directions.
    at.smooth = at.smooth || glm::dot(at.n, at.forward != side.forward ? n : -n) > kBendCosine;
  }
}

void count_all_sides(const TriangleMesh& mesh, std::vector<SampledSide>* sampled) {
  std::vector<uint32_t> order(sampled->size());
  std::iota(order.begin(), order.end(), 0u);
  std::sort(order.begin(), order.end(),
            [&](uint32_t a, uint32_t b) { return (*sampled)[a].ends < (*sampled)[b].ends; });
  const EndFilter filter(*sampled);
  std::vector<bool> may_be(mesh.P.size());
  for (size_t i = 0; i < mesh.P.size(); ++i) may_be[i] = filter.may_be(bits_of(mesh.P[i]));
  for (uint32_t t = 0; t < mesh.indices.size(); ++t) {
    const auto [i0, i1, i2] = mesh.indices[t];
    const std::array<bool, 3> at = {may_be[i0], may_be[i1], may_be[i2]};
    if (at[0] + at[1] + at[2] < 2) continue;
    for (uint32_t k = 0; k < 3; ++k)
      if (at[k] && at[(k + 1) % 3]) count_side(mesh, t, k, order, sampled);
  }
}

SideEstimate estimate(const TriangleMesh& mesh, uint64_t first, uint64_t stride) {
  SideEstimate sum;
  std::vector<SampledSide> sides = sample(mesh, first, stride);
  if (sides.empty()) return sum;
  count_all_sides(mesh, &sides);
  for (size_t i = 0; i < sides.size(); i += 3) {
    double alone = 0;
    for (size_t k = 0; k < 3; ++k) {
      const SampledSide& side = sides[i + k];
      sum.open += double(stride) * !(side.others == 1 && side.smooth);
      alone += side.others == 0;
    }
    sum.apart += double(stride) * (alone / 3) * (alone / 3);
  }
  return sum;
}

}  // namespace

SideEstimate estimate_sides(const std::vector<Shape>& shapes) {
  std::map<const TriangleMesh*, uint64_t> instances;  // 0: of a mesh that is a shape itself
  std::vector<const TriangleMesh*> meshes;            // in the order of the shapes
  uint64_t triangles = 0;
  for (const Shape& shape : shapes) {
    const TriangleMesh* mesh = shape.mesh();
    if (!mesh) continue;
    const auto [found, is_new] = instances.try_emplace(mesh, 0);
    if (is_new) meshes.push_back(mesh), triangles += mesh->indices.size();
    found->second += std::holds_alternative<InstancedMesh>(shape.geometry);
  }
  const uint64_t stride = triangles / kSampledTriangles + 1;
  SideEstimate sum;
  uint64_t before = 0;  // triangles of the meshes so far: all are counted through
  for (const TriangleMesh* mesh : meshes) {
    const SideEstimate of_mesh = estimate(*mesh, (stride - before % stride) % stride, stride);
    before += mesh->indices.size();
    const double placed = of_mesh.open * double(instances[mesh]);
    sum.open += of_mesh.open + (placed <= double(kMostInstanceEdges) ? placed : 0);
    sum.apart += of_mesh.apart;
  }
  return sum;
}

}  // namespace kaustik
