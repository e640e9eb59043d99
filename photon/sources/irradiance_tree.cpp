#include "photon/sources/irradiance_tree.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace kaustik::photon {

IrradianceTree::Cube IrradianceTree::Cube::child(size_t octant) const {
  const float quarter = half / 2;
  const auto towards = [&](size_t bit) { return (octant >> bit & 1) != 0 ? quarter : -quarter; };
  return {middle + Vector3(towards(0), towards(1), towards(2)), quarter};
}

void IrradianceTree::fill(Nodes& nodes, size_t number, const Cube& cube, int depth,
                          std::span<const Photon*> photons, std::vector<const Photon*>& sorted) {
  Node node{photons.size(), 0, 0};
  for (const Photon* photon : photons) node.flux += double(luminance(photon->flux));
  const bool divided = photons.size() > kFullCell && depth < kDeepest;
  if (divided) {
    node.children = nodes.size();
    nodes.resize(nodes.size() + 8);
  }
  nodes[number] = node;
  if (!divided) return;
  std::array<size_t, 8> ends{};  // of the octants
  for (const Photon* photon : photons) ++ends[cube.octant_of(photon->p)];
  std::partial_sum(ends.begin(), ends.end(), ends.begin());
  sorted.resize(std::max(sorted.size(), photons.size()));
  std::array<size_t, 8> next = ends;
  for (size_t i = photons.size(); i > 0; --i)
    sorted[--next[cube.octant_of(photons[i - 1]->p)]] = photons[i - 1];
  std::copy_n(sorted.begin(), photons.size(), photons.begin());
  for (size_t octant = 0; octant < 8; ++octant) {
    const size_t first = octant > 0 ? ends[octant - 1] : 0;
    fill(nodes, node.children + octant, cube.child(octant), depth + 1,
         photons.subspan(first, ends[octant] - first), sorted);
  }
}

IrradianceTree::IrradianceTree(const std::vector<Photon>& photons, const Bounds3& bounds) {
  // The cube is larger than the bounds, so that walls lie off the faces of cells.
  const Vector3 extent = bounds.max - bounds.min;
  const float largest = std::max({extent.x, extent.y, extent.z});
  if (largest > 0 && std::isfinite(largest)) {
    const float side = std::ldexp(1.0f, std::ilogb(largest) + 2);
    cube_ = {bounds.min - Vector3(side / 12) + Vector3(side / 2), side / 2};
  }
  std::array<std::vector<const Photon*>, 6> of_sides;
  for (const Photon& photon : photons) of_sides[size_t(cube_side(photon.n))].push_back(&photon);
  std::vector<const Photon*> sorted;
  for (size_t side = 0; side < sides_.size(); ++side) {
    if (of_sides[side].empty()) continue;
    sides_[side].resize(1);
    fill(sides_[side], 0, cube_, 0, of_sides[side], sorted);
  }
}

IrradianceTree::Cell IrradianceTree::at(const Point3& p, const Normal3& n) const {
  const Nodes& nodes = sides_[size_t(cube_side(n))];
  if (nodes.empty()) return {};
  Cube cube = cube_;
  size_t number = 0;
  while (nodes[number].children != 0) {
    const size_t octant = cube.octant_of(p);
    number = nodes[number].children + octant;
    cube = cube.child(octant);
  }
  return {nodes[number].photons, nodes[number].flux, 2 * cube.half};
}

}  // namespace kaustik::photon
